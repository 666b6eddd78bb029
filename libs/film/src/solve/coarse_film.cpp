#include "solve/coarse_film.h"

#include <algorithm>

#include "balance/node.h"

namespace hersey::film {
namespace {

// Fewer nodes show no front (around) and no parabola (across).
constexpr int fewest_around = 24, fewest_across = 7;

Grid half_of(const Grid& grid) {
  return resampled(grid, (grid.n_phi + 1) / 2, grid.n_z < fewest_across ? grid.n_z : grid.n_z / 2 + 1);
}

}  // namespace

GridTransfer::GridTransfer(const Grid& from, const Grid& to) : n_z_(from.n_z) {
  around_.reserve(static_cast<std::size_t>(to.n_phi));
  along_.reserve(static_cast<std::size_t>(to.n_z));
  for (int i = 0; i < to.n_phi; ++i) {
    const double at = static_cast<double>(i) * from.n_phi / to.n_phi;
    const int node = static_cast<int>(at);
    around_.push_back({node, (node + 1) % from.n_phi, at - node});
  }
  for (int j = 0; j < to.n_z; ++j) {
    const double at = static_cast<double>(j) * (from.n_z - 1) / (to.n_z - 1);
    const int node = std::min(static_cast<int>(at), from.n_z - 2);
    along_.push_back({node, node + 1, at - node});
  }
}

Eigen::VectorXd GridTransfer::operator()(const Eigen::VectorXd& field) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(around_.size() * along_.size()));
  Eigen::Index node = 0;
  for (const Between& i : around_) {
    const auto on_line = [&](int line, const Between& j) {
      return (1 - j.share) * field[line * n_z_ + j.first] + j.share * field[line * n_z_ + j.second];
    };
    for (const Between& j : along_) {
      result[node++] = (1 - i.share) * on_line(i.first, j) + i.share * on_line(i.second, j);
    }
  }
  return result;
}

bool can_be_coarsened(const Grid& grid) { return half_of(grid).n_phi >= fewest_around; }

CoarseFilm coarsened(const FilmModel& model, const SurfaceMotion& motion, const FilmHistory& history,
                     const Eigen::VectorXd& u) {
  CoarseFilm coarse{model, motion, history, {}};
  coarse.model.grid = half_of(model.grid);
  const GridTransfer to_coarse(model.grid, coarse.model.grid);
  const double fill = fill_scale(coarse.model) / fill_scale(model);
  coarse.u = to_coarse(u).unaryExpr([fill](double value) { return value < 0 ? fill * value : value; });
  coarse.motion.g = to_coarse(motion.g);
  coarse.motion.g_rate = to_coarse(motion.g_rate);
  coarse.motion.shell_opening.resize(0);  // matters to forces alone
  if (history.viscosity.fluidity.size() != 0) {
    coarse.history.viscosity = {to_coarse(history.viscosity.fluidity), to_coarse(history.viscosity.shear_fluidity),
                                to_coarse(history.viscosity.skew)};
    if (history.viscosity.at_rest.size() != 0) {
      coarse.history.viscosity.at_rest = to_coarse(history.viscosity.at_rest);
      coarse.history.viscosity.axial_fluidity = to_coarse(history.viscosity.axial_fluidity);
    }
  }
  if (history.dt == 0) return coarse;
  coarse.history.theta = to_coarse(history.theta);
  if (history.w.size() != 0) coarse.history.w = to_coarse(history.w);
  if (history.density.size() != 0) coarse.history.density = to_coarse(history.density);
  if (history.gap.size() != 0) coarse.history.gap = to_coarse(history.gap);
  return coarse;
}

Eigen::VectorXd refined(const CoarseFilm& coarse, const FilmModel& model) {
  const double fill = fill_scale(model) / fill_scale(coarse.model);
  const GridTransfer to_fine(coarse.model.grid, model.grid);
  return to_fine(coarse.u.unaryExpr([fill](double value) { return value < 0 ? fill * value : value; }));
}

}  // namespace hersey::film
