#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "hersey/circuit/circuit.h"

// Nodes that get less oil than flows out of full ones: they lie at the cavitation pressure, filled in part.
namespace hersey::circuit {
namespace starved_circuit_test {

constexpr double kRoundOff = 64 * std::numeric_limits<double>::epsilon();
constexpr double kBalanced = 1e-12;  // nodes are balanced to 1e-13 of the largest flow, which is ten times these

/// A node into which air comes at ambient pressure, as into a groove.
Node open_to_air(std::string name, std::optional<Storage> storage = {}) {
  return {.name = std::move(name), .storage = storage, .p_cav = 0};
}

Conditions at_rest(const Network& network) {
  return {.given = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(network.nodes.size())),
          .speeds = Eigen::VectorXd::Zero(1)};
}

/// The solution of a circuit from which nothing is drawn.
struct Solved {
  Eigen::VectorXd entries, p, fill, Q;
  Solved(const Network& network, const Conditions& conditions) : Solved(network, conditions, {}) {}
  Solved(const Network& network, const Conditions& conditions, const Eigen::VectorXd& start) {
    const Circuit circuit(network);
    entries = start.size() > 0 ? start : circuit.start(conditions);
    const CircuitSummary summary = circuit.solve(conditions, circuit.nothing_drawn(), entries);
    REQUIRE_MESSAGE(summary.solved(), summary.message);
    p = circuit.pressures(entries), fill = circuit.fills(entries), Q = circuit.flows(entries, conditions);
  }
};

// Each node's outlet could take more than its inlet brings: a tenth of 1e-5 m^3/s, then half of what its own pump
// moves.
TEST_CASE("StarvedNode_HandsOnWhatReachesIt") {
  const double given = 1e-6;
  const Network network{.nodes = {{"sump", true}, open_to_air("a"), open_to_air("b"), open_to_air("c")},
                        .elements = {{"in", 0, 1, GivenFlow{given}},
                                     {"first", 1, 2, GivenFlow{10 * given}},
                                     {"second", 2, 3, GivenFlow{2 * given}},
                                     {"out", 3, 0, Resistance{1e10}}}};
  const Solved solved(network, at_rest(network));
  for (const double Q : solved.Q) CHECK(Q == doctest::Approx(given).epsilon(10 * kBalanced));
  CHECK(solved.fill[1] == doctest::Approx(0.1).epsilon(10 * kBalanced));
  CHECK(solved.fill[2] == doctest::Approx(0.5).epsilon(10 * kBalanced));
  CHECK(solved.fill[3] == 1);
  CHECK(solved.p[1] == 0);
  CHECK(solved.p[3] == doctest::Approx(1e10 * given).epsilon(10 * kBalanced));
}

// A rotating bore draws by its head whatever it gets, out of a node at the cavitation pressure.
TEST_CASE("RotatingBore_DrawsTheOilThatItsNodeHas") {
  Network network{.nodes = {{"sump", true}, open_to_air("main"), {"pin", true}},
                  .elements = {{"in", 0, 1, GivenFlow{2e-6}},
                               {"crank", 1, 2, Drilling{.length = 0.06, .diameter = 3e-3}, 0, 0.03, 0.055}},
                  .oil = {.mu = 0.01, .density = 860}};
  Conditions conditions = at_rest(network);
  conditions.speeds[0] = 400;  // rad/s
  const Circuit circuit(network);
  const double full = circuit.flow(1, Eigen::Vector3d::Zero(), conditions).value;
  REQUIRE(full > 4e-6);  // m^3/s: more than twice what comes
  const Solved solved(network, conditions);
  CHECK(solved.p[1] == 0);
  CHECK(solved.fill[1] == doctest::Approx(2e-6 / full).epsilon(10 * kBalanced));
  // With more than it can take the node has a pressure.
  network.elements[0].law = GivenFlow{1.5 * full};
  const Solved ample(network, conditions);
  CHECK(ample.fill[1] == 1);
  CHECK(ample.p[1] > 0);
}

// S = S0 exp(-Q t/S0) at the cavitation pressure; backward Euler has 1/(1 + Q dt/S0) for each step.
TEST_CASE("GalleryWithoutSupply_RunsEmptyByItsBalance") {
  const double rate = 2e-5, duration = 10;  // m^3/s, s
  for (const double free_air : {0.0, 0.03}) {
    const Network network{
        .nodes = {{"sump", true}, open_to_air("gallery", Storage{.volume = 1e-4, .free_air = free_air})},
        .elements = {{"out", 1, 0, GivenFlow{rate}}}};
    const Circuit circuit(network);
    const double full = circuit.content(Eigen::Vector2d::Zero())[1];
    const auto left_after = [&](int steps) {
      Conditions conditions = at_rest(network);
      conditions.dt = duration / steps;
      Eigen::VectorXd p = Eigen::Vector2d::Zero();
      for (int k = 0; k < steps; ++k) {
        conditions.content = circuit.content(p);
        REQUIRE(circuit.solve(conditions, circuit.nothing_drawn(), p).solved());
        CHECK(circuit.pressures(p)[1] == 0);
      }
      const double left = circuit.content(p)[1];
      CHECK(left == doctest::Approx(full * circuit.fills(p)[1]).epsilon(kRoundOff));
      CHECK(left == doctest::Approx(full * std::pow(1 + rate * conditions.dt / full, -steps))
                        .epsilon(1e-9));  // 1e-12 of each step, over 200
      return left;
    };
    const double exact = full * std::exp(-rate * duration / full);
    const double coarse = std::abs(left_after(100) - exact), fine = std::abs(left_after(200) - exact);
    CHECK(std::abs(std::log2(coarse / fine) - 1) < 0.05);  // first order
  }
}

// A volume between an inlet and a pump that asks for more: pressure falls, fill falls, and oil is conserved throughout.
TEST_CASE("OilIsConserved_WhereAVolumeLosesItsPressure") {
  const Network network{
      .nodes = {{"sump", true}, open_to_air("gallery", Storage{.volume = 2e-6, .free_air = 0.02}), open_to_air("end")},
      .elements = {{"in", 0, 1, GivenFlow{1e-6}},
                   {"pump", 1, 2, DisplacementPump{1e-8, 1e-13}, 0},
                   {"out", 2, 0, Orifice{.diameter = 1e-3}}}};
  const Circuit circuit(network);
  Conditions conditions = at_rest(network);
  conditions.dt = 5e-3;  // s
  Eigen::VectorXd p = Eigen::Vector3d(0, 3e5, 0);
  const double before = circuit.content(p).sum();
  double came_in = 0, least = 1;
  for (int k = 0; k < 200; ++k) {
    conditions.speeds[0] = 200 + 190 * std::sin(0.1 * k);  // rad/s: 2e-6 m^3/s and less or more
    conditions.content = circuit.content(p);
    REQUIRE(circuit.solve(conditions, circuit.nothing_drawn(), p).solved());
    const Eigen::VectorXd Q = circuit.flows(p, conditions);
    came_in += conditions.dt * (Q[0] - Q[2]);
    const double fill = circuit.fills(p)[1];
    CHECK(fill >= 0);
    CHECK((fill == 1 || circuit.pressures(p)[1] == 0));
    least = std::min(least, fill);
  }
  CHECK(least < 0.7);
  CHECK(std::abs(circuit.content(p).sum() - before - came_in) < 200 * kBalanced * before);
}

Network engine_without_oil() {
  return {.nodes = {{"sump", true},
                    open_to_air("gallery", Storage{.volume = 1e-5, .free_air = 0.03}),
                    open_to_air("main"),
                    {.name = "pin", .fill_scale = 3e5, .p_cav = 0}},
          .elements = {{"pump", 0, 1, DisplacementPump{1e-8, 2e-12}, 0},
                       {"drilling", 1, 2, Drilling{.length = 0.08, .diameter = 5e-3, .loss_coefficient = 1.5}},
                       {"crank", 2, 3, Drilling{.length = 0.06, .diameter = 4e-3}, 0, 0.03, 0.055},
                       {"jet", 3, 0, Orifice{.diameter = 1.5e-3}},
                       {"relief", 1, 0, ReliefValve{}}},
          .oil = {.mu = 0.01, .density = 860}};
}

TEST_CASE("BalanceOfStarvedNodes_HasTheDerivativesOfItsDifferences") {
  const Circuit circuit(engine_without_oil());
  Conditions conditions = at_rest(circuit.network());
  conditions.speeds[0] = 500;
  conditions.dt = 1e-4;  // s
  for (const Eigen::Vector4d& fills : {Eigen::Vector4d(1, 0.4, 1, 0.7), Eigen::Vector4d(1, 1, 0.2, 0.9),
                                       Eigen::Vector4d(1, 0.9, 0.6, 1), Eigen::Vector4d(1, 0.5, 0.4, 0.3)}) {
    Eigen::VectorXd p(4);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      p[k] = fills[k] < 1 ? (fills[k] - 1) * circuit.fill_scale(i) : 1e5 * static_cast<double>(i);
    }
    conditions.content = 0.99 * circuit.content(p);
    Circuit::Balance balance, after, before;
    circuit.evaluate(p, conditions, balance);
    for (Eigen::Index k = 1; k < p.size(); ++k) {
      const double step = 1e-5 * circuit.fill_scale(static_cast<std::size_t>(k));  // of the fill, or some Pa
      circuit.evaluate(p + step * Eigen::VectorXd::Unit(4, k), conditions, after);
      circuit.evaluate(p - step * Eigen::VectorXd::Unit(4, k), conditions, before);
      const Eigen::VectorXd difference = (after.surplus - before.surplus) / (2 * step);
      CHECK((balance.by_p.col(k) - difference).norm() <= 1e-6 * difference.norm());  // bends of laws over such a step
    }
  }
}

