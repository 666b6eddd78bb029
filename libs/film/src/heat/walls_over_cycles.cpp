#include "heat/walls_over_cycles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "heat/heat_walls.h"

namespace hersey::film {
namespace {

/// Returns the temperatures of a ring, or a shell in a body, and of a journal with a temperature of its own as one
/// vector [K].
Eigen::VectorXd own_walls(const ThermalModel& thermal, const HeatState& state) {
  const Eigen::Index ring = has_own_temperatures(thermal.shell) ? state.shell.size() : 0;
  Eigen::VectorXd T(ring + (has_own_temperature(thermal.journal) ? 1 : 0));
  T.head(ring) = state.shell.head(ring);
  if (T.size() > ring) T[ring] = state.journal;
  return T;
}

}  // namespace

Eigen::VectorXd at_terminals(const HeatState& state) {
  Eigen::VectorXd T(2 + state.outside.size());
  T << (state.shell.size() > 0 ? state.shell[0] : 0), state.journal, state.outside;
  return T;
}

const WallHeatFlow& WallsOverCycles::end_cycle(MeanHeat& mean, const HeatState& state) {
  mean_ = mean.answer(state.shell, state.journal);
  mean_.heat_flow.T = at_terminals(state);
  relaxation_.learn(missing(), per_kelvin());
  mean_.heat_flow.by_T.topLeftCorner<2, 2>() *= relaxation_.factor();
  return mean_.heat_flow;
}

// Temperatures of ring [K] and journal [K], and for walls that are nodes the heat that they absorb [W] (thermal.65).
Eigen::VectorXd WallsOverCycles::missing() const {
  Eigen::VectorXd missing(mean_.without.ring.size() + 3);
  missing << mean_.without.ring, mean_.without.journal, 0, 0;
  for (Eigen::Index wall = 0; wall < 2; ++wall)
    if (mean_.heat_flow.by_T(wall, wall) < 0) missing.tail<2>()[wall] = mean_.heat_flow.heat[wall];
  return missing;
}

// A ring's angles count together as one wall.
Eigen::VectorXd WallsOverCycles::per_kelvin() const {
  const Eigen::Index n = mean_.without.ring.size();
  Eigen::VectorXd per_kelvin = Eigen::VectorXd::Ones(n + 3);
  per_kelvin.head(n).setConstant(std::sqrt(static_cast<double>(n)));
  for (Eigen::Index wall = 0; wall < 2; ++wall)
    if (const double by_itself = -mean_.heat_flow.by_T(wall, wall); by_itself > 0) per_kelvin[n + 1 + wall] = by_itself;
  return per_kelvin;
}

void WallsOverCycles::predict(const Eigen::VectorXd& by_nodes) {
  Eigen::VectorXd fall = missing() / relaxation_.factor();
  fall.tail<2>() = -mean_.heat_flow.by_T.topLeftCorner<2, 2>() * by_nodes.head<2>() / relaxation_.factor();
  relaxation_.predict(fall);
}

// Bodies change by their relaxation from their present temperatures towards those that would settle them; the effects
// of the nodes are added.
void WallsOverCycles::move_own_walls(const Eigen::VectorXd& by_nodes, HeatState& state) const {
  const double factor = 1 / relaxation_.factor();
  if (mean_.heat.size() > 0) state.wall_heat += factor * (mean_.heat - state.wall_heat);
  state.journal_heat += factor * (mean_.journal_heat - state.journal_heat);
  const auto follow = [&](const MeanHeat::Change& change, double factor) {
    if (has_own_temperatures(thermal_->shell)) state.shell += factor * change.ring;
    if (change.heat.size() > 0) state.wall_heat += factor * change.heat;
    if (has_own_temperature(thermal_->journal)) state.journal += factor * change.journal;
    state.journal_heat += factor * change.journal_heat;
  };
  follow(mean_.without, factor);
  if (std::holds_alternative<NodeWall>(thermal_->shell)) follow(mean_.by_shell, by_nodes[0]);
  if (std::holds_alternative<NodeWall>(thermal_->journal)) follow(mean_.by_journal, by_nodes[1]);
  for (std::size_t terminal = 0; terminal < mean_.by_outside.size(); ++terminal)
    follow(mean_.by_outside[terminal], by_nodes[2 + static_cast<Eigen::Index>(terminal)]);
}

WallCorrection WallsOverCycles::settle(const Eigen::VectorXd& T_nodes, HeatState& state) {
  const Eigen::VectorXd by_nodes = T_nodes - mean_.heat_flow.T;
  WallCorrection correction{.rise = -std::numeric_limits<double>::infinity()};
  const auto note = [&](double change, double T) {
    correction.largest = std::max(correction.largest, std::abs(change));
    correction.rise = std::max(correction.rise, T - thermal_->T_supply);
  };
  const Eigen::VectorXd before = own_walls(*thermal_, state);
  if (before.size() > 0) {
    move_own_walls(by_nodes, state);
    const Eigen::VectorXd after = own_walls(*thermal_, state);
    note((after - before).cwiseAbs().maxCoeff(), after.maxCoeff());
  }
  if (std::holds_alternative<NodeWall>(thermal_->shell)) {
    note(by_nodes[0], T_nodes[0]);
    state.shell.setConstant(T_nodes[0]);
  }
  if (std::holds_alternative<NodeWall>(thermal_->journal)) {
    note(by_nodes[1], T_nodes[1]);
    state.journal = T_nodes[1];
  }
  state.outside = T_nodes.tail(state.outside.size());
  predict(by_nodes);
  have_settled_ = true;
  if (!std::isfinite(correction.rise)) correction.rise = 0;
  return correction;
}

void WallsOverCycles::persist(Archive& archive) {
  archive.io("has_settled", have_settled_);
  relaxation_.persist(archive);
}

}  // namespace hersey::film
