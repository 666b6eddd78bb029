#include <doctest/doctest.h>

#include <stdexcept>

#include "hersey/film/thermal_network.h"
#include "hot_film.h"
#include "relative.h"

// Nodes of a network that are no walls: surroundings of a ring, and where oil comes from and goes to.
namespace hersey::film {
namespace nodes_of_oil_test {

constexpr double start = 40 + zero_celsius;

FilmModel bearing(int n_phi = 24, int n_z = 7) {
  FilmModel model{.R = 0.025, .L = 0.02, .c = 30e-6, .grid = {.n_phi = n_phi, .n_z = n_z}};
  model.lubricant = {.mu0 = 0.0277, .density = 860};
  model.lubricant.temperature_law = ExponentialViscosity{.mu_ref = 0.0277, .T_ref = start, .beta = 0.034};
  model.lubricant.specific_heat = 2000, model.lubricant.conductivity = 0.13;
  model.edge_left = model.edge_right = {EdgeKind::pressure, 1e5, 0};
  model.features.push_back({.name = "hole", .phi = 1, .z = 2e-3, .arc = 0.7, .length = 8e-3, .pressure = 3e5});
  return model;
}

/// Sump 0 that feeds hole and edges and takes the oil back, block 1 around the ring, air 2.
ThermalModel with_sump() {
  ThermalModel thermal{.layers = 3, .T_supply = start, .T_edges = start};
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

/// A film and the network around it, step by step.
class Machine {
 public:
  Machine(const FilmModel& model, const ThermalModel& thermal, double capacity, const Journal& journal)
      : heat(model, thermal), network(bodies(capacity)), motion_(surfaces(model, journal)), reynolds_(model) {
    u_ = Eigen::VectorXd::Zero(model.grid.size());
    history_.theta = Eigen::VectorXd::Ones(model.grid.size());
  }
  /// The film alone, nodes as they are; dt = 0: steady.
  void advance(double dt) {
    history_.dt = dt;
    history_.viscosity = heat.viscosity();
    if (!solve_film(reynolds_, motion_, history_, {}, u_).solved()) throw std::runtime_error("no film");
    heat.advance(motion_, history_, u_);
    if (dt > 0) history_.theta = film_fields(reynolds_.model(), motion_, u_).theta;
  }
  void warm(double dt) {
    const FilmTerminals at = terminals_of(heat.thermal());
    network.advance(dt, {{at, heat.exchange()}});
    heat.move_walls(network.walls(at, heat.exchange().T));
  }
  /// Walls that are held take the temperatures that the mean heat since the last call gives them.
  void settle() {
    const FilmTerminals at = terminals_of(heat.thermal());
    const WallExchange seen = heat.mean_exchange();
    network.advance(0, {{at, seen}});
    (void)heat.settle_walls(network.walls(at, seen.T));
  }
  FilmHeat heat;
  ThermalNetwork network;

 private:
  SurfaceMotion motion_;
  Reynolds reynolds_;
  Eigen::VectorXd u_;
  FilmHistory history_;
};

const Journal loaded{.e = {15e-6, 8e-6}, .omega_journal = 300};

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
      Machine film(model, thermal, 1, loaded);
      film.advance(dt);
      const WallExchange seen = film.heat.exchange();
      REQUIRE(seen.T.size() == 5);
      for (const int place : {2, 3, 4}) {
        CAPTURE(place);
        Eigen::VectorXd T = seen.T;
        T[place] += 10;
        Machine other(model, thermal, 1, loaded);
        HeatState begin = other.heat.state();
        begin.outside = T.tail(3);
        other.heat.set_state(begin);
        other.advance(dt);
        const Eigen::VectorXd expected = seen.heat + seen.by_T * (T - seen.T);
        const double scale = seen.heat.cwiseAbs().maxCoeff() + (expected - seen.heat).cwiseAbs().maxCoeff();
        // A steady film's linear systems are solved to 1e-4 of what is missing, a step's to 1e-7 of an answer.
        CHECK((other.heat.exchange().heat - expected).norm() < (dt > 0 ? 1e-6 : 1e-3) * scale);
        Machine same(model, thermal, 1, loaded);
        same.advance(dt);
        same.heat.move_walls(T);
        CHECK((same.heat.exchange().heat - expected).norm() < 1e-12 * scale);  // round-off
        // The film's residual over a short step, and what is left of a steady film's equations.
        CHECK(same.heat.observables().balance.error() < (dt > 0 ? 1e-5 : 1e-4));
        CHECK(same.heat.state().outside[place - 2] == T[place]);
      }
    }
  }
}

