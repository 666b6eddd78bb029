#include "hersey/solver/step_control.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hersey/solver/generalized_alpha.h"
#include "one_coordinate.h"

namespace hersey::solver {
namespace step_control_test {

Eigen::VectorXd one(double error) { return Eigen::VectorXd::Constant(1, error); }

TEST_CASE("StepControl_SettlesAtTheTargetError") {
  // A local error of third order, 8e6 dt^3 of the tolerance: half of it at dt = 0.00397.
  StepControl control({.smallest = 1e-9, .largest = 1}, 1e-6);
  for (int i = 0; i < 60; ++i) control.accepted(control.dt(), one(8e6 * std::pow(control.dt(), 3)));
  // Arrived after some 30 steps of growth; then round-off.
  CHECK(8e6 * std::pow(control.dt(), 3) == doctest::Approx(0.5).epsilon(1e-12));
}

TEST_CASE("StepControl_HitsInstantsWithoutCrumbs") {
  const StepControl control({.smallest = 1e-9, .largest = 1}, 0.3);
  CHECK(control.proposed(3) == 0.3);
  CHECK(control.proposed(0.3) == 0.3);
  // Round-off.
  CHECK(control.proposed(0.31) == doctest::Approx(0.155).epsilon(1e-15));
  CHECK(control.proposed(1) == doctest::Approx(0.25).epsilon(1e-15));
}

/// A local error (0.6 + cos t) dt^3 of a motion that passes an instant of large errors at t = 0 and returns.
TEST_CASE("StepControl_TakesTheSameStepsBeforeAndAfterALargeError") {
  StepControl control({.smallest = 1e-9, .largest = 1}, 0.02);
  std::vector<double> middle, length;
  for (double t = -3; t < 2.5;) {
    const double dt = control.dt();
    const double error = 4e4 * (1.1 + std::cos(t + 0.5 * dt)) * std::pow(dt, 3);
    REQUIRE(error <= 1);
    control.accepted(dt, one(error));
    middle.push_back(t + 0.5 * dt), length.push_back(dt);
    t += dt;
  }
  const auto length_at = [&](double t) {
    const auto i = static_cast<std::size_t>(std::lower_bound(middle.begin(), middle.end(), t) - middle.begin());
    const double share = (t - middle[i - 1]) / (middle[i] - middle[i - 1]);
    return (1 - share) * length[i - 1] + share * length[i];
  };
  for (const double t : {0.5, 1.0, 1.5, 2.0}) {
    CAPTURE(t);
    CHECK(length_at(t) > 1.02 * length_at(0));
    // A step chosen by the error before it lags by a step, 2 dt (d ln dt/dt) = 2 % here.
    CHECK(std::abs(length_at(t) / length_at(-t) - 1) < 0.002);
  }
}

TEST_CASE("StepControl_KeepsItsStepWhereAnErrorPassesThroughZero") {
  StepControl control({.smallest = 1e-9, .largest = 1}, 0.01);
  double shortest = 1, longest = 0;
  for (double t = 0; t < 6;) {
    const double dt = control.dt();
    control.accepted(dt, one(1e5 * std::cos(t + 0.5 * dt) * std::pow(dt, 3)));
    t += dt;
    if (t < 0.3) continue;
    shortest = std::min(shortest, dt), longest = std::max(longest, dt);
  }
  CHECK(longest < 2.5 * shortest);
}

TEST_CASE("StepControl_TakesPartsOfItsUnit") {
  // Parts 1, 1/2, 1/4, ... of 0.1, as large as errors of 8e6 dt^3 allow, also across an instant they cannot reach.
  StepControl control({.smallest = 1e-9, .largest = 1, .unit = 0.1}, 1e-3);
  std::vector<double> sizes;
  double t = 0;
  for (const double instant : {0.1, 0.2, 0.2123, 0.3123})
    while (instant - t > 1e-12) {
      const double dt = control.proposed(instant - t);
      REQUIRE(8e6 * std::pow(dt, 3) < 1);
      control.accepted(dt, one(8e6 * std::pow(dt, 3)));
      t += dt;
      sizes.push_back(dt);
    }
  // Round-off.
  const auto is_part = [](double dt) { return std::abs(std::log2(dt / 0.1) - std::round(std::log2(dt / 0.1))) < 1e-6; };
  const auto others = std::count_if(sizes.begin(), sizes.end(), [&](double dt) { return !is_part(dt); });
  // Round-off.
  CHECK(std::count_if(sizes.begin(), sizes.end(), [](double dt) { return std::abs(dt - 0.1 / 32) < 1e-9; }) > 90);
  CHECK(others == 4);  // 0.0123 in equal parts: one size more
}

TEST_CASE("StepControl_KeepsItsStepAfterACutOne") {
  StepControl control({.smallest = 1e-9, .largest = 1}, 0.3);
  control.accepted(0.01, one(1e-5));
  CHECK(control.dt() >= 0.3);
}

TEST_CASE("StepControl_ShortensDownToTheSmallest") {
  StepControl control({.smallest = 0.1, .largest = 1}, 0.3);
  CHECK(control.rejected(0.3, 8));
  CHECK(control.dt() == doctest::Approx(0.3 * std::cbrt(0.5 / 8)));
  CHECK(control.failed(0.12));
  CHECK(control.dt() == 0.1);
  CHECK(!control.rejected(0.1, 2));
}

TEST_CASE("StepControl_DoesNotGrowRightAfterARejection") {
  StepControl control({.smallest = 1e-9, .largest = 1}, 0.3);
  REQUIRE(control.rejected(0.3, 8));
  const double dt = control.dt();
  control.accepted(dt, one(0.01));
  CHECK(control.dt() == doctest::Approx(dt));
}

/// Largest ratio of the estimated to the true local error of q'' = -9 q, where each is not close to a zero.
double estimate_over_truth(double rho, double dt, double& smallest) {
  test::OneCoordinate e;
  e.force = [](double q, double, double) { return 9 * q; };
  e.force_by_q = [](double, double, double) { return 9.0; };
  State s = e.at(0, 3);
  GeneralizedAlpha integrator({.spectral_radius = rho, .rtol = 1e-12});
  double largest = 0;
  smallest = 1e300;
  for (int i = 0; i < 30; ++i) {
    const State before = s;
    Eigen::VectorXd error;
    const StepCheck check = [&](const State&, const Eigen::VectorXd& estimate) {
      error = estimate;
      return true;
    };
    REQUIRE(integrator.step(e, s, dt, check).solved());
    // The exact motion through the state before the step.
    const double exact = before.q[0] * std::cos(3 * dt) + before.v[0] / 3 * std::sin(3 * dt);
    const double truth = exact - s.q[0];
    // Not the transient of the start, nor where the third derivative, -9 v, is near its zero.
    if (i < 10 || std::abs(before.v[0]) < 1) continue;
    largest = std::max(largest, error[0] / truth);
    smallest = std::min(smallest, error[0] / truth);
  }
  return largest;
}

TEST_CASE("ErrorEstimate_TendsToTheLocalError") {
  // Both are of third order, their difference is of fourth: the ratio nears 1 in proportion to dt.
  for (const double rho : {0.5, 0.8, 1.0}) {
    CAPTURE(rho);
    double low = 0, low_fine = 0;
    const double high = estimate_over_truth(rho, 0.02, low), high_fine = estimate_over_truth(rho, 0.005, low_fine);
    const double coarse = std::max(high - 1, 1 - low), fine = std::max(high_fine - 1, 1 - low_fine);
    CHECK(coarse < 0.25);
    CHECK(fine < 0.4 * coarse);
  }
}

TEST_CASE("InaccurateStep_LeavesEverythingAsItWas") {
  test::OneCoordinate e;
  e.force = [](double q, double, double) { return 9 * q; };
  e.force_by_q = [](double, double, double) { return 9.0; };
  test::OneCoordinate fresh = e;
  GeneralizedAlpha integrator({.spectral_radius = 0.7}), other({.spectral_radius = 0.7});
  State s = e.at(1, 0), alone = s;
  REQUIRE(integrator.step(e, s, 0.1).solved());
  REQUIRE(other.step(fresh, alone, 0.1).solved());
  const StepSummary refused = integrator.step(e, s, 0.2, [](const State&, const Eigen::VectorXd&) { return false; });
  CHECK(refused.status == StepStatus::inaccurate);
  CHECK(e.accepted == 1);
  REQUIRE(integrator.step(e, s, 0.05).solved());
  REQUIRE(other.step(fresh, alone, 0.05).solved());
  CHECK(s.q == alone.q);
  CHECK(s.v == alone.v);
}

struct Swing {
  int iterations = 0;
  double q = 0;
};

/// A pendulum swinging wide, in equal steps that are checked; `chosen` as those of error control are.
Swing swing(bool chosen, double dt) {
  test::OneCoordinate e;
  e.force = [](double q, double, double) { return 9 * std::sin(q); };
  e.force_by_q = [](double q, double, double) { return 9 * std::cos(q); };
  GeneralizedAlpha integrator({.spectral_radius = 0.9, .chosen_by_error = chosen});
  State s = e.at(2.5, 0);
  Swing result;
  for (int i = 0; i < static_cast<int>(std::lround(4 / dt)); ++i) {
    const StepSummary step = integrator.step(e, s, dt, [](const State&, const Eigen::VectorXd&) { return true; });
    REQUIRE(step.solved());
    CHECK(step.residual <= 1);
    result.iterations += step.iterations;
  }
  result.q = s.q[0];
  return result;
}

TEST_CASE("ChosenSteps_AreSolvedToAShareOfTheirError") {
  const double exact = swing(false, 0.00125).q;
  for (const double dt : {0.04, 0.02}) {
    CAPTURE(dt);
    const Swing whole = swing(false, dt), chosen = swing(true, dt);
    const double error = whole.q - exact;
    // Hardly more than one iteration a step; a third of a percent of the error at most.
    CHECK(chosen.iterations < 1.2 * 4 / dt);
    CHECK(chosen.iterations <= whole.iterations);
    CHECK(std::abs(chosen.q - whole.q) < 0.0033 * std::abs(error));
  }
}

}  // namespace step_control_test
}  // namespace hersey::solver
