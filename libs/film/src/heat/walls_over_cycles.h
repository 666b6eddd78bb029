#pragma once

#include <Eigen/Dense>

#include "heat/mean_heat.h"
#include "heat/wall_relaxation.h"
#include "hersey/core/archive.h"
#include "hersey/film/heat_state.h"
#include "hersey/film/thermal_model.h"

namespace hersey::film {

/// Returns the temperatures of a film's terminals, in the order of WallHeatFlow [K].
[[nodiscard]] Eigen::VectorXd at_terminals(const HeatState& state);

/// Walls that keep their temperatures over a cycle, and their new temperatures at its end (theory manual, thermal.18,
/// thermal.19, thermal.65).
class WallsOverCycles {
 public:
  /// @param thermal  outlives this
  explicit WallsOverCycles(const ThermalModel& thermal) : thermal_(&thermal) {}

  /// Ends a cycle by its means: returns the heat that walls that are nodes absorb, and its derivatives.
  const WallHeatFlow& end_cycle(MeanHeat& mean, const HeatState& state);
  /// Sets, after end_cycle(), the nodes' temperatures, in the order of WallHeatFlow [K], and gives the other walls
  /// those at which they would absorb no heat. Returns the size of the correction.
  WallCorrection settle(const Eigen::VectorXd& T_nodes, HeatState& state);
  /// True if settle() has been called.
  [[nodiscard]] bool have_settled() const { return have_settled_; }

  /// Saves or restores the state that continues from cycle to cycle.
  void persist(Archive& archive);

 private:
  [[nodiscard]] Eigen::VectorXd missing() const;
  [[nodiscard]] Eigen::VectorXd per_kelvin() const;
  void predict(const Eigen::VectorXd& by_nodes);
  void move_own_walls(const Eigen::VectorXd& by_nodes, HeatState& state) const;

  const ThermalModel* thermal_;
  MeanHeat::Answer mean_;
  WallRelaxation relaxation_;
  bool have_settled_ = false;
};

}  // namespace hersey::film
