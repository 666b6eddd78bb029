#include <doctest/doctest.h>

#include <memory>

#include "film_over_time.h"
#include "relative.h"

// A shell in a body that conducts heat, whose temperatures settle over cycles.
namespace hersey::film {
namespace body_over_cycles_test {

FilmModel bearing() { return small_bearing_with_hole(0.7, 24, 7); }

constexpr double T_air = 30 + zero_celsius;

/// A bush of n equal sectors, each to its neighbours by `around` [W/K] and to the air by `out`, whose bore opens by
/// 1e-7 m/K of its mean temperature.
BodyWall bush(const Grid& grid, double around, double out) {
  const int n = grid.n_phi;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    A(i, i) = 2 * around + out;
    A(i, (i + 1) % n) = A(i, (i + n - 1) % n) = -around;
  }
  auto wall = std::make_shared<WallConduction>();
  wall->T0.setConstant(n, T_air);
  wall->rise = A.inverse();
  wall->T_reference = 20 + zero_celsius;
  wall->shape_by_rise.setConstant(grid.size(), 1e-7);
  wall->shape0 = wall->shape_by_rise * (T_air - wall->T_reference);
  wall->shape_by_heat = Eigen::MatrixXd::Constant(grid.size(), n, 1e-7) * wall->rise.rowwise().mean().asDiagonal();
  return {.conduction = wall, .T_start = 45 + zero_celsius};
}

ThermalModel thermal_with(const FilmModel& model, WallMotion walls) {
  ThermalModel thermal = supplied_at_40(3);
  thermal.shell = bush(model.grid, 0.8, 0.05);
  thermal.journal = FreeJournal{.heat_capacity = 100};
  thermal.walls = walls;
  return thermal;
}

const Journal loaded{.e = {15e-6, 8e-6}, .omega_journal = 300};

void run_cycle(FilmOverTime& film, int steps = 100) {
  for (int k = 0; k < steps; ++k) film.advance(4e-4);
}

TEST_CASE("BodyOverCycles_IsThatOfTheSteadyFilm") {
  const FilmModel model = bearing();
  const ThermalModel fixed = thermal_with(model, WallMotion::fixed);
  const auto& wall = *std::get<BodyWall>(fixed.shell).conduction;
  FilmOverTime machine(model, fixed, loaded);
  // Before it has settled the body is as warm everywhere.
  CHECK(machine.heat.shell_opening_in_time()[3] == relative(25e-7).epsilon(1e-12));  // round-off
  double last = 0;
  for (int cycle = 0; cycle < 8; ++cycle) {
    run_cycle(machine);
    CHECK(machine.heat.observables().balance.error() < 1e-7);  // the film's residual
    last = machine.settle().largest;
    const HeatState& now = machine.heat.state();
    // Temperatures and heat are those of one state of the body: of (thermal.57), which is solved exactly.
    CHECK((now.shell - wall.temperatures(now.wall_heat)).cwiseAbs().maxCoeff() < 1e-9);  // K, round-off of 300
  }
  constexpr double settled = 1e-3;  // K, what the last corrections amount to
  CHECK(last < settled);
  const HeatState& end = machine.heat.state();
  run_cycle(machine);
  // The body passes on what it takes up: the heat that has settled it is that of the film.
  CHECK(machine.heat.observables().balance.to_shell == relative(end.wall_heat.sum()).epsilon(1e-3));
  const HotFilm steady =
      solve_hot(model, thermal_with(model, WallMotion::by_their_heat), surfaces(model, loaded), loaded.e);
  CHECK(std::abs(machine.heat.observables().T_shell_max - steady.heat.T_shell_max) < 10 * settled);
  CHECK(std::abs(machine.heat.state().journal - steady.heat.T_journal) < 10 * settled);
  CHECK(machine.heat.shell_opening_in_time() == machine.heat.shell_opening());
  // The bore is as wide as the body's mean temperature makes it.
  const double rise = machine.heat.state().shell.mean() - wall.T_reference;
  CHECK(machine.heat.shell_opening()[3] == relative(1e-7 * rise).epsilon(1e-9));  // round-off of the inverse
}

// A ring whose inner half resists next to nothing is the body of the same conductances, correction by correction.
TEST_CASE("RingAsABody_SettlesAsTheRing") {
  const FilmModel model = bearing();
  RingWall ring{.outer_radius = 0.0250001, .conductivity = 2e6, .transfer = 400, .T_ambient = T_air};
  ring.T_start = 45 + zero_celsius;
  ThermalModel by_ring = thermal_with(model, WallMotion::fixed);
  by_ring.shell = ring;
  const double middle = 0.5 * (model.R + ring.outer_radius), angle = 2 * pi / model.grid.n_phi;
  const double around = ring.conductivity * (ring.outer_radius - model.R) * model.L / (middle * angle);
  const double through = std::log(ring.outer_radius / middle) / (ring.conductivity * model.L) +
                         1 / (ring.transfer * ring.outer_radius * model.L);
  const double ends = ring.transfer * (ring.outer_radius * ring.outer_radius - model.R * model.R);
  ThermalModel by_body = by_ring;
  by_body.shell = bush(model.grid, around, angle / through + ends * angle);
  FilmOverTime one(model, by_ring, loaded), other(model, by_body, loaded);
  for (int cycle = 0; cycle < 3; ++cycle) {
    run_cycle(one, 20), run_cycle(other, 20);
    CHECK(one.settle().largest ==
          relative(other.settle().largest).epsilon(1e-5));  // of the resistance that the body has not
    CHECK((one.heat.state().shell - other.heat.state().shell).cwiseAbs().maxCoeff() < 1e-4);  // likewise
  }
}

// A checkpoint in the middle of a cycle keeps every bit of what follows.
TEST_CASE("BodyOverCycles_ResumesToTheSameNumbers") {
  const FilmModel model = bearing();
  const ThermalModel fixed = thermal_with(model, WallMotion::fixed);
  FilmOverTime machine(model, fixed, loaded);
  run_cycle(machine, 20);
  (void)machine.settle();
  run_cycle(machine, 7);
  Archive saved;
  machine.heat.persist(saved);
  FilmHeat resumed(model, fixed);
  Archive archive(saved.content());
  resumed.persist(archive);
  CHECK(archive.unread().empty());
  CHECK(resumed.shell_opening_in_time() == machine.heat.shell_opening_in_time());
  const WallHeatFlow observed = resumed.mean_heat_flow();
  CHECK(machine.settle().largest == resumed.settle_walls(observed.T).largest);
  CHECK(machine.heat.state().shell == resumed.state().shell);
  CHECK(machine.heat.state().wall_heat == resumed.state().wall_heat);
}

}  // namespace body_over_cycles_test
}  // namespace hersey::film