TEST_CASE("AmpleSupply_IsThatOfOilWithoutCavitation") {
  Network network = engine_without_oil();
  network.elements[0].law = GivenFlow{4e-4};
  Conditions conditions = at_rest(network);
  conditions.speeds[0] = 500;
  const Solved ample(network, conditions);
  for (Node& node : network.nodes) node.storage.reset(), node.p_cav = -1e9;  // Pa: oil bears any tension
  const Solved in_tension(network, conditions);
  CHECK(ample.fill.minCoeff() == 1);
  for (Eigen::Index i = 0; i < 4; ++i) CHECK(ample.p[i] == doctest::Approx(in_tension.p[i]).epsilon(kBalanced * 10));
}

// Random circuits that lack oil in places: a solution with 0 <= fill <= 1 and p >= p_cav, one of them at its bound, and
// the same wherever the search begins, in whatever order nodes stand and in whichever direction flows count.
TEST_CASE("StarvedCircuits_HaveOneSolution") {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int starved = 0;
  for (int circuit_number = 0; circuit_number < 60; ++circuit_number) {
    CAPTURE(circuit_number);
    Network network{.nodes = {{"sump", true}}, .oil = {.mu = 0.01, .density = 860}};
    const std::size_t count = 3 + random() % 5, drain = count + 1;
    for (std::size_t k = 1; k <= count; ++k)
      network.nodes.push_back(
          {.name = "n" + std::to_string(k), .fill_scale = std::pow(10, between(4, 7)), .p_cav = 0});  // Pa
    network.nodes.push_back({"vacuum", true});
    const auto add = [&](std::size_t from, std::size_t to) {
      if (from == to) return;
      Element element{.name = "e", .from = from, .to = to, .law = Resistance{std::pow(10, between(9, 11))}};
      const unsigned kind = random() % 4;
      if (kind == 1) element.law = GivenFlow{between(1e-7, 1e-5)};
      if (kind == 2) element.law = Orifice{.diameter = between(0.5e-3, 2e-3)};
      if (kind == 3) {
        element.law = Drilling{.length = 0.05, .diameter = between(1e-3, 4e-3)};
        element.shaft = 0, element.r_from = between(0, 0.05), element.r_to = between(0, 0.05);
      }
      network.elements.push_back(std::move(element));
    };
    for (std::size_t k = 1; k <= count; ++k)
      add(k, random() % k), network.elements.push_back({"drain", k, drain, Resistance{1e11}});
    for (std::size_t k = 0; k < count; ++k) add(random() % (count + 1), random() % (count + 1));
    Conditions conditions = at_rest(network);
    conditions.speeds[0] = 400;
    conditions.given[static_cast<Eigen::Index>(drain)] = -1e5;
    const Solved solved(network, conditions);
    CHECK(solved.fill.minCoeff() >= -kRoundOff);
    const auto nodes = static_cast<Eigen::Index>(drain);
    CHECK(solved.p.head(nodes).minCoeff() >= 0);
    for (Eigen::Index i = 0; i < nodes; ++i) CHECK((solved.fill[i] == 1 || solved.p[i] == 0));
    if (solved.fill.minCoeff() < 1) ++starved;
    // Balances of 1e-13 in stiff chains; and round-off of laws that carry 1e-5 m^3/s and more.
    const double same = 1e-9 * solved.Q.cwiseAbs().maxCoeff() + 1e-18;
    for (int start = 0; start < 3; ++start) {
      Eigen::VectorXd from(solved.p.size());
      for (double& p : from) p = between(-1e5, 5e5);
      CHECK((Solved(network, conditions, from).Q - solved.Q).lpNorm<Eigen::Infinity>() < same);
    }
    // Nodes in the opposite order, and elements that count the other way but for given flows.
    Network turned = network;
    std::reverse(turned.nodes.begin(), turned.nodes.end());
    Conditions of_turned = conditions;
    of_turned.given = conditions.given.reverse().eval();
    Eigen::VectorXd sign = Eigen::VectorXd::Ones(solved.Q.size());
    for (std::size_t e = 0; e < turned.elements.size(); ++e) {
      Element& element = turned.elements[e];
      element.from = drain - element.from, element.to = drain - element.to;
      if (std::holds_alternative<GivenFlow>(element.law)) continue;
      std::swap(element.from, element.to), std::swap(element.r_from, element.r_to);
      sign[static_cast<Eigen::Index>(e)] = -1;
    }
    CHECK((Solved(turned, of_turned).Q.cwiseProduct(sign) - solved.Q).lpNorm<Eigen::Infinity>() < same);
  }
  CHECK(starved > 20);  // of 60
}

}  // namespace starved_circuit_test
}  // namespace hersey::circuit
