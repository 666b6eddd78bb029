#include <doctest/doctest.h>

#include <array>
#include <utility>
#include <vector>

#include "film_over_time.h"
#include "heat/wall_relaxation.h"
#include "relative.h"

// Walls that keep their temperature over a cycle and settle at its end.
namespace hersey::film {
namespace fixed_walls_test {

FilmModel bearing() { return small_bearing_with_hole(0.5, 36, 9); }

/// The ring is as thick as the bore's radius, and the shaft is free.
ThermalModel walls(WallMotion motion) {
  ThermalModel thermal = supplied_at_40(4);
  thermal.shell = RingWall{.outer_radius = 0.05, .transfer = 80, .T_ambient = 30 + zero_celsius};
  thermal.journal = FreeJournal{.heat_capacity = 100};
  thermal.walls = motion;
  return thermal;
}

/// A film whose journal oscillates along a line, with the amplitude `swing` about the middle position, in steps of 50
/// to the period.
class Machine {
 public:
  Machine(const FilmModel& model, const ThermalModel& thermal, double swing)
      : film(model, thermal), c_(model.c), swing_(swing), start_(film.heat.state().journal) {}

  /// Mean heat into the journal over a cycle [W], and the largest balance error.
  void run_cycle() {
    heat_into_journal = temperature_of_journal = worst_balance = 0;
    for (int k = 1; k <= steps; ++k) {
      const double phase = 2 * pi * k / steps, rate = 2 * pi / period;
      const double epsilon = 0.5 + swing_ * std::sin(phase);
      const double speed = 300 * (1 + faster_per_kelvin * (film.heat.state().journal - start_));
      const Journal journal{
          .e = {-epsilon * c_, 0}, .e_rate = {-swing_ * rate * std::cos(phase) * c_, 0}, .omega_journal = speed};
      film.advance(period / steps, journal);
      heat_into_journal += film.heat.observables().balance.to_journal / steps;
      temperature_of_journal += film.heat.observables().T_journal / steps;
      worst_balance = std::max(worst_balance, film.heat.observables().balance.error());
    }
  }

  double faster_per_kelvin = 0;  ///< of the speed, as the journal warms
  FilmOverTime film;
  double heat_into_journal = 0, temperature_of_journal = 0, worst_balance = 0;
  static constexpr double period = 2 * pi / 300 * 2;
  static constexpr int steps = 50;

