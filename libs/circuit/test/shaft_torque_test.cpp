#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "hersey/circuit/circuit.h"

// Torques that pumps and rotating bores take from their shafts.
namespace hersey::circuit {
namespace shaft_torque_test {

constexpr double kRoundOff = 16 * std::numeric_limits<double>::epsilon();

Conditions between(double p_from, double p_to, double omega) {
  return {.given = Eigen::Vector2d(p_from, p_to), .speeds = Eigen::VectorXd::Constant(1, omega)};
}

TEST_CASE("PumpTakesThePowerOfItsOil") {
  for (const double efficiency : {1.0, 0.8}) {
    const Circuit circuit({.nodes = {{"sump", true}, {"gallery", true}},
                           .elements = {{"pump", 0, 1, DisplacementPump{2e-6, 0, efficiency}, 0}}});
    for (const double rise : {5e5, -2e5}) {  // Pa: it lifts oil, and oil drives it
      const Conditions conditions = between(1e4, 1e4 + rise, 300);
      const double Q = circuit.flow(0, conditions.given, conditions).value;
      const double loss = rise > 0 ? 1 / efficiency : efficiency;
      CHECK(circuit.torque(0, conditions.given, conditions) * 300 ==
            doctest::Approx(Q * rise * loss).epsilon(kRoundOff));
    }
  }
}

// Filled in part it gives that part, for that part of the torque.
TEST_CASE("PumpOfAStarvedNode_TakesThePowerOfItsOil") {
  const Circuit circuit({.nodes = {{"sump", true}, {.name = "inlet", .p_cav = 0}, {"gallery", true}},
                         .elements = {{"in", 0, 1, GivenFlow{1e-4}}, {"pump", 1, 2, DisplacementPump{2e-6}, 0}}});
  Conditions conditions{.given = Eigen::Vector3d(0, 0, 4e5), .speeds = Eigen::VectorXd::Constant(1, 300)};
  Eigen::VectorXd p = circuit.start(conditions);
  REQUIRE(circuit.solve(conditions, circuit.nothing_drawn(), p).solved());
  REQUIRE(circuit.fills(p)[1] < 0.2);
  CHECK(circuit.torque(1, p, conditions) * 300 == doctest::Approx(1e-4 * 4e5).epsilon(1e-12));  // a balance of 1e-13
}

TEST_CASE("RotatingBore_TakesTwiceTheWorkOfItsHead") {
  const double omega = 400, density = 860;
  Network network{.nodes = {{"main", true}, {"pin", true}},
                  .elements = {{"crank", 0, 1, Drilling{.length = 0.06, .diameter = 3e-3}, 0, 0.03, 0.055}},
                  .oil = {.mu = 0.01, .density = density}};
  for (const double p_pin : {0.0, 3e5}) {  // Pa: oil flows outwards, and inwards
    const Conditions conditions = between(1e5, p_pin, omega);
    const double Q = Circuit(network).flow(0, conditions.given, conditions).value;
    CHECK((Q > 0) == (p_pin == 0));
    const double head = 0.5 * density * omega * omega * (0.055 * 0.055 - 0.03 * 0.03);
    const double torque = Circuit(network).torque(0, conditions.given, conditions);
    CHECK(torque * omega == doctest::Approx(2 * Q * head).epsilon(kRoundOff));
    // Counted the other way it is the same bore.
    Network reversed = network;
    std::swap(reversed.elements[0].from, reversed.elements[0].to);
    std::swap(reversed.elements[0].r_from, reversed.elements[0].r_to);
    CHECK(Circuit(reversed).torque(0, conditions.given, conditions) == doctest::Approx(torque).epsilon(kRoundOff));
    // Rotating the other way it brakes as much.
    const Conditions backwards = between(1e5, p_pin, -omega);
    CHECK(Circuit(network).torque(0, backwards.given, backwards) == doctest::Approx(-torque).epsilon(kRoundOff));
  }
}

}  // namespace shaft_torque_test
}  // namespace hersey::circuit
