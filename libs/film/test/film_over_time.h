#pragma once

#include <Eigen/Dense>
#include <stdexcept>

#include "hersey/film/thermal_network.h"
#include "hot_film.h"

namespace hersey::film {

/// A small bearing of a machine, its edges in oil.
inline FilmModel small_bearing(double c, int n_phi, int n_z) {
  FilmModel model{.R = 0.025, .L = 0.02, .c = c, .grid = {.n_phi = n_phi, .n_z = n_z}, .lubricant = thinning_oil()};
  model.edge_left = model.edge_right = {EdgeKind::pressure, 1e5, 0};
  return model;
}

/// The same bearing with a hole of `arc` beside its middle that feeds it.
inline FilmModel small_bearing_with_hole(double arc, int n_phi, int n_z) {
  FilmModel model = small_bearing(30e-6, n_phi, n_z);
  model.features.push_back({.name = "hole", .phi = 1, .z = 2e-3, .arc = arc, .length = 8e-3, .pressure = 3e5});
  return model;
}

/// A film and its temperatures step by step, from a full gap.
class FilmOverTime {
 public:
  FilmOverTime(const FilmModel& model, const ThermalModel& thermal, const Journal& journal = {})
      : heat(model, thermal), motion_(surfaces(model, journal)), reynolds_(model) {
    u_ = Eigen::VectorXd::Zero(model.grid.size());
    history_.theta = Eigen::VectorXd::Ones(model.grid.size());
  }

  /// Advances over dt [s] with the journal where it is, and with the present temperatures of nodes; 0: steady.
  void advance(double dt) {
    history_.dt = dt;
    history_.viscosity = heat.viscosity();
    const FilmSolveSummary solved = solve_film(reynolds_, motion_, history_, {}, u_);
    if (!solved.solved()) throw std::runtime_error(solved.message);
    heat.advance(motion_, history_, u_);
    history_.theta = film_fields(reynolds_.model(), motion_, u_).theta;
  }
  /// Moves the journal there and advances.
  void advance(double dt, const Journal& journal) {
    motion_ = surfaces(reynolds_.model(), journal);
    advance(dt);
  }

  [[nodiscard]] FilmAtNodes at_nodes() const { return {terminals_of(heat.thermal()), heat.heat_flow()}; }
  /// Nodes take the temperatures they have in `network`.
  void follow(const ThermalNetwork& network) {
    heat.move_walls(network.walls(terminals_of(heat.thermal()), heat.heat_flow().T));
  }
  /// Settles a network without capacities: nodes take the temperatures that follow from the mean heat since the last
  /// call, and fixed walls take theirs.
  void settle(ThermalNetwork& network) {
    const FilmTerminals at = terminals_of(heat.thermal());
    const WallHeatFlow observed = heat.mean_heat_flow();
    network.advance(0, {{at, observed}});
    (void)heat.settle_walls(network.walls(at, observed.T));
  }
  /// Settles the walls with nodes at their present temperatures.
  WallCorrection settle() { return heat.settle_walls(heat.mean_heat_flow().T); }

  FilmHeat heat;

 private:
  SurfaceMotion motion_;
  Reynolds reynolds_;
  Eigen::VectorXd u_;
  FilmHistory history_;
};

}  // namespace hersey::film
