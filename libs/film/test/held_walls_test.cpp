#include <doctest/doctest.h>

#include <vector>

#include "hersey/film/thermal_network.h"
#include "hot_film.h"
#include "relative.h"

// Walls that keep their temperature over a cycle and settle at its end.
namespace hersey::film {
namespace held_walls_test {

FilmModel bearing() {
  FilmModel model{.R = 0.025, .L = 0.02, .c = 30e-6, .grid = {.n_phi = 36, .n_z = 9}};
  model.lubricant = {.mu0 = 0.0277, .density = 860};
  model.lubricant.temperature_law = ExponentialViscosity{.mu_ref = 0.0277, .T_ref = 40 + zero_celsius, .beta = 0.034};
  model.lubricant.specific_heat = 2000, model.lubricant.conductivity = 0.13;
  model.edge_left = model.edge_right = {EdgeKind::pressure, 1e5, 0};
  model.features.push_back({.name = "hole", .phi = 1, .z = 2e-3, .arc = 0.5, .length = 8e-3, .pressure = 3e5});
  return model;
}

/// With a ring as thick as the bore's radius, and a free shaft.
ThermalModel walls(WallMotion motion) {
  ThermalModel thermal{.layers = 4, .T_supply = 40 + zero_celsius, .T_edges = 40 + zero_celsius};
  thermal.shell = RingWall{.outer_radius = 0.05, .transfer = 80, .T_ambient = 30 + zero_celsius};
  thermal.journal = FreeJournal{.heat_capacity = 100};
  thermal.walls = motion;
  return thermal;
}

/// A film whose journal goes to and fro along a line, `swing` about the middle position, in steps of 100 to the period.
class Machine {
 public:
  Machine(const FilmModel& model, const ThermalModel& thermal, double swing)
      : model_(model), heat_(model, thermal), reynolds_(model), swing_(swing) {
    u_ = Eigen::VectorXd::Zero(model.grid.size());
    history_.theta = Eigen::VectorXd::Ones(model.grid.size());
    history_.dt = period / steps;
  }

  /// Mean heat into the journal over a cycle [W], and the largest balance error.
  void run_cycle() {
    heat_into_journal = temperature_of_journal = worst_balance = 0;
    for (int k = 1; k <= steps; ++k) {
      const double phase = 2 * pi * k / steps, rate = 2 * pi / period;
      const double epsilon = 0.5 + swing_ * std::sin(phase);
      const Journal journal{.e = {-epsilon * model_.c, 0},
                            .e_rate = {-swing_ * rate * std::cos(phase) * model_.c, 0},
                            .omega_journal = 300};
      const SurfaceMotion motion = surfaces(model_, journal);
      history_.viscosity = heat_.viscosity();
      REQUIRE(solve_film(reynolds_, motion, history_, {}, u_).solved());
      heat_.advance(motion, history_, u_);
      history_.theta = film_fields(model_, motion, u_).theta;
      heat_into_journal += heat_.observables().balance.to_journal / steps;
      temperature_of_journal += heat_.observables().T_journal / steps;
      worst_balance = std::max(worst_balance, heat_.observables().balance.error());
    }
  }

  /// With nodes at `T_nodes`, or as they are.
  WallCorrection settle() { return heat_.settle_walls(heat_.mean_exchange().T); }

  FilmHeat& heat() { return heat_; }
  double heat_into_journal = 0, temperature_of_journal = 0, worst_balance = 0;
  static constexpr double period = 2 * pi / 300 * 2;
  static constexpr int steps = 100;