TEST_CASE("StepsWithASump_ConserveHeat") {
  const FilmModel model = bearing();
  Machine machine(model, with_sump(), 1, loaded);
  for (const double dt : {1e-5, 1e-3, 0.1, 1.0, 10.0, 100.0, 1e4, 1e6, 1e6, 1e6, 1e6, 1e6, 1e6}) {
    CAPTURE(dt);
    machine.advance(dt);
    machine.warm(dt);
    CHECK(std::abs(machine.network.observables().error()) < 1e-10);  // round-off
    CHECK(machine.heat.observables().balance.error() < 1e-6);        // the film's residual
  }
  // At rest as much oil comes as leaves: the sump takes all that oil carries away, the block what the ring passes on.
  const HeatBalance balance = machine.heat.observables().balance;
  const NetworkObservables& seen = machine.network.observables();
  CHECK(seen.heat[0] == relative(balance.to_oil).epsilon(1e-6));    // the film's residual
  CHECK(seen.heat[1] == relative(balance.to_shell).epsilon(1e-5));  // viscosities follow by a step
  CHECK(seen.to_fixed == relative(balance.power).epsilon(1e-5));    // likewise
  CHECK(machine.heat.state().supplies[0] > seen.T[0]);              // stirred with what the film carries over
  CHECK(seen.T[0] > 30 + zero_celsius + 1);
}

// A ring in surroundings that keep their temperature is the ring in a node that does.
TEST_CASE("FixedNode_IsATemperature") {
  const FilmModel model = bearing();
  ThermalModel thermal = with_sump();
  for (auto* node : {&thermal.oil.edges, &thermal.oil.features[0], &thermal.oil.drain}) *node = std::nullopt;
  std::get<RingWall>(thermal.shell).surroundings->node = 2;
  std::get<RingWall>(thermal.shell).surroundings->T = 30 + zero_celsius;
  std::get<RingWall>(thermal.shell).T_ambient = 30 + zero_celsius;
  Machine by_node(model, thermal, 1, loaded);
  std::get<RingWall>(thermal.shell).surroundings = std::nullopt;
  Machine by_temperature(model, thermal, 1, loaded);
  for (const double dt : {1e-3, 1.0, 100.0}) {
    by_node.advance(dt), by_temperature.advance(dt);
    by_node.warm(dt);
    CHECK(by_node.heat.state().shell == by_temperature.heat.state().shell);
    CHECK(by_node.heat.state().film == by_temperature.heat.state().film);
  }
  CHECK(by_node.network.observables().to_fixed > 0);
}

// Nodes over cycles settle where those of a film at rest end, and a checkpoint keeps every bit on the way.
TEST_CASE("NodesOfOil_SettleOverCycles") {
  const FilmModel model = bearing();
  ThermalModel thermal = with_sump();
  // Bodies that hold little heat, for twenty times as long as the slowest of them takes.
  ThermalModel light = thermal;
  std::get<RingWall>(light.shell).heat_capacity = 1e3;
  light.journal = FreeJournal{.heat_capacity = 0.5};
  Machine wanted(model, light, 0.03, loaded);
  for (int k = 0; k < 200; ++k) {
    wanted.advance(5e-3);
    wanted.warm(5e-3);
  }
  thermal.walls = WallMotion::held;
  Machine machine(model, thermal, 1, loaded);
  constexpr int cycles = 10, steps = 20;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    for (int k = 0; k < steps; ++k) machine.advance(2e-3);
    if (cycle == 1) {
      Archive saved;
      machine.heat.persist(saved);
      FilmHeat resumed(model, thermal);
      Archive archive(saved.content());
      resumed.persist(archive);
      CHECK(archive.unread().empty());
      FilmHeat same(model, thermal);
      Archive again(saved.content());
      same.persist(again);
      const WallExchange seen = resumed.mean_exchange(), other = same.mean_exchange();
      CHECK(seen.heat == other.heat);
      CHECK(seen.by_T == other.by_T);
    }
    machine.settle();
  }
  // K, of 10 that they rise: what the last corrections amount to.
  for (const int node : {0, 1})
    CHECK(std::abs(machine.network.temperatures()[node] - wanted.network.temperatures()[node]) < 0.01);
}

}  // namespace nodes_of_oil_test
}  // namespace hersey::film
