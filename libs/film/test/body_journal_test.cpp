#include <doctest/doctest.h>

#include <memory>
#include <stdexcept>

#include "hersey/film/thermal_network.h"
#include "hot_film.h"
#include "relative.h"

// A journal in a body that conducts heat: in a steady film, in steps and over cycles.
namespace hersey::film {
namespace body_journal_test {

constexpr double T_air = 30 + zero_celsius;

FilmModel bearing() {
  FilmModel model{.R = 0.025, .L = 0.02, .c = 30e-6, .grid = {.n_phi = 24, .n_z = 7}};
  model.lubricant = {.mu0 = 0.0277, .density = 860};
  model.lubricant.temperature_law = ExponentialViscosity{.mu_ref = 0.0277, .T_ref = 40 + zero_celsius, .beta = 0.034};
  model.lubricant.specific_heat = 2000, model.lubricant.conductivity = 0.13;
  model.edge_left = model.edge_right = {EdgeKind::pressure, 1e5, 0};
  model.features.push_back({.name = "hole", .phi = 1, .z = 2e-3, .arc = 0.7, .length = 8e-3, .pressure = 3e5});
  model.asperities = {.model = AsperityModel::greenwood_tripp_fit,
                      .sigma = 2e-6,
                      .elastic_factor = 3e-3,
                      .composite_modulus = 1e11,
                      .mu_friction = 0.02};
  return model;
}

const Journal turning{.e = {15e-6, 8e-6}, .omega_journal = 300};

/// A body that passes its heat to the air through 1/g, and grows by 2e-7 m/K of its mean temperature, at one end twice
/// as much as at the other.
BodyJournal shaft(const Grid& grid, double g) {
  auto body = std::make_shared<JournalConduction>();
  body->T0 = T_air;
  body->rise = g;
  body->T_reference = 20 + zero_celsius;
  body->shape_by_rise = Eigen::VectorXd::LinSpaced(grid.n_z, 1, 2) * (2e-7 / 1.5);
  body->shape0 = body->shape_by_rise * (T_air - body->T_reference);
  body->shape_by_heat = body->shape_by_rise * g;
  body->T_body0 = Eigen::Vector2d(T_air, T_air);
  body->rise_body = Eigen::Vector2d(g, 2 * g);
  return {.conduction = body, .T_start = 45 + zero_celsius};
}

ThermalModel thermal_with(const JournalWall& journal) {
  ThermalModel thermal{.layers = 3, .T_supply = 40 + zero_celsius, .T_edges = 40 + zero_celsius};
  thermal.shell = RingWall{.outer_radius = 0.04, .T_ambient = T_air};
  thermal.journal = journal;
  return thermal;
}

/// Film and heat of the rotating journal, in steps or, with dt = 0, in iterations towards the steady film.
class Machine {
 public:
  Machine(const FilmModel& model, const ThermalModel& thermal, double dt) : heat(model, thermal), reynolds_(model) {
    motion_ = surfaces(model, turning);
    u_ = Eigen::VectorXd::Zero(model.grid.size());
    history_.theta = Eigen::VectorXd::Ones(model.grid.size());
    history_.dt = dt;
  }
  void run(int steps) {
    for (int k = 0; k < steps; ++k) {
      history_.viscosity = heat.viscosity();
      if (!solve_film(reynolds_, motion_, history_, {}, u_).solved()) throw std::runtime_error("no film");
      heat.advance(motion_, history_, u_);
      if (history_.dt > 0) history_.theta = film_fields(reynolds_.model(), motion_, u_).theta;
    }
  }
  double settle() { return heat.settle_walls(heat.mean_heat_flow().T).largest; }

  FilmHeat heat;

