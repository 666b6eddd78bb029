#include <cmath>

#include "figure_table.h"

// What each arc of a bore contributes.
namespace hersey::study {
namespace {

const std::vector<film::Arc>& arcs_of(const Solution& s) {
  static const std::vector<film::Arc> none;
  const film::Arcs* bore = film::arcs_of(s.model);
  return bore != nullptr ? bore->arcs : none;
}

std::vector<std::string> arc_names(const Solution& s) {
  std::vector<std::string> names;
  for (const film::Arc& arc : arcs_of(s)) names.push_back(arc.name);
  return names;
}

const film::PatchObservables& patch(const Solution& s, std::size_t k) { return s.state.film.patches[k]; }

/// Component along the load of what film and contact push an arc outwards with, over the load.
double load_share(const Solution& s, std::size_t k) {
  const film::Grid& grid = s.model.grid;
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  for (int i = grid.patches[k]; i < grid.n_phi && grid.patch_of(i) == static_cast<int>(k); ++i)
    force += s.state.film.normal_forces.segment(grid.index(i, 0), grid.n_z).sum() *
             Eigen::Vector2d(std::cos(grid.phi(i)), std::sin(grid.phi(i)));
  return force.dot(s.state.load) / s.state.load.squaredNorm();
}

double flow_in(const Solution& s, std::size_t k) {
  return std::max(-patch(s, k).flow_first, 0.0) + std::max(-patch(s, k).flow_last, 0.0);
}

}  // namespace

bool has_arcs(const Solution& s) { return !arcs_of(s).empty(); }

Group arc_figures() {
  return {"arcs",
          {{"arc_load_share_<name>", kNone, load_share, {.each = arc_names}},
           {"arc_h_min_<name>",
            kMicrometre,
            [](const Solution& s, std::size_t k) { return patch(s, k).h_min; },
            {.each = arc_names}},
           {"arc_p_max_<name>",
            kMegapascal,
            [](const Solution& s, std::size_t k) { return patch(s, k).p_max; },
            {.each = arc_names}},
           {"arc_flow_in_<name>", kFlow, flow_in, {.each = arc_names}}}};
}

}  // namespace hersey::study
