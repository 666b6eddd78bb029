#include "fast_motions.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "hersey/solver/generalized_alpha.h"
#include "hersey/solver/initialise.h"
#include "one_coordinate.h"
#include "several_coordinates.h"

// Motions that damping ends within the first step.
namespace hersey::solver {
namespace fast_motions_test {

/// m v' = c (cos t - v): a film acts like this on a journal under a rotating load.
test::OneCoordinate dragged(double mass, double damping) {
  test::OneCoordinate e;
  e.mass = mass;
  e.force = [=](double, double v, double t) { return damping * (v - std::cos(t)); };
  e.force_by_v = [=](double, double, double) { return damping; };
  return e;
}

/// Position at t = 1 from rest.
double exact(double lambda) {
  const double A = lambda * lambda / (1 + lambda * lambda), B = lambda / (1 + lambda * lambda);
  return A * std::sin(1.0) + B * (1 - std::cos(1.0)) - A * (1 - std::exp(-lambda)) / lambda;
}

double integrated(test::OneCoordinate& e, int steps) {
  State s = e.at(0, 0);
  REQUIRE(initialise(e, s).solved());
  GeneralizedAlpha integrator({.spectral_radius = 0.8});
  for (int i = 0; i < steps; ++i) REQUIRE(integrator.step(e, s, 1.0 / steps).solved());
  return s.q[0];
}

TEST_CASE("Start_IsOfOrderTwoHoweverStiffTheDamping") {
  // Without the start of (integrator.9) the error at a ratio of 1e8 is 12 instead of 3e-6.
  for (const double ratio : {1.0, 10.0, 100.0, 1e4, 1e8}) {
    CAPTURE(ratio);
    test::OneCoordinate coarse = dragged(1 / ratio, 1), fine = coarse;
    const double error = std::abs(integrated(coarse, 80) - exact(ratio));
    const double error_of_half = std::abs(integrated(fine, 160) - exact(ratio));
    CHECK(error < 1.2e-4);
    CHECK(error_of_half < 4e-5);
    if (ratio <= 10 || ratio >= 1e8) CHECK(std::log2(error / error_of_half) == doctest::Approx(2).epsilon(0.05));
  }
}

TEST_CASE("LightMass_TendsToNoMass") {
  test::OneCoordinate none = dragged(0, 1);
  const double without = integrated(none, 100);
  CHECK(without == doctest::Approx(std::sin(1.0)).epsilon(1e-4));  // 100 steps of second order
  for (const double mass : {1e-4, 1e-6, 1e-8}) {
    CAPTURE(mass);
    test::OneCoordinate e = dragged(mass, 1);
    // The mass delays the motion by mass over damping; the error of a step is of the square of that time over the step.
    CHECK(std::abs(integrated(e, 100) - without) < 2 * mass);
  }
}

TEST_CASE("SlowMotion_StartsAsItIs") {
  test::OneCoordinate slow = dragged(1, 1), undamped = dragged(1, 0);
  undamped.force = [](double, double, double) { return -3.0; };
  State s = slow.at(0, 0);
  slow.begin_step(s, 1e-3);
  CHECK(!settle_fast_motions(slow, s, 1e-3));
  s = undamped.at(0, 0);
  undamped.begin_step(s, 10);
  CHECK(!settle_fast_motions(undamped, s, 10));
}

/// A mass in the plane that a damper along `angle` and another across it brake, drawn by a force of its own direction,
/// both turned by `turn`, in coordinates of which the second is in other units.
bool starts_settled(double turn, double along, double across, double force, double unit = 1) {
  const Eigen::Rotation2Dd R(turn);
  const Eigen::Matrix2d U = Eigen::Vector2d(1, unit).asDiagonal();
  const Eigen::Matrix2d C = U * R * Eigen::Vector2d(along, across).asDiagonal() * R.toRotationMatrix().transpose() * U;
  const Eigen::VectorXd f = U * (R * Eigen::Vector2d(std::cos(force), std::sin(force)));
  test::SeveralCoordinates e(U * U);
  e.force = [=](const auto&, const auto& v, double) -> Eigen::VectorXd { return C * v - f; };
  e.force_by_v = [=](const auto&, const auto&, double) -> Eigen::MatrixXd { return C; };
  const State s = e.at(Eigen::Vector2d::Zero());
  e.begin_step(s, 1);
  return settle_fast_motions(e, s, 1).has_value();
}

TEST_CASE("Start_DoesNotDependOnTheDirectionOfAxes") {
  for (const double force : {0.01, 0.8, 1.56}) {
    for (const double unit : {1.0, 1e3}) {
      for (int turn = 0; turn < 12; ++turn) {
        CAPTURE(turn);
        CAPTURE(force);
        CAPTURE(unit);
        const auto settled = [&](double along, double across) {
          return starts_settled(0.1 + 0.3 * turn, along, across, force, unit);
        };
        CHECK(settled(1000, 1));
        CHECK(settled(60, 9));
        CHECK(settled(60, 0));
        CHECK(!settled(40, 1));
        CHECK(!settled(40, 40));
        CHECK(!settled(9, 0));
      }
    }
  }
}

TEST_CASE("FastMotion_SettlesWhereForcesBalance") {
  // Damping that grows with speed, as of a turbulent film: v + v^3 balances 2 at 1.
  test::OneCoordinate e;
  e.mass = 1e-9;
  e.force = [](double, double v, double) { return v + v * v * v - 2; };
  e.force_by_v = [](double, double v, double) { return 1 + 3 * v * v; };
  const double dt = 1e-4;
  State s = e.at(0, -0.5);
  e.begin_step(s, dt);
  const auto settled = settle_fast_motions(e, s, dt);
  REQUIRE(settled);
  CHECK(settled->v[0] == doctest::Approx(1).epsilon(1e-6));  // what is left of the start: 15/z^2 of it, z = 4e5
  // It continues its motion for about mass over damping.
  CHECK(std::abs(settled->offset[0]) < 1e-8);     // mass over damping is 2.5e-10 s
  CHECK(std::abs(settled->vdot[0]) * dt < 1e-2);  // 15/z^2 of the force over the mass, 2.6e9
  CHECK(s.v[0] == -0.5);
}

// Condensed unknowns at a fresh start may answer otherwise than in the step that has led there. What that adds to the
// acceleration decays with the motion: extrapolated through the step, it would grow from one fresh start to the next.
TEST_CASE("ForceThatJumpsAtTheStart_SettlesWithItsMotion") {
  const double dt = 1, jump = 5;
  test::SeveralCoordinates e(Eigen::Matrix2d::Identity());
  const double z = 1000;  // of the first motion; the second has no damping
  e.force = [=](const Eigen::VectorXd&, const Eigen::VectorXd& v, double) {
    return Eigen::VectorXd(Eigen::Vector2d(z / dt * v[0] - 1, -3));
  };
  e.force_by_v = [=](const Eigen::VectorXd&, const Eigen::VectorXd&, double) {
    return Eigen::MatrixXd(Eigen::Vector2d(z / dt, 0).asDiagonal());
  };
  State as_found = e.at(Eigen::Vector2d::Zero()), jumped = as_found;
  e.begin_step(as_found, dt);
  as_found.vdot = Eigen::Vector2d(1, 3);
  jumped.vdot = as_found.vdot + Eigen::Vector2d::Constant(jump);
  const auto without = settle_fast_motions(e, as_found, dt), with = settle_fast_motions(e, jumped, dt);
  REQUIRE(without);
  REQUIRE(with);
  const Eigen::VectorXd change = with->vdot - without->vdot;
  const double w = 1 / (1 + z), g = w * w * (15 - 40 * w + 45 * w * w - 24 * w * w * w + 5 * w * w * w * w);
  CHECK(change[0] == doctest::Approx(g * jump).epsilon(1e-6));  // sums of six shares of up to 45, alternating
  CHECK(change[1] == doctest::Approx(jump).epsilon(1e-12));     // round-off of the same sums
  CHECK(with->v == without->v);
  CHECK(with->offset == without->offset);
}

TEST_CASE("FastMotionThatCannotBeSettled_IsUnchanged") {
  const double dt = 1e-2;
  const auto settles = [&](test::SeveralCoordinates& e) {
    const State start = e.at(Eigen::VectorXd::Zero(e.nv()));
    e.begin_step(start, dt);
    return settle_fast_motions(e, start, dt).has_value();
  };
  const auto light = [] {  // its damping ends its motion a hundred times within the step
    test::SeveralCoordinates e(Eigen::MatrixXd::Constant(1, 1, 1e-4));
    e.force = [](const Eigen::VectorXd&, const Eigen::VectorXd& v, double) {
      return Eigen::VectorXd(v - Eigen::VectorXd::Ones(1));
    };
    e.force_by_v = [](const Eigen::VectorXd&, const Eigen::VectorXd&, double) { return Eigen::MatrixXd::Ones(1, 1); };
    return e;
  };
  test::SeveralCoordinates plain = light(), in_part = light(), at_once = light(), later = light();
  CHECK(settles(plain));
  in_part.whole_tangent = false;  // the damping may be among the forces that the tangent leaves out
  CHECK(!settles(in_part));
  at_once.outside = [](const State& s) { return std::string(s.v[0] > 1e-3 ? "too fast" : ""); };
  CHECK(!settles(at_once));  // nowhere on the way
  later.outside = [](const State& s) { return std::string(s.v[0] > 0.995 ? "too fast" : ""); };
  CHECK(!settles(later));  // not after the first of its steps, which ends at 0.99
  test::SeveralCoordinates nothing(Eigen::MatrixXd(0, 0));
  CHECK(!settles(nothing));
}

TEST_CASE("GivenRateOfALightMass_IsKeptAtTheStart") {
  test::OneCoordinate e = dragged(1e-9, 1);
  State s = e.at(0, 0.25);
  REQUIRE(initialise(e, s, {.fixed_rates = {0}}).solved());
  CHECK(s.v[0] == 0.25);
}

TEST_CASE("MotionWithoutMass_HasTheRateOfItsDamping") {
  test::OneCoordinate e;
  e.mass = 0;
  e.force = [](double, double v, double) { return 4 * v + v * v * v - 5; };
  e.force_by_v = [](double, double v, double) { return 4 + 3 * v * v; };
  State s = e.at(0.3, 0);
  s.vdot.setZero();
  REQUIRE(initialise(e, s).solved());
  CHECK(s.q[0] == 0.3);
  CHECK(s.v[0] == doctest::Approx(1).epsilon(1e-9));  // Newton's iteration ends at 1e-10 of the terms
  CHECK(s.vdot[0] == 0);
}

}  // namespace fast_motions_test
}  // namespace hersey::solver
