#include "hersey/circuit/circuit.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>

namespace hersey::circuit {
namespace circuit_test {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kSolved = 1e-11;  // nodes are balanced to 1e-13, and none is a hundred times softer than another

// A pump, its relief valve, a drilling and an orifice to two main bearings, a drilling in the crank to a pin.
// Solved by an independent program (scipy, to 1e-12).
struct ReferenceCase {
  double omega, p_gallery, p_main1, p_main2, p_pin, Q_relief, Q_drill1, Q_orifice, Q_crank;
};
constexpr ReferenceCase kReference[] = {
    {0, 526573.0133688538, 520636.4486317433, 220145.134018049, 514737.9858034231, 0.0002531460267377077,
     0.00011383220315958627, 3.3021770102707354e-05, 6.176855829641077e-05},
    {600, 509469.8566883568, 501713.73772214836, 215590.45392863662, 821252.8730148001, 0.00021893971337671358,
     0.00014872171853398948, 3.233856808929546e-05, 9.855034476177601e-05}};

Network engine() {
  Network network{
      .nodes = {{"sump", true}, {"gallery"}, {"main1"}, {"main2"}, {"pin"}},
      .elements = {{"pump", 0, 1, GivenFlow{4e-4}},
                   {"relief", 1, 0, ReliefValve{.opening_pressure = 4e5, .conductance = 2e-9}},
                   {"drilling", 1, 2, Drilling{.length = 0.08, .diameter = 5e-3, .friction = Friction::laminar}},
                   {"orifice", 1, 3, Orifice{.diameter = 1.5e-3, .discharge_coefficient = 0.7}},
                   {"crank", 2, 4, Drilling{.length = 0.06, .diameter = 4e-3, .friction = Friction::laminar}, 0, 0.03,
                    0.055}},
      .oil = {.mu = 0.01, .density = 860}};
  return network;
}

Conditions at_speed(const Network& network, double omega) {
  return {.given = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(network.nodes.size())),
          .speeds = Eigen::VectorXd::Constant(1, omega)};
}

// Ports that take oil in proportion to their pressure.
Drawn ports(const Circuit& circuit) {
  Drawn drawn = circuit.nothing_drawn();
  drawn.by_p.diagonal().tail<3>() << 1e-10, 1.5e-10, 1.2e-10;  // m^3/(Pa s)
  return drawn;
}

TEST_CASE("EngineCircuit_HasThePressuresAndFlowsOfTheReference") {
  for (const ReferenceCase& expected : kReference) {
    CAPTURE(expected.omega);
    const Circuit circuit(engine());
    const Conditions conditions = at_speed(circuit.network(), expected.omega);
    Eigen::VectorXd p = circuit.start(conditions);
    REQUIRE(circuit.solve(conditions, ports(circuit), p).solved());
    const Eigen::VectorXd Q = circuit.flows(p, conditions);
    const double same = 1e-8;  // Torricelli's flow here has a creeping limit: 18 Pa over 3e5 Pa squared
    CHECK(p[1] == doctest::Approx(expected.p_gallery).epsilon(same));
    CHECK(p[2] == doctest::Approx(expected.p_main1).epsilon(same));
    CHECK(p[3] == doctest::Approx(expected.p_main2).epsilon(same));
    CHECK(p[4] == doctest::Approx(expected.p_pin).epsilon(same));
    CHECK(Q[1] == doctest::Approx(expected.Q_relief).epsilon(same));
    CHECK(Q[2] == doctest::Approx(expected.Q_drill1).epsilon(same));
    CHECK(Q[3] == doctest::Approx(expected.Q_orifice).epsilon(same));
    CHECK(Q[4] == doctest::Approx(expected.Q_crank).epsilon(same));
  }
}

TEST_CASE("OilIsConserved_WhatThePumpGivesIsWhatPortsAndValveTake") {
  const Circuit circuit(engine());
  const Conditions conditions = at_speed(circuit.network(), 450);
  Eigen::VectorXd p = circuit.start(conditions);
  REQUIRE(circuit.solve(conditions, ports(circuit), p).solved());
  const Eigen::VectorXd Q = circuit.flows(p, conditions), taken = ports(circuit).by_p * p;
  CHECK(std::abs(Q[0] - Q[1] - taken.sum()) < 1e-12 * Q[0]);  // five nodes, each balanced to 1e-13
}

// Nothing flows: the column in a rotating drilling bears the centrifugal head alone.
// What pump and rotation put into the oil is dissipated in elements, or goes with the oil that is drawn.
TEST_CASE("WorkOfTheSources_IsDissipatedInTheElements") {
  for (const double omega : {0.0, 600.0}) {
    CAPTURE(omega);
    const Circuit circuit(engine());
    const Conditions conditions = at_speed(circuit.network(), omega);
    const Drawn drawn = ports(circuit);
    Eigen::VectorXd p = circuit.start(conditions);
    REQUIRE(circuit.solve(conditions, drawn, p).solved());
    const Eigen::VectorXd Q = circuit.flows(p, conditions);
    double dissipated = 0;
    for (std::size_t e = 0; e < circuit.network().elements.size(); ++e)
      dissipated += circuit.dissipation(e, p, conditions);
    const double head = 0.5 * 860 * omega * omega * (0.055 * 0.055 - 0.03 * 0.03);
    const double put_in = Q[0] * (p[1] - p[0]) + Q[4] * head, taken = p.dot(drawn.by_p * p);
    CHECK(dissipated == doctest::Approx(put_in - taken).epsilon(kSolved));
  }
  // A leak of a pump dissipates by its square, a curve that was measured says nothing.
  const Network pump{.nodes = {{"sump", true}, {"high", true}},
                     .elements = {{"pump", 0, 1, DisplacementPump{2e-6, 3e-11}, 0}, {"flow", 0, 1, GivenFlow{1e-4}}}};
  Conditions conditions = at_speed(pump, 300);
  conditions.given[1] = 5e5;
  const Circuit circuit(pump);
  CHECK(circuit.dissipation(0, conditions.given, conditions) == doctest::Approx(3e-11 * 25e10).epsilon(4 * kEps));
  CHECK(circuit.dissipation(1, conditions.given, conditions) == 0);
}

// A drilling through the axis from a journal to a pin, at 500 rad/s: the oil has to be pressed inwards first.
TEST_CASE("PressureAtTheAxis_IsThatOfTwoDrillingsThatMeetThere") {
  const double omega = 500, inside = 0.5 * 860 * omega * omega * 0.03 * 0.03;
  CHECK(inside == doctest::Approx(96750).epsilon(4 * kEps));  // of an independent program
  const Drilling bore{.length = 0.08, .diameter = 4e-3, .friction = Friction::laminar};
  Network whole{.nodes = {{"journal", true}, {"pin", true}},
                .elements = {{"crank", 0, 1, bore, 0, 0.03, 0.05, true}},
                .oil = {.mu = 0.01, .density = 860}};
  Drilling first = bore, second = bore;
  first.length = 0.03, second.length = 0.05;
  const Network halves{
      .nodes = {{"journal", true}, {"pin", true}, {.name = "axis", .p_cav = -1e6}},  // Pa: an unbroken column
      .elements = {{"in", 0, 2, first, 0, 0.03, 0}, {"out", 2, 1, second, 0, 0, 0.05}},
      .oil = whole.oil};
  Conditions conditions = at_speed(whole, omega), of_halves = at_speed(halves, omega);
  for (const double p_pin : {-1e5, 172000.0, 4e5}) {
    conditions.given << 0, p_pin;
    of_halves.given.head<2>() = conditions.given;
    const Circuit one(whole), two(halves);
    Eigen::VectorXd p = two.start(of_halves);
    REQUIRE(two.solve(of_halves, two.nothing_drawn(), p).solved());
    const double scale = std::abs(p_pin) + inside;
    CHECK(std::abs(one.pressure_at_axis(0, conditions.given, conditions) - p[2]) < kSolved * scale);
    std::swap(whole.elements[0].from, whole.elements[0].to);
    std::swap(whole.elements[0].r_from, whole.elements[0].r_to);
    CHECK(std::abs(Circuit(whole).pressure_at_axis(0, conditions.given, conditions) - p[2]) < kSolved * scale);
    std::swap(whole.elements[0].from, whole.elements[0].to);
    std::swap(whole.elements[0].r_from, whole.elements[0].r_to);
  }
}

TEST_CASE("ElementsWithViscositiesOfTheirOwn_AreThoseOfAnOilThatHasThem") {
  Network thick = engine();
  thick.oil.mu = 0.025;
  const Circuit own(engine()), circuit(thick);
  Conditions conditions = at_speed(thick, 600);
  const Eigen::VectorXd p = circuit.start(conditions) * 0.9;
  const Eigen::VectorXd expected = circuit.flows(p, conditions);
  conditions.viscosities = Eigen::VectorXd::Constant(5, 0.025);
  CHECK(own.flows(p, conditions) == expected);
}

TEST_CASE("CentrifugalHead_IsExactWithoutFlow") {
  Network network{.nodes = {{"axis", true}, {"outlet"}},
                  .elements = {{"drilling", 0, 1, Drilling{}, 0, 0.03, 0.05}},
                  .oil = {.mu = 0.01, .density = 860}};
  const Circuit circuit(network);
  Conditions conditions = at_speed(network, 500);
  conditions.given[0] = 2e5;  // Pa
  Eigen::VectorXd p = circuit.start(conditions);
  REQUIRE(circuit.solve(conditions, circuit.nothing_drawn(), p).solved());
  const double head = 860 * 500.0 * 500.0 * (0.05 * 0.05 - 0.03 * 0.03) / 2;
  CHECK(head == doctest::Approx(172000).epsilon(8 * kEps));  // of the reference
  CHECK(p[1] - p[0] == doctest::Approx(head).epsilon(kSolved));
}

Network wide() {
  Network network = engine();
  network.nodes[1].storage = Storage{.volume = 3e-4, .wall_compliance = 1e-12, .free_air = 0.03};
  network.nodes[2].storage = Storage{.volume = 5e-5};
  network.elements[2].law = Drilling{.length = 0.08, .diameter = 5e-3, .roughness = 1e-5, .loss_coefficient = 1.5};
  network.elements[0].law = DisplacementPump{.displacement = 1.2e-6, .leakage = 2e-11};
  network.elements[0].shaft = 0;
  return network;
}

TEST_CASE("BalanceOfNodes_HasTheDerivativesOfItsDifferences") {
  const Circuit circuit(wide());
  Conditions conditions = at_speed(circuit.network(), 300);
  conditions.dt = 1e-4;  // s
  Eigen::VectorXd p(5);
  p << 0, 4.3e5, 3.9e5, 1.2e5, 5e5;
  conditions.content = circuit.content(0.99 * p);
  Circuit::Balance balance, after, before;
  circuit.evaluate(p, conditions, balance);
  const double step = 10;  // Pa: of 1e5, and the bend of a square law
  for (Eigen::Index k = 0; k < p.size(); ++k) {
    circuit.evaluate(p + step * Eigen::VectorXd::Unit(5, k), conditions, after);
    circuit.evaluate(p - step * Eigen::VectorXd::Unit(5, k), conditions, before);
    const Eigen::VectorXd difference = (after.surplus - before.surplus) / (2 * step);
    CHECK((balance.by_p.col(k) - difference).norm() < 1e-6 * difference.norm());  // as above
  }
}

// A gallery that yields, fed through a resistance from a given pressure, fills as exp(-t/(R C)).
TEST_CASE("GalleryFills_AsAnExponential_OfFirstOrderInTheStep") {
  const double R = 2e9, volume = 1e-3, C = volume / 1.5e9, T = 2 * R * C;  // Pa s/m^3, m^3, m^3/Pa, s
  Network network{.nodes = {{"supply", true}, {"gallery", false, Storage{.volume = volume}}},
                  .elements = {{"filter", 0, 1, Resistance{R}}}};
  const Circuit circuit(network);
  const auto error_of = [&](int steps) {
    Conditions conditions = at_speed(network, 0);
    conditions.given[0] = 1e5;  // Pa
    conditions.dt = T / steps;
    Eigen::VectorXd p = Eigen::Vector2d(1e5, 0);
    for (int k = 0; k < steps; ++k) {
      conditions.content = circuit.content(p);
      REQUIRE(circuit.solve(conditions, circuit.nothing_drawn(), p).solved());
    }
    return p[1] - 1e5 * (1 - std::exp(-2.0));
  };
  const double coarse = error_of(40), fine = error_of(80);
  CHECK(std::abs(std::log2(coarse / fine) - 1) < 0.05);  // first order
  CHECK(std::abs(fine) < 1e3);                           // Pa: 1 % of the pressure at 80 steps
}

TEST_CASE("OilIsConserved_OverStepsThroughStores") {
  const Circuit circuit(wide());
  Conditions conditions = at_speed(circuit.network(), 300);
  Eigen::VectorXd p = circuit.start(conditions);
  REQUIRE(circuit.solve(conditions, ports(circuit), p).solved());
  conditions.dt = 2e-4;  // s
  const double before = circuit.content(p).sum();
  double came_in = 0, largest = 0;
  for (int k = 0; k < 50; ++k) {
    conditions.speeds[0] = 300 + 100 * std::sin(0.3 * k);
    conditions.content = circuit.content(p);
    REQUIRE(circuit.solve(conditions, ports(circuit), p).solved());
    const Eigen::VectorXd Q = circuit.flows(p, conditions);
    came_in += conditions.dt * (Q[0] - Q[1] - (ports(circuit).by_p * p).sum());
    largest = std::max(largest, Q.cwiseAbs().maxCoeff());
  }
  const double duration = 50 * conditions.dt;
  CHECK(std::abs(circuit.content(p).sum() - before - came_in) < 1e-12 * largest * duration);  // of balances of 1e-13
}

// A pump against a valve that is still closed: its increment is without bound before the valve opens.
TEST_CASE("PumpAgainstAClosedValve_OpensIt") {
  Network network{.nodes = {{"sump", true}, {"gallery"}},
                  .elements = {{"pump", 0, 1, GivenFlow{4e-4}}, {"valve", 1, 0, ReliefValve{}}}};
  const Circuit circuit(network);
  const Conditions conditions = at_speed(network, 0);
  Eigen::VectorXd p = Eigen::VectorXd::Zero(2);
  REQUIRE(circuit.solve(conditions, circuit.nothing_drawn(), p).solved());
  CHECK(p[1] == doctest::Approx(4e5 + 4e-4 / 2e-9).epsilon(kSolved));
}

TEST_CASE("FlowWithoutAWayOut_HasNoBalance_AndSaysWhere") {
  Network network{.nodes = {{"sump", true}, {"gallery"}}, .elements = {{"pump", 0, 1, GivenFlow{4e-4}}}};
  const Circuit circuit(network);
  Eigen::VectorXd p = Eigen::VectorXd::Zero(2);
  const CircuitSummary summary = circuit.solve(at_speed(network, 0), circuit.nothing_drawn(), p);
  CHECK(!summary.solved());
  CHECK(summary.message.find("gallery") != std::string::npos);
}

}  // namespace circuit_test
}  // namespace hersey::circuit