 private:
  FilmModel model_;
  FilmHeat heat_;
  Reynolds reynolds_;
  double swing_;
  Eigen::VectorXd u_;
  FilmHistory history_;
};

TEST_CASE("HeldWalls_SettleAtThoseOfTheSteadyFilm") {
  const FilmModel model = bearing();
  Machine machine(model, walls(WallMotion::held), 0);
  std::vector<double> corrections;
  for (int cycle = 0; cycle < 8; ++cycle) {
    machine.run_cycle();
    CHECK(machine.worst_balance < 1e-8);  // the film's residual
    corrections.push_back(machine.settle().largest);
  }
  // 20 K in all, of which the film's own transient leaves a share of a tenth or less after each cycle.
  CHECK(corrections[0] > 15);
  CHECK(corrections[3] < 0.05);
  const Journal journal = turning(model, 0.5, 300);
  const HotFilm steady = solve_hot(model, walls(WallMotion::by_their_heat), surfaces(model, journal), journal.e);
  constexpr double last = 1e-3;  // K, what the last corrections amount to
  CHECK(std::abs(machine.heat().state().journal - steady.heat.T_journal) < last);
  CHECK(std::abs(machine.heat().observables().T_shell_max - steady.heat.T_shell_max) < last);
}

// Walls that follow their heat and are large enough swing little about the same temperatures.
TEST_CASE("HeldWalls_TakeUpNoHeatOverACycle") {
  const FilmModel model = bearing();
  Machine held(model, walls(WallMotion::held), 0.35);
  for (int cycle = 0; cycle < 8; ++cycle) {
    held.run_cycle();
    (void)held.settle();
  }
  CHECK(std::abs(held.heat_into_journal) < 0.05);  // W, of 120 in the first cycle
  ThermalModel warming = walls(WallMotion::by_their_heat);
  std::get<RingWall>(warming.shell).heat_capacity = 3e3;
  std::get<FreeJournal>(warming.journal).heat_capacity = 0.3;
  Machine other(model, warming, 0.35);
  for (int cycle = 0; cycle < 25; ++cycle) other.run_cycle();
  CHECK(std::abs(held.heat().state().journal - other.temperature_of_journal) < 0.1);  // which swings by 0.7 K
}

// A shell and a journal that are bodies of a network, which the film's answer to them brings into balance as it does a
// ring and a free journal.
TEST_CASE("HeldNodes_SettleWithTheirNetwork") {
  const FilmModel model = bearing();
  ThermalModel thermal = walls(WallMotion::held);
  thermal.shell = NodeWall{.T = 40 + zero_celsius, .node = 0, .name = "shell"};
  thermal.journal = NodeWall{.T = 40 + zero_celsius, .node = 1, .name = "journal"};
  const ThermalNetworkModel bodies{.nodes = {{"shell", 1e3, 40 + zero_celsius, false},
                                             {"journal", 1e3, 40 + zero_celsius, false},
                                             {"air", 0, 30 + zero_celsius, true}},
                                   .paths = {{"to air", 0, 2, 2.0}}};
  ThermalNetwork network(bodies);
  Machine machine(model, thermal, 0);
  const FilmTerminals at = terminals_of(thermal);
  for (int cycle = 0; cycle < 8; ++cycle) {
    machine.run_cycle();
    const WallExchange seen = machine.heat().mean_exchange();
    network.advance(0, {{at, seen}});
    (void)machine.heat().settle_walls(network.walls(at, seen.T));
  }
  machine.run_cycle();
  // The journal, which only the film reaches, takes up nothing; what the shell does goes to the air.
  constexpr double last = 1e-3;  // W, of 110 in the first cycle: what the last corrections amount to
  CHECK(std::abs(machine.heat_into_journal) < last);
  const double to_air = 2.0 * (network.temperatures()[0] - (30 + zero_celsius));
  CHECK(std::abs(machine.heat().observables().balance.to_shell - to_air) < last);
}

// A checkpoint in the middle of a cycle keeps every bit of what follows.
TEST_CASE("HeldWalls_ResumeToTheSameNumbers") {
  const FilmModel model = bearing();
  Machine machine(model, walls(WallMotion::held), 0.2);
  machine.run_cycle();
  (void)machine.settle();
  machine.run_cycle();
  Archive saved;
  machine.heat().persist(saved);
  FilmHeat resumed(model, walls(WallMotion::held));
  Archive archive(saved.content());
  resumed.persist(archive);
  CHECK(archive.unread().empty());
  const WallExchange seen = resumed.mean_exchange();
  CHECK(machine.settle().largest == resumed.settle_walls(seen.T).largest);
  CHECK(machine.heat().state().shell == resumed.state().shell);
  CHECK(machine.heat().state().journal == resumed.state().journal);
}

}  // namespace held_walls_test
}  // namespace hersey::film
