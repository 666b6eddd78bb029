#include "hersey/solver/generalized_alpha.h"

#include <doctest/doctest.h>

#include <cmath>

#include "hersey/core/contract.h"
#include "one_coordinate.h"

namespace hersey::solver {
namespace generalized_alpha_test {

test::OneCoordinate oscillator(double omega) {
  test::OneCoordinate e;
  e.force = [omega](double q, double, double) { return omega * omega * q; };
  e.force_by_q = [omega](double, double, double) { return omega * omega; };
  return e;
}

/// A mass falling on a gas that resists as 1/q^3: outside its domain at q <= 0.
test::OneCoordinate cushion() {
  test::OneCoordinate e;
  e.lowest = 0;
  e.force = [](double q, double, double) { return 1 - 1e-6 / (q * q * q); };
  e.force_by_q = [](double q, double, double) { return 3e-6 / (q * q * q * q); };
  return e;
}

TEST_CASE("SpectralRadius_IsTheDampingOfFastOscillations") {
  // At omega dt = 1e4 the amplification per step has reached its limit: a triple eigenvalue in one Jordan block, so the
  // amplitude is proportional to n^2 rho^n (lower powers of n aside), and its logarithm changes from n to 2n by n
  // log(rho) + 2 log(2).
  for (double rho : {0.7, 0.8, 0.9, 0.95}) {
    CAPTURE(rho);
    test::OneCoordinate e = oscillator(1e4);
    State s = e.at(1, 0);
    GeneralizedAlpha integrator({.spectral_radius = rho, .rtol = 1e-12});
    const int n = static_cast<int>(-20 / std::log(rho));
    double before = 0;
    for (int i = 1; i <= 2 * n; ++i) {
      REQUIRE(integrator.step(e, s, 1).solved());
      if (i == n) before = std::abs(s.q[0]);
    }
    const double observed = std::log(std::abs(s.q[0]) / before);
    CHECK(observed > n * std::log(rho) + 1.5 * std::log(2));
    CHECK(observed < n * std::log(rho) + 2.5 * std::log(2));
  }
}

TEST_CASE("Oscillator_IsOfOrderTwo") {
  const auto error = [](int steps) {
    test::OneCoordinate e = oscillator(3);
    State s = e.at(1, 0);
    GeneralizedAlpha integrator({.spectral_radius = 0.7, .rtol = 1e-9});
    for (int i = 0; i < steps; ++i) REQUIRE(integrator.step(e, s, 2.0 / steps).solved());
    return std::abs(s.q[0] - std::cos(6.0));
  };
  CHECK(std::abs(std::log2(error(400) / error(800)) - 2) < 0.05);
}

TEST_CASE("LinearEquations_TakeOneIterationAndHooksInOrder") {
  test::OneCoordinate e = oscillator(3);
  State s = e.at(1, 0);
  GeneralizedAlpha integrator({.spectral_radius = 1});
  // The first step also looks for motions that damping ends within it: two evaluations, and another beginning.
  REQUIRE(integrator.step(e, s, 0.1).solved());
  CHECK(e.begun == 2);
  CHECK(e.accepted == 1);
  CHECK(e.assembled == 4);
  e.begun = e.accepted = e.assembled = 0;
  const StepSummary summary = integrator.step(e, s, 0.1);
  CHECK(summary.solved());
  CHECK(summary.iterations == 1);
  CHECK(summary.residual <= 1);
  CHECK(summary.message.empty());
  CHECK(e.begun == 1);
  CHECK(e.accepted == 1);
  CHECK(e.assembled == 2);
  CHECK(s.t == doctest::Approx(0.2));
}

// A pendulum: each iteration divides the residual by more than twenty, so the first tangent does for the step; where
// unknowns are condensed every iteration takes its own, to the same answer.
TEST_CASE("FactorsThatServe_AreKept") {
  const auto pendulum = [] {
    test::OneCoordinate e;
    e.force = [](double q, double, double) { return 10 * std::sin(q); };
    e.force_by_q = [](double q, double, double) { return 10 * std::cos(q); };
    return e;
  };
  test::OneCoordinate plain = pendulum(), condensing = pendulum();
  condensing.condenses = true;
  State s = plain.at(2, 0), t = s;
  GeneralizedAlpha integrator({.spectral_radius = 0.8, .rtol = 1e-12}), other({.spectral_radius = 0.8, .rtol = 1e-12});
  int iterations = 0;
  for (int k = 0; k < 10; ++k) {
    plain.tangents = 0;
    const StepSummary summary = integrator.step(plain, s, 0.05);
    REQUIRE(summary.solved());
    REQUIRE(other.step(condensing, t, 0.05).solved());
    if (k > 0) CHECK(plain.tangents == 1);
    iterations += summary.iterations;
    CHECK(s.q[0] == doctest::Approx(t.q[0]).epsilon(1e-12));  // both are solved to 1e-12
  }
  CHECK(iterations >= 20);
  CHECK(condensing.tangents >= 20);
}

// At a stop that hardens with the cube of its depth old factors do not converge: the step computes new ones and
// converges.
TEST_CASE("FactorsThatDoNotServe_AreReplaced") {
  test::OneCoordinate e;
  e.force = [](double q, double, double) { return q < 0 ? 1e13 * q * q * q : 0.0; };
  e.force_by_q = [](double q, double, double) { return q < 0 ? 3e13 * q * q : 0.0; };
  State s = e.at(0.001, -1);
  GeneralizedAlpha integrator({.spectral_radius = 0.8, .max_iterations = 20});
  REQUIRE(integrator.step(e, s, 0.0005).solved());
  e.tangents = 0;
  REQUIRE(integrator.step(e, s, 0.002).solved());
  CHECK(e.tangents >= 2);
}

TEST_CASE("ClosedGap_ShortensTheIncrementAndContinues") {
  // The predictor, and Newton's first increments, pass through the cushion; the step still has an answer on this side.
  test::OneCoordinate e = cushion();
  State s = e.at(0.1, -3);
  GeneralizedAlpha integrator({.spectral_radius = 0.5, .max_iterations = 60});
  const StepSummary summary = integrator.step(e, s, 0.05);
  INFO(summary.message);
  CHECK(summary.solved());
  CHECK(s.q[0] > 0);
  CHECK(s.q[0] < 0.1);
}

TEST_CASE("FailedStep_LeavesTheStateAndGivesTheReason") {
  SUBCASE("outside the domain from the start") {
    test::OneCoordinate e = cushion();
    e.lowest = 1;
    State s = e.at(0.1, -3);
    const State before = s;
    GeneralizedAlpha integrator;
    const StepSummary summary = integrator.step(e, s, 0.05);
    CHECK(summary.status == StepStatus::domain_error);
    CHECK(summary.message.find("gap closed") != std::string::npos);
    CHECK(s.q == before.q);
    CHECK(s.t == before.t);
    CHECK(e.accepted == 0);
  }
  SUBCASE("too few iterations") {
    test::OneCoordinate e = cushion();
    State s = e.at(0.1, -3);
    const State before = s;
    GeneralizedAlpha integrator({.max_iterations = 2});
    const StepSummary summary = integrator.step(e, s, 0.05);
    CHECK(summary.status == StepStatus::no_convergence);
    CHECK(summary.worst_row == "mass");
    CHECK(summary.message.find("mass") != std::string::npos);
    CHECK(summary.message.find("2 iterations") != std::string::npos);
    CHECK(s.v == before.v);
  }
  SUBCASE("a condensed equation not solved") {
    test::OneCoordinate e = oscillator(3);
    e.internal = 1e-3;
    State s = e.at(1, 0);
    GeneralizedAlpha integrator({.max_iterations = 3});
    const StepSummary summary = integrator.step(e, s, 0.1);
    CHECK(summary.status == StepStatus::no_convergence);
    CHECK(summary.worst_row == "film of the fake");
  }
  SUBCASE("singular") {
    test::OneCoordinate e;
    e.mass = 0;
    e.force = [](double, double, double) { return 1.0; };
    State s = e.at(0, 0);
    s.vdot.setZero();
    GeneralizedAlpha integrator({.spectral_radius = 1});
    CHECK(integrator.step(e, s, 0.1).status == StepStatus::singular);
  }
}

TEST_CASE("RejectedStep_CanBeRepeatedShorter") {
  // A run repeats a failed step with half its length: the result equals that of the half step alone.
  test::OneCoordinate e = oscillator(3), fresh = oscillator(3);
  GeneralizedAlpha integrator({.spectral_radius = 0.7}), other({.spectral_radius = 0.7});
  State s = e.at(1, 0), alone = s;
  REQUIRE(integrator.step(e, s, 0.1).solved());
  REQUIRE(other.step(fresh, alone, 0.1).solved());
  e.internal = 1;
  CHECK(!integrator.step(e, s, 0.1).solved());
  e.internal = 0;
  REQUIRE(integrator.step(e, s, 0.05).solved());
  REQUIRE(other.step(fresh, alone, 0.05).solved());
  CHECK(s.q == alone.q);
  CHECK(s.v == alone.v);
}

TEST_CASE("BadOptions_AreRejected") {
  CHECK_THROWS_AS(GeneralizedAlpha({.spectral_radius = 1.1}), ContractError);
  CHECK_THROWS_AS(GeneralizedAlpha({.rtol = 0}), ContractError);
}

}  // namespace generalized_alpha_test
}  // namespace hersey::solver
