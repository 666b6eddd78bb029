#include <doctest/doctest.h>

#include <cmath>

#include "hersey/solver/generalized_alpha.h"
#include "hersey/solver/second_order_history.h"
#include "one_coordinate.h"

namespace hersey::solver {
namespace condensed_unknowns_test {

constexpr double omega2 = 30;

/// The step's end by hand of what the integrator does to a system of its own: x'' = sin t - omega^2 x.
void step(SecondOrderHistory& history, double t_end, double dt, bool fresh) {
  const AlphaParameters p(0.8);
  const Stage stage{.dt = dt,
                    .c = p.gamma / (p.beta * dt),
                    .m = (1 - p.alpha_m) / ((1 - p.alpha_f) * p.beta * dt * dt),
                    .parameters = p,
                    .fresh = fresh};
  history.begin_step();
  history.predict(stage);
  const double missing = std::sin(t_end) - omega2 * history.position()[0] - history.acceleration()[0];
  history.move(stage, Eigen::VectorXd::Constant(1, missing / (stage.m + omega2)));
  history.accept();
}

// Steps of changing length, starts afresh in between, and a system whose history begins when others have theirs.
TEST_CASE("CondensedUnknowns_MoveAsThoseOfTheSystem") {
  test::OneCoordinate system;
  system.force = [](double q, double, double t) { return omega2 * q - std::sin(t); };
  system.force_by_q = [](double, double, double) { return omega2; };
  for (const bool others_have_moved : {false, true}) {
    CAPTURE(others_have_moved);
    State s = system.at(0, 0);
    GeneralizedAlpha integrator({.spectral_radius = 0.8, .rtol = 1e-14});
    SecondOrderHistory history;
    history.start(Eigen::VectorXd::Zero(1));
    for (int k = 0; k < 40; ++k) {
      CAPTURE(k);
      const bool fresh = k == 0 || k == 15 || k == 16;
      if (fresh) integrator.reset();
      const double dt = k % 3 == 0 ? 0.04 : 0.07;
      REQUIRE(integrator.step(system, s, dt).solved());
      step(history, s.t, dt, fresh && !(others_have_moved && k == 0));
      constexpr double round_off = 1e-13;  // of motions of 0.1, velocities of 1
      CHECK(std::abs(history.position()[0] - s.q[0]) < round_off);
      CHECK(std::abs(history.rate()[0] - s.v[0]) < 10 * round_off);
    }
    CHECK(std::abs(s.q[0]) < 0.2);
  }
}

/// A stiff pendulum with condensed unknowns over equal steps.
test::OneCoordinate swung(bool needs_tangent, State& s) {
  test::OneCoordinate system;
  system.force = [](double q, double, double) { return omega2 * std::sinh(3 * q); };
  system.force_by_q = [](double q, double, double) { return 3 * omega2 * std::cosh(3 * q); };
  system.condenses = true;
  system.needs = needs_tangent;
  s = system.at(0.8, 0);
  GeneralizedAlpha integrator({.spectral_radius = 0.8, .rtol = 1e-10});
  for (int k = 0; k < 60; ++k) REQUIRE(integrator.step(system, s, 0.02).solved());
  return system;
}

// What ends a step is found without a tangent, unless condensed unknowns need it.
TEST_CASE("TheLastResidualOfAStep_TakesNoTangent") {
  State with, without;
  const test::OneCoordinate whole = swung(true, with), light = swung(false, without);
  CHECK(whole.tangents == whole.assembled);
  CHECK(light.tangents <= light.assembled - 50);
  // A residual that was expected to be the last and is not is found again with the tangent.
  CHECK(light.assembled <= whole.assembled + 10);
  constexpr double converged = 1e-8;  // of motions of 0.8, velocities of 10: steps are solved to 1e-10
  CHECK(std::abs(with.q[0] - without.q[0]) < converged);
  CHECK(std::abs(with.v[0] - without.v[0]) < 10 * converged);
}

// An iteration that begins where the acceleration would go on as over the last step ends sooner and at the same motion.
TEST_CASE("SmoothMotionInEqualSteps_IsPredictedFromTwoSteps") {
  const auto iterations = [](double other_length) {
    test::OneCoordinate system;
    system.force = [](double q, double, double) { return omega2 * std::sin(q); };
    system.force_by_q = [](double q, double, double) { return omega2 * std::cos(q); };
    system.condenses = true;
    State s = system.at(1, 0);
    GeneralizedAlpha integrator({.spectral_radius = 0.8});
    int sum = 0;
    for (int k = 0; k < 100; ++k) {
      const StepSummary step = integrator.step(system, s, k % 2 == 0 ? 0.025 : other_length);
      REQUIRE(step.solved());
      sum += step.iterations;
    }
    return sum;
  };
  CHECK(iterations(0.025) < 0.75 * iterations(0.024));
}

}  // namespace condensed_unknowns_test
}  // namespace hersey::solver