 private:
  double c_, swing_, start_;
};

TEST_CASE("FixedWalls_SettleAtThoseOfTheSteadyFilm") {
  const FilmModel model = bearing();
  Machine machine(model, walls(WallMotion::fixed), 0);
  std::vector<double> corrections;
  for (int cycle = 0; cycle < 8; ++cycle) {
    machine.run_cycle();
    CHECK(machine.worst_balance < 1e-8);  // the film's residual
    corrections.push_back(machine.film.settle().largest);
  }
  // 20 K in all, of which the film's own transient leaves a fraction of a tenth or less after each cycle.
  CHECK(corrections[0] > 15);
  CHECK(corrections[3] < 0.05);
  const Journal journal = turning(model, 0.5, 300);
  const HotFilm steady = solve_hot(model, walls(WallMotion::by_their_heat), surfaces(model, journal), journal.e);
  constexpr double last = 1e-3;  // K, what the last corrections amount to
  CHECK(std::abs(machine.film.heat.state().journal - steady.heat.T_journal) < last);
  CHECK(std::abs(machine.film.heat.observables().T_shell_max - steady.heat.T_shell_max) < last);
}

// Films that thin as walls warm heat them more than the mean of their equations predicts, as contact does in an engine;
// here the journal rotates faster. The first corrections show the ratio.
TEST_CASE("FixedWalls_ThatDrawMoreHeatAsTheyWarmSettleAsSoon") {
  Machine machine(bearing(), walls(WallMotion::fixed), 0);
  machine.faster_per_kelvin = 0.03;
  std::vector<double> corrections;
  for (int cycle = 0; cycle < 6; ++cycle) {
    machine.run_cycle();
    corrections.push_back(machine.film.settle().largest);
  }
  CHECK(corrections[1] > 15);    // K, as much again as the first
  CHECK(corrections[5] < 0.05);  // a third of each before it would leave 0.18
}

// Walls that follow their heat and are large enough swing little about the same temperatures.
TEST_CASE("FixedWalls_AbsorbNoHeatOverACycle") {
  const FilmModel model = bearing();
  Machine fixed(model, walls(WallMotion::fixed), 0.35);
  for (int cycle = 0; cycle < 8; ++cycle) {
    fixed.run_cycle();
    (void)fixed.film.settle();
  }
  CHECK(std::abs(fixed.heat_into_journal) < 0.05);  // W, of 120 in the first cycle
  ThermalModel warming = walls(WallMotion::by_their_heat);
  std::get<RingWall>(warming.shell).heat_capacity = 3e3;
  std::get<FreeJournal>(warming.journal).heat_capacity = 0.3;
  Machine other(model, warming, 0.35);
  for (int cycle = 0; cycle < 25; ++cycle) other.run_cycle();
  CHECK(std::abs(fixed.film.heat.state().journal - other.temperature_of_journal) < 0.1);  // which swings by 0.7 K
}

// A shell and a journal that are bodies of a network, which the film's answer to them brings into balance as it does a
// ring and a free journal.
TEST_CASE("FixedNodes_SettleWithTheirNetwork") {
  const FilmModel model = bearing();
  ThermalModel thermal = walls(WallMotion::fixed);
  thermal.shell = NodeWall{.T = 40 + zero_celsius, .node = 0, .name = "shell"};
  thermal.journal = NodeWall{.T = 40 + zero_celsius, .node = 1, .name = "journal"};
  const ThermalNetworkModel bodies{.nodes = {{"shell", 1e3, 40 + zero_celsius, false},
                                             {"journal", 1e3, 40 + zero_celsius, false},
                                             {"air", 0, 30 + zero_celsius, true}},
                                   .paths = {{"to air", 0, 2, 2.0}}};
  ThermalNetwork network(bodies);
  Machine machine(model, thermal, 0);
  for (int cycle = 0; cycle < 8; ++cycle) {
    machine.run_cycle();
    machine.film.settle(network);
  }
  machine.run_cycle();
  // The journal, which only the film reaches, absorbs nothing; the heat into the shell flows to the air.
  constexpr double last = 1e-3;  // W, of 110 in the first cycle: what the last corrections amount to
  CHECK(std::abs(machine.heat_into_journal) < last);
  const double to_air = 2.0 * (network.temperatures()[0] - (30 + zero_celsius));
  CHECK(std::abs(machine.film.heat.observables().balance.to_shell - to_air) < last);
}

TEST_CASE("FixedNodes_ThatDrawMoreHeatAsTheyWarmSettleAsSoon") {
  ThermalModel thermal = walls(WallMotion::fixed);
  thermal.shell = WallAtTemperature{.T = 40 + zero_celsius};
  thermal.journal = NodeWall{.T = 40 + zero_celsius, .node = 0, .name = "journal"};
  ThermalNetwork network({.nodes = {{"journal", 1e3, 40 + zero_celsius, false}}, .paths = {}});
  Machine machine(bearing(), thermal, 0);
  machine.faster_per_kelvin = 0.03;
  std::vector<double> rise;
  for (int cycle = 0; cycle < 4; ++cycle) {
    machine.run_cycle();
    machine.film.settle(network);
    rise.push_back(network.temperatures()[0] - (40 + zero_celsius));
  }
  CHECK(rise[0] > 4.5);                       // K, of 7.3
  CHECK(std::abs(rise[3] - rise[2]) < 0.01);  // a third of each before it would leave 0.18
}

// A checkpoint in the middle of a cycle keeps every bit of what follows.
TEST_CASE("FixedWalls_ResumeToTheSameNumbers") {
  const FilmModel model = bearing();
  Machine machine(model, walls(WallMotion::fixed), 0.2);
  machine.run_cycle();
  (void)machine.film.settle();
  machine.run_cycle();
  Archive saved;
  machine.film.heat.persist(saved);
  FilmHeat resumed(model, walls(WallMotion::fixed));
  Archive archive(saved.content());
  resumed.persist(archive);
  CHECK(archive.unread().empty());
  const WallHeatFlow observed = resumed.mean_heat_flow();
  CHECK(machine.film.settle().largest == resumed.settle_walls(observed.T).largest);
  CHECK(machine.film.heat.state().shell == resumed.state().shell);
  CHECK(machine.film.heat.state().journal == resumed.state().journal);
}

// Walls without heat on one side, with a prescribed temperature there, and with a line instead of a hole.
TEST_CASE("FixedWallsOfAllKinds_SettleAtThoseOfTheSteadyFilm") {
  const RingWall ring{.outer_radius = 0.05, .transfer = 80, .T_ambient = 30 + zero_celsius};
  const std::vector<std::pair<ShellWall, JournalWall>> kinds{
      {InsulatedWall{}, FreeJournal{.heat_capacity = 100}},
      {WallAtTemperature{.T = 45 + zero_celsius}, FreeJournal{.heat_capacity = 100}},
      {ring, WallAtTemperature{.T = 45 + zero_celsius}},
      {ring, InsulatedWall{}}};
  for (const auto& kind : kinds) {
    CAPTURE(kind.first.index());
    CAPTURE(kind.second.index());
    FilmModel model = bearing();
    model.features.clear();
    model.supply = {SupplyKind::fixed_angle, 0, 3e5};
    ThermalModel thermal = walls(WallMotion::fixed);
    thermal.shell = kind.first, thermal.journal = kind.second;
    Machine machine(model, thermal, 0);
    for (int cycle = 0; cycle < 8; ++cycle) {
      machine.run_cycle();
      (void)machine.film.settle();
    }
    machine.run_cycle();
    thermal.walls = WallMotion::by_their_heat;
    const Journal there = turning(model, 0.5, 300);
    const HotFilm steady = solve_hot(model, thermal, surfaces(model, there), there.e);
    constexpr double last = 5e-3;  // K, what the last corrections and the film's own transient amount to
    CHECK(std::abs(machine.film.heat.observables().T_journal - steady.heat.T_journal) < last);
    CHECK(std::abs(machine.film.heat.observables().T_shell_mean - steady.heat.T_shell_mean) < last);
  }
}

// A journal of its own heat and one that is a node which nothing else reaches, beside either kind of shell.
TEST_CASE("FixedNodeThatNothingReaches_IsAFreeJournal") {
  const FilmModel model = bearing();
  for (const bool has_ring : {false, true}) {
    CAPTURE(has_ring);
    std::array<double, 2> journal{}, shell{};
    for (const bool is_node : {false, true}) {
      ThermalModel thermal = walls(WallMotion::fixed);
      if (!has_ring) thermal.shell = NodeWall{.T = 40 + zero_celsius, .node = 0, .name = "shell"};
      if (is_node) thermal.journal = NodeWall{.T = 40 + zero_celsius, .node = 1, .name = "journal"};
      ThermalNetwork network({.nodes = {{"shell", 1e3, 40 + zero_celsius, false},
                                        {"journal", 1e3, 40 + zero_celsius, false},
                                        {"air", 0, 30 + zero_celsius, true}},
                              .paths = {{"to air", 0, 2, 2.0}}});
      Machine machine(model, thermal, 0);
      for (int cycle = 0; cycle < 8; ++cycle) {
        machine.run_cycle();
        machine.film.settle(network);
      }
      journal[is_node ? 1 : 0] = machine.film.heat.state().journal;
      shell[is_node ? 1 : 0] = machine.film.heat.observables().T_shell_mean;
    }
    constexpr double last = 1e-3;  // K, what the last corrections amount to
    CHECK(std::abs(journal[1] - journal[0]) < last);
    CHECK(std::abs(shell[1] - shell[0]) < last);
    CHECK(journal[0] > 45 + zero_celsius);
  }
}

// Walls of given temperatures have nothing to settle.
TEST_CASE("FixedWallsOfGivenTemperature_KeepIt") {
  ThermalModel thermal = walls(WallMotion::fixed);
  thermal.shell = WallAtTemperature{.T = 45 + zero_celsius};
  thermal.journal = WallAtTemperature{.T = 50 + zero_celsius};
  Machine machine(bearing(), thermal, 0.2);
  machine.run_cycle();
  const WallCorrection correction = machine.film.settle();
  CHECK(correction.largest == 0);
  CHECK(correction.rise == 0);
  CHECK(machine.film.heat.state().journal == 50 + zero_celsius);
}

// The origins of oil and the surroundings of a ring are nodes that keep their temperatures, or such temperatures: with
// a line, with a hole that removes oil, and with partial renewal of all oil.
TEST_CASE("FixedWallsBesideNodesThatStay_SettleAsAtTheirTemperatures") {
  FilmModel model = bearing();
  model.supply = {SupplyKind::fixed_angle, 0, 3e5};
  model.features[0].phi = 2.6, model.features[0].pressure = 0;
  ThermalModel thermal = walls(WallMotion::fixed);
  thermal.carry_over = 0.7;
  Machine by_temperature(model, thermal, 0.1);
  thermal.oil.line = NetworkNode{.T = 40 + zero_celsius, .node = 0, .name = "oil"};
  std::get<RingWall>(thermal.shell).surroundings = NetworkNode{.T = 30 + zero_celsius, .node = 1, .name = "air"};
  REQUIRE(terminals_of(thermal).index_of_drain() == -1);
  Machine by_node(model, thermal, 0.1);
  ThermalNetwork network(
      {.nodes = {{"oil", 0, 40 + zero_celsius, true}, {"air", 0, 30 + zero_celsius, true}}, .paths = {}});
  for (int cycle = 0; cycle < 3; ++cycle) {
    by_temperature.run_cycle(), by_node.run_cycle();
    (void)by_temperature.film.settle();
    by_node.film.settle(network);
    constexpr double solved = 1e-6;  // K, of answers of some 20 K solved to 1e-7
    CHECK(std::abs(by_node.film.heat.state().journal - by_temperature.film.heat.state().journal) < solved);
    CHECK((by_node.film.heat.state().shell - by_temperature.film.heat.state().shell).cwiseAbs().maxCoeff() < solved);
  }
}

// A steady film does not depend on the motion of walls over time.
TEST_CASE("SteadyFilmWithFixedNodes_IsTheSteadyFilm") {
  const FilmModel model = bearing();
  std::array<WallHeatFlow, 2> observed;
  for (const bool fixed : {false, true}) {
    ThermalModel thermal = walls(fixed ? WallMotion::fixed : WallMotion::by_their_heat);
    thermal.journal = NodeWall{.T = 40 + zero_celsius, .node = 0, .name = "journal"};
    FilmOverTime film(model, thermal, turning(model, 0.5, 300));
    film.advance(0);
    observed[fixed ? 1 : 0] = film.heat.heat_flow();
  }
  CHECK(observed[1].heat == observed[0].heat);
  CHECK(observed[1].by_T == observed[0].by_T);
}

// A change in another direction than predicted leaves the relaxation at one.
TEST_CASE("WallRelaxation_FollowsChangesInThePredictedDirection") {
  const Eigen::Vector2d ones(1, 1), predicted(10, 0);
  for (const auto& [then, factor] : std::vector<std::pair<Eigen::Vector2d, double>>{
           {{0, 0}, 1.0}, {{2.5, 0}, 0.75}, {{9, 0}, 0.5}, {{0, 10}, 1.0}, {{12, 0}, 1.0}}) {
    WallRelaxation relaxation;
    relaxation.learn(Eigen::Vector2d(10, 0), ones);
    CHECK(relaxation.factor() == 1);
    relaxation.predict(predicted);
    relaxation.learn(then, ones);
    CHECK(relaxation.factor() == relative(factor).epsilon(1e-15));  // eps
  }
}

}  // namespace fixed_walls_test
}  // namespace hersey::film
