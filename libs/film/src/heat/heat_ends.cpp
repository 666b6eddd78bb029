#include "heat/heat_equations.h"
#include "hersey/film/groove_mixing.h"

// Oil that comes and goes over the ends of patches, and the grooves between them (thermal.68, thermal.69).
namespace hersey::film {

const EndOil* HeatEquations::end_oil(const HeatState& state, int node) const {
  const Eigen::Index end = end_of_line_[static_cast<std::size_t>(node / model_.grid.n_z)];
  return end < 0 || state.ends.empty() ? nullptr : &state.ends[static_cast<std::size_t>(end)];
}

double HeatEquations::coming(const CarryingFilm& film, const HeatState& state, int node) const {
  const double T = at_edges(state.outside);
  const EndOil* end = end_oil(state, node);
  return end == nullptr ? T : T + film.balance.end_fraction(node) * end->rise;
}

double HeatEquations::fresh_fraction(const CarryingFilm& film, const HeatState& state, int node) const {
  const EndOil* end = end_oil(state, node);
  return end == nullptr ? 1 : 1 - film.balance.end_fraction(node) * end->carried;
}

double HeatEquations::lost_fraction(const CarryingFilm& film, const HeatState& state, int node) const {
  const EndOil* end = end_oil(state, node);
  return end == nullptr ? 1 : 1 - film.balance.end_fraction(node) * end->drawn_again;
}

std::vector<EndFlow> HeatEquations::end_flows(const CarryingFilm& film, const HeatState& state) const {
  std::vector<EndFlow> flows(2 * model_.grid.patches.size());
  for (int node = 0; node < model_.grid.size(); ++node) {
    const Eigen::Index end = end_of_line_[static_cast<std::size_t>(node / model_.grid.n_z)];
    if (end < 0) continue;
    EndFlow& at = flows[static_cast<std::size_t>(end)];
    const double out = film.balance.end_fraction(node) * film.balance.outflow(node);
    at.drawn += std::max(-out, 0.0), at.leaving += std::max(out, 0.0);
    for (int l = 0; l < layers() && out > 0; ++l)
      at.T += out * film.flows.leaving_fraction(node, l) * state.film[system_.row(node, l)];
  }
  for (EndFlow& at : flows)
    if (at.leaving > 0) at.T /= at.leaving;
  return flows;
}

std::vector<EndOil> HeatEquations::mixed_in_grooves(const CarryingFilm& film, const HeatState& state) const {
  const std::vector<EndFlow> flows = end_flows(film, state);
  std::vector<EndOil> oil(flows.size());
  const double T_fresh = at_edges(state.outside);
  for (std::size_t last = 1; last < flows.size(); last += 2) {
    const std::size_t next = (last + 1) % flows.size();
    const std::vector<EndOil> mixed = mixed_in_groove({flows[last], flows[next]}, thermal_.carry_over, T_fresh);
    oil[last] = mixed[0], oil[next] = mixed[1];
  }
  return oil;
}

}  // namespace hersey::film
