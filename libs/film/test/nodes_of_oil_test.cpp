#include <doctest/doctest.h>

#include "film_over_time.h"
#include "relative.h"

// Nodes of a network that are no walls: surroundings of a ring, and origin and destination of oil.
namespace hersey::film {
namespace nodes_of_oil_test {

constexpr double start = 40 + zero_celsius;

FilmModel bearing() { return small_bearing_with_hole(0.7, 24, 7); }

/// Sump 0 that feeds hole and edges and takes the oil back, block 1 around the ring, air 2.
ThermalModel with_sump() {
  ThermalModel thermal = supplied_at_40(3);
  const NetworkNode sump{.T = start, .node = 0, .name = "sump"};
  thermal.oil = {.edges = sump, .features = {sump}, .drain = sump};
  thermal.shell = RingWall{.outer_radius = 0.05,
                           .transfer = 200,
                           .T_ambient = start - 5,
                           .surroundings = NetworkNode{.T = start - 5, .node = 1, .name = "block"}};
  thermal.journal = FreeJournal{.heat_capacity = 50};
  return thermal;
}

ThermalNetworkModel bodies(double capacity) {
  return {.nodes = {{"sump", 10 * capacity, start, false},
                    {"block", 5 * capacity, start - 5, false},
                    {"air", 0, 30 + zero_celsius, true}},
          .paths = {{"cooler", 0, 2, 20.0}, {"housing", 1, 2, 3.0}, {"between", 0, 1, 1.0}}};
}

const Journal loaded{.e = {15e-6, 8e-6}, .omega_journal = 300};

/// A film and the network around it.
struct Machine {
  Machine(const FilmModel& model, const ThermalModel& thermal, double capacity)
      : film(model, thermal, loaded), network(bodies(capacity)) {}
  void warm(double dt) {
    network.advance(dt, {film.at_nodes()});
    film.follow(network);
  }
  FilmOverTime film;
  ThermalNetwork network;
};

TEST_CASE("AnswerToNodes_IsThatOfFiniteDifferences") {
  const FilmModel model = bearing();
  for (const double dt : {0.0, 1e-3, 1.0}) {
    for (const double carry_over : {1.0, 0.6}) {
      CAPTURE(dt);
      CAPTURE(carry_over);
      ThermalModel thermal = with_sump();
      thermal.carry_over = carry_over;
      const FilmTerminals at = terminals_of(thermal);
      REQUIRE(at.outside() == 3);  // block, drain, oil
      FilmOverTime film(model, thermal, loaded);
      film.advance(dt);
      const WallHeatFlow observed = film.heat.heat_flow();
      REQUIRE(observed.T.size() == 5);
      for (const int terminal : {2, 3, 4}) {
        CAPTURE(terminal);
        Eigen::VectorXd T = observed.T;
        T[terminal] += 10;
        FilmOverTime other(model, thermal, loaded);
        HeatState begin = other.heat.state();
        begin.outside = T.tail(3);
        other.heat.set_state(begin);
        other.advance(dt);
        const Eigen::VectorXd expected = observed.heat + observed.by_T * (T - observed.T);
        const double scale = observed.heat.cwiseAbs().maxCoeff() + (expected - observed.heat).cwiseAbs().maxCoeff();
        // A steady film's linear systems are solved to 1e-4 of what is missing, a step's to 1e-7 of an answer.
        CHECK((other.heat.heat_flow().heat - expected).norm() < (dt > 0 ? 1e-6 : 1e-3) * scale);
        FilmOverTime same(model, thermal, loaded);
        same.advance(dt);
        same.heat.move_walls(T);
        CHECK((same.heat.heat_flow().heat - expected).norm() < 1e-12 * scale);  // round-off
        // The film's residual over a short step, and what is left of a steady film's equations.
        CHECK(same.heat.observables().balance.error() < (dt > 0 ? 1e-5 : 1e-4));
        CHECK(same.heat.state().outside[terminal - 2] == T[terminal]);
      }
    }
  }
}

TEST_CASE("StepsWithASump_ConserveHeat") {
  const FilmModel model = bearing();
  Machine machine(model, with_sump(), 1);
  for (const double dt : {1e-5, 1e-3, 0.1, 1.0, 10.0, 100.0, 1e4, 1e6, 1e6, 1e6, 1e6, 1e6, 1e6}) {
    CAPTURE(dt);
    machine.film.advance(dt);
    machine.warm(dt);
    CHECK(std::abs(machine.network.observables().error()) < 1e-10);  // round-off
    CHECK(machine.film.heat.observables().balance.error() < 1e-6);   // the film's residual
  }
  // At rest as much oil enters as leaves: the sump receives the heat of the oil, the block the heat through the ring.
  const HeatBalance balance = machine.film.heat.observables().balance;
  const NetworkObservables& observed = machine.network.observables();
  CHECK(observed.heat[0] == relative(balance.to_oil).epsilon(1e-6));    // the film's residual
  CHECK(observed.heat[1] == relative(balance.to_shell).epsilon(1e-5));  // viscosities follow by a step
  CHECK(observed.to_fixed == relative(balance.power).epsilon(1e-5));    // likewise
  CHECK(machine.film.heat.state().supplies[0] > observed.T[0]);         // mixed with what the film carries over
  CHECK(observed.T[0] > 30 + zero_celsius + 1);
}

// A ring in surroundings that keep their temperature is the ring in a node that does.
TEST_CASE("FixedNode_IsATemperature") {
  const FilmModel model = bearing();
  ThermalModel thermal = with_sump();
  for (auto* node : {&thermal.oil.edges, &thermal.oil.features[0], &thermal.oil.drain}) *node = std::nullopt;
  std::get<RingWall>(thermal.shell).surroundings->node = 2;
  std::get<RingWall>(thermal.shell).surroundings->T = 30 + zero_celsius;
  std::get<RingWall>(thermal.shell).T_ambient = 30 + zero_celsius;
  Machine by_node(model, thermal, 1);
  std::get<RingWall>(thermal.shell).surroundings = std::nullopt;
  Machine by_temperature(model, thermal, 1);
  for (const double dt : {1e-3, 1.0, 100.0}) {
    by_node.film.advance(dt), by_temperature.film.advance(dt);
    by_node.warm(dt);
    CHECK(by_node.film.heat.state().shell == by_temperature.film.heat.state().shell);
    CHECK(by_node.film.heat.state().film == by_temperature.film.heat.state().film);
  }
  CHECK(by_node.network.observables().to_fixed > 0);
}

// The heat into the drain by its own temperature is exact in the mean, and the film does not depend on it. Where oil
// does not thin, a rise of all temperatures changes no heat.
TEST_CASE("MeanAnswerToNodes_IsThatOfTheirHeat") {
  FilmModel model = bearing();
  model.features[0].pressure = 3e6;  // no oil may return into the hole, which the mean counts as drained
  std::get<ExponentialViscosity>(model.lubricant.temperature_law).beta = 0;
  for (const bool has_block : {true, false}) {
    CAPTURE(has_block);
    ThermalModel thermal = with_sump();
    thermal.walls = WallMotion::fixed;
    if (!has_block) {  // the drain is the only node
      std::get<RingWall>(thermal.shell).surroundings = std::nullopt;
      thermal.oil = {.drain = thermal.oil.drain};
    }
    const FilmTerminals at = terminals_of(thermal);
    REQUIRE(at.outside() == (has_block ? 3 : 1));
    const Eigen::Index drain = 2 + at.index_of_drain();
    const auto mean_over_a_cycle = [&](double rise) {
      FilmOverTime film(model, thermal, loaded);
      HeatState begin = film.heat.state();
      begin.outside[drain - 2] += rise;
      film.heat.set_state(begin);
      for (int k = 0; k < 5; ++k) film.advance(0.1);
      return film.heat.mean_heat_flow();
    };
    const WallHeatFlow observed = mean_over_a_cycle(0), other = mean_over_a_cycle(10);
    const double scale = observed.by_T.cwiseAbs().maxCoeff();
    CHECK(scale > 1);  // W/K, of a flow of some grams per second
    CHECK((other.heat - observed.heat - 10 * observed.by_T.col(drain)).norm() <
          1e-10 * observed.heat.norm());  // round-off
    // W/K; of the film's storage the mean keeps a millionth.
    if (has_block) CHECK(observed.by_T.rowwise().sum().norm() < 1e-5 * scale);
  }
}

// Nodes over cycles settle where those of a film at rest end, and a checkpoint keeps every bit on the way.
TEST_CASE("NodesOfOil_SettleOverCycles") {
  const FilmModel model = bearing();
  ThermalModel thermal = with_sump();
  // Bodies of small heat capacity, for twenty times the time constant of the slowest.
  ThermalModel light = thermal;
  std::get<RingWall>(light.shell).heat_capacity = 1e3;
  light.journal = FreeJournal{.heat_capacity = 0.5};
  Machine wanted(model, light, 0.03);
  for (int k = 0; k < 200; ++k) {
    wanted.film.advance(5e-3);
    wanted.warm(5e-3);
  }
  thermal.walls = WallMotion::fixed;
  Machine machine(model, thermal, 1);
  constexpr int cycles = 10, steps = 20;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    for (int k = 0; k < steps; ++k) machine.film.advance(2e-3);
    if (cycle == 1) {
      Archive saved;
      machine.film.heat.persist(saved);
      FilmHeat resumed(model, thermal);
      Archive archive(saved.content());
      resumed.persist(archive);
      CHECK(archive.unread().empty());
      FilmHeat same(model, thermal);
      Archive again(saved.content());
      same.persist(again);
      const WallHeatFlow observed = resumed.mean_heat_flow(), other = same.mean_heat_flow();
      CHECK(observed.heat == other.heat);
      CHECK(observed.by_T == other.by_T);
    }
    machine.film.settle(machine.network);
  }
  // K, of 10 that they rise: what the last corrections amount to.
  for (const int node : {0, 1})
    CHECK(std::abs(machine.network.temperatures()[node] - wanted.network.temperatures()[node]) < 0.01);
}

// Heat that a second hole removes reaches the drain as the heat of oil that leaves over the edges does.
TEST_CASE("Drain_ReceivesTheHeatThatHolesRemove") {
  FilmModel model = bearing();
  model.features.push_back({.name = "outlet", .phi = 3.4, .arc = 0.7, .length = 8e-3, .pressure = 0});
  ThermalModel thermal = with_sump();
  thermal.oil.features.push_back(thermal.oil.features[0]);
  thermal.shell = InsulatedWall{};
  FilmOverTime film(model, thermal, loaded);
  for (int k = 0; k < 100; ++k) film.advance(0);
  const FilmTerminals at = terminals_of(thermal);
  const HeatBalance balance = film.heat.observables().balance;
  CHECK(film.heat.heat_flow().heat[2 + at.index_of_drain()] == relative(balance.to_oil).epsilon(1e-5));  // as solved
  CHECK(balance.to_oil == relative(balance.power).epsilon(1e-5));                                        // likewise
}

}  // namespace nodes_of_oil_test
}  // namespace hersey::film