 private:
  SurfaceMotion motion_;
  Reynolds reynolds_;
  Eigen::VectorXd u_;
  FilmHistory history_;
};

constexpr int iterations = 60;  // each reduces the error of a film without runaway by a factor of 1.5 or more

TEST_CASE("JournalInABody_IsALumpedBodyOfItsConductance") {
  const FilmModel model = bearing();
  for (const double g : {0.01, 0.5, 20.0}) {
    CAPTURE(g);
    Machine body(model, thermal_with(shaft(model.grid, g)), 0);
    body.run(iterations);
    const ThermalModel by_node = thermal_with(NodeWall{.T = T_air, .node = 0});
    Machine lumped(model, by_node, 0);
    ThermalNetwork network(
        {.nodes = {{"shaft", 100, T_air, false}, {"air", 0, T_air, true}}, .paths = {{"out", 0, 1, 1 / g}}});
    for (int k = 0; k < iterations; ++k) {
      lumped.run(1);
      const FilmTerminals at = terminals_of(by_node);
      network.advance(0, {{at, lumped.heat.heat_flow()}});
      lumped.heat.move_walls(network.walls(at, lumped.heat.heat_flow().T));
    }
    const HeatState &one = body.heat.state(), &other = lumped.heat.state();
    constexpr double solved = 1e-5;  // K: of some 30 K, the fraction to which the equations of heat are solved
    CHECK(std::abs(one.journal - other.journal) < solved);
    CHECK((one.film - other.film).cwiseAbs().maxCoeff() < solved);
    CHECK(one.journal_heat == relative(body.heat.observables().balance.to_journal).epsilon(1e-12));  // round-off
    // Temperature and heat are of one state of the body.
    CHECK(std::abs(one.journal - (T_air + g * one.journal_heat)) < solved);
    CHECK(body.heat.observables().balance.error() < 1e-6);  // what the equations of heat leave
    CHECK(body.heat.observables().T_journal_body_max ==
          relative(T_air + 2 * g * one.journal_heat).epsilon(1e-12));  // eps
    CHECK(body.heat.journal_growth()[6] == relative(2e-7 / 0.75 * (T_air + g * one.journal_heat - 20 - zero_celsius))
                                               .epsilon(1e-9));  // round-off of 300 K
  }
}

// The body's own temperatures fix its surface.
TEST_CASE("JournalWithoutResistance_HasTheTemperatureOfItsBody") {
  const FilmModel model = bearing();
  Machine body(model, thermal_with(shaft(model.grid, 0)), 0);
  Machine given(model, thermal_with(WallAtTemperature{.T = T_air}), 0);
  body.run(iterations), given.run(iterations);
  CHECK(body.heat.state().journal == T_air);
  CHECK((body.heat.state().film - given.heat.state().film).cwiseAbs().maxCoeff() < 1e-5);  // K, as above
}

TEST_CASE("JournalInABody_KeepsItsTemperatureInAStep") {
  const FilmModel model = bearing();
  Machine body(model, thermal_with(shaft(model.grid, 0.5)), 4e-4);
  Machine given(model, thermal_with(WallAtTemperature{.T = 45 + zero_celsius}), 4e-4);
  body.run(5), given.run(5);
  CHECK(body.heat.state().journal == 45 + zero_celsius);
  CHECK((body.heat.state().film - given.heat.state().film).cwiseAbs().maxCoeff() < 1e-6);  // K; each to 1e-9 of a step
  CHECK(body.heat.observables().T_journal_body_max == 45 + zero_celsius);
  // An even rise of temperature of all of the body shapes it.
  CHECK(body.heat.journal_growth_in_time()[0] == relative(25 * 2e-7 / 1.5).epsilon(1e-12));  // round-off
}

TEST_CASE("JournalOverCycles_IsThatOfTheSteadyFilm") {
  const FilmModel model = bearing();
  for (const double g : {0.5, 0.0}) {
    CAPTURE(g);
    ThermalModel fixed = thermal_with(shaft(model.grid, g));
    fixed.walls = WallMotion::fixed;
    Machine machine(model, fixed, 4e-4);
    double last = 0;
    for (int cycle = 0; cycle < 8; ++cycle) {
      machine.run(100);
      CHECK(machine.heat.observables().balance.error() < 1e-7);  // the film's residual
      last = machine.settle();
      const HeatState& now = machine.heat.state();
      CHECK(std::abs(now.journal - (T_air + g * now.journal_heat)) < 1e-9);  // K, round-off of 300 by (thermal.63)
    }
    constexpr double settled = 1e-3;  // K, what the last corrections amount to
    CHECK(last < settled);
    CHECK(machine.heat.journal_growth_in_time() == machine.heat.journal_growth());
    const double heat = machine.heat.state().journal_heat;
    machine.run(100);
    CHECK(machine.heat.observables().balance.to_journal ==
          relative(heat).epsilon(1e-3));  // what settles it is the film's
    Machine steady(model, thermal_with(shaft(model.grid, g)), 0);
    steady.run(iterations);
    CHECK(std::abs(machine.heat.state().journal - steady.heat.state().journal) < 10 * settled);
    CHECK(std::abs(machine.heat.observables().T_shell_mean - steady.heat.observables().T_shell_mean) < 10 * settled);
  }
}

// A checkpoint in the middle of a cycle keeps every bit of what follows.
TEST_CASE("JournalOverCycles_ResumesToTheSameNumbers") {
  const FilmModel model = bearing();
  ThermalModel fixed = thermal_with(shaft(model.grid, 0.5));
  fixed.walls = WallMotion::fixed;
  Machine machine(model, fixed, 4e-4);
  machine.run(20);
  (void)machine.settle();
  machine.run(7);
  Archive saved;
  machine.heat.persist(saved);
  FilmHeat resumed(model, fixed);
  Archive archive(saved.content());
  resumed.persist(archive);
  CHECK(archive.unread().empty());
  CHECK(resumed.journal_growth_in_time() == machine.heat.journal_growth_in_time());
  const WallHeatFlow observed = resumed.mean_heat_flow();
  CHECK(machine.settle() == resumed.settle_walls(observed.T).largest);
  CHECK(machine.heat.state().journal == resumed.state().journal);
  CHECK(machine.heat.state().journal_heat == resumed.state().journal_heat);
}

// Shell and journal in bodies, by the same cycle.
TEST_CASE("ShellAndJournalInBodies_SettleTogether") {
  const FilmModel model = bearing();
  const int n = model.grid.n_phi;
  auto bush = std::make_shared<WallConduction>();
  bush->T0.setConstant(n, T_air);
  bush->rise = 0.02 * Eigen::MatrixXd::Ones(n, n) + 0.5 * Eigen::MatrixXd::Identity(n, n);
  ThermalModel thermal = thermal_with(shaft(model.grid, 0.5));
  thermal.shell = BodyWall{.conduction = bush, .T_start = 35 + zero_celsius};
  Machine steady(model, thermal, 0);
  steady.run(iterations);
  thermal.walls = WallMotion::fixed;
  Machine machine(model, thermal, 4e-4);
  for (int cycle = 0; cycle < 8; ++cycle) {
    machine.run(100);
    (void)machine.settle();
  }
  CHECK((machine.heat.state().shell - steady.heat.state().shell).cwiseAbs().maxCoeff() < 0.01);  // K: ten corrections
  CHECK(std::abs(machine.heat.state().journal - steady.heat.state().journal) < 0.01);            // likewise
}

TEST_CASE("JournalOnAnotherGrid_HasTheSameShape") {
  const FilmModel model = bearing();
  const JournalConduction body = *shaft(model.grid, 0.5).conduction;
  const Grid coarse = resampled(model.grid, 12, 4), fine = resampled(model.grid, 24, 13);
  for (const Grid& grid : {coarse, fine}) {
    const JournalConduction observed = on_grid(body, model.grid, grid);
    CHECK(observed.rise == body.rise);
    for (int j = 0; j < grid.n_z; ++j)  // a straight line, which straight lines meet
      CHECK(observed.shape(10)[j] ==
            relative(2e-7 / 1.5 * (1.5 + grid.z_over_L(j)) * (10 + 0.5 * 10)).epsilon(1e-12));  // round-off
    CHECK(around(grid, observed.shape0)[grid.index(3, 2)] == observed.shape0[2]);
  }
}

}  // namespace body_journal_test
}  // namespace hersey::film
