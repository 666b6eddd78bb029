#pragma once

#include <Eigen/Dense>

#include "heat/mean_heat.h"
#include "heat/wall_relaxation.h"
#include "hersey/core/archive.h"
#include "hersey/film/heat_state.h"
#include "hersey/film/thermal_model.h"

namespace hersey::film {

/// Temperatures of a film's terminals, in the order of WallExchange [K].
[[nodiscard]] Eigen::VectorXd at_terminals(const HeatState& state);

/// Walls that keep their temperatures over a cycle, and what they take at its end (theory manual, thermal.18,
/// thermal.19, thermal.65).
class WallsOverCycles {
 public:
  /// @param thermal  outlives this
  explicit WallsOverCycles(const ThermalModel& thermal) : thermal_(&thermal) {}

  /// By the means of the cycle, which end with it: what walls that are nodes take up, and how it follows them.
  const WallExchange& end_cycle(MeanHeat& mean, const HeatState& state);
  /// After end_cycle(): gives nodes these temperatures, in the order of WallExchange [K], and the other walls those at
  /// which they would take up no heat. Tells by how much they were off.
  WallCorrection settle(const Eigen::VectorXd& T_nodes, HeatState& state);
  /// Whether settle() has been called.
  [[nodiscard]] bool have_settled() const { return have_settled_; }

  /// What goes on from cycle to cycle.
  void persist(Archive& archive);

 private:
  [[nodiscard]] Eigen::VectorXd missing() const;
  [[nodiscard]] Eigen::VectorXd per_kelvin() const;
  void foretell(const Eigen::VectorXd& by_nodes);
  void move_own_walls(const Eigen::VectorXd& by_nodes, HeatState& state) const;

  const ThermalModel* thermal_;
  MeanHeat::Answer mean_;
  WallPace pace_;
  bool have_settled_ = false;
};

}  // namespace hersey::film
