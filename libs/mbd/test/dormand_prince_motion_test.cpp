// Mechanisms by the explicit method against closed forms and against generalized-alpha; what it takes from the heap.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "benchmark_mechanisms.h"
#include "count_allocations.h"
#include "hersey/mbd/mechanism_builder.h"
#include "hersey/solver/dormand_prince.h"
#include "mechanisms_pendulum.h"
#include "mechanisms_top.h"
#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace dormand_prince_motion_test {

constexpr double kPi = std::numbers::pi;
constexpr double g = 9.81;

void advance(Mechanism& mechanism, solver::State& state, double end, int steps) {
  solver::DormandPrince integrator;
  const double t0 = state.t;
  for (int i = 1; i <= steps; ++i) {
    const solver::StepSummary summary = integrator.step(mechanism, state, t0 + (end - t0) * i / steps - state.t, {});
    INFO(summary.message);
    REQUIRE(summary.solved());
  }
}

/// A body on a ball joint without gravity, rotating about no axis of its own.
std::unique_ptr<Mechanism> top(const verification::SymmetricTop& exact) {
  MechanismBuilder b;
  b.set_gravity({0, 0, 0});
  const BodyId body =
      b.add_body({.name = "top", .mass = 1, .inertia = Matrix3(Vector3(exact.A, exact.A, exact.C).asDiagonal())});
  b.add_joint({.name = "ball",
               .type = JointType::spherical,
               .inboard = b.frame_of(b.ground()),
               .outboard = b.frame_of(body),
               .initial = {0, 0, 0},
               .initial_rate = {exact.omega.x(), exact.omega.y(), exact.omega.z()}});
  return b.finalise();
}

TEST_CASE("FreeTop_FollowsTheClosedFormToOrderEight") {
  const verification::SymmetricTop exact{0.05, 0.08, {3, 0.5, 8}};
  const auto error = [&](int steps) {
    const auto m = top(exact);
    solver::State state = test::start(*m);
    advance(*m, state, 1, steps);
    const FrameMotion motion = m->frame_motion(state, m->spec().body_frames[1]);
    return (motion.X_WF.R - exact.orientation(1)).norm() +
           (state.v - exact.angular_velocity(1)).norm() / exact.omega.norm();
  };
  const double coarse = error(10), fine = error(20);  // twice as many leave round-off alone
  MESSAGE("order ", std::log2(coarse / fine), ", error ", fine);
  CHECK(std::abs(std::log2(coarse / fine) - 8) < 1);  // the next term of steps of two fifths of a radian
}

/// A pendulum, as a free body whose pivot is a closing joint, or hanging on its joint; the world rotated by R.
std::unique_ptr<Mechanism> pendulum(bool closed, const Matrix3& R = Matrix3::Identity()) {
  MechanismBuilder b;
  b.set_gravity(R * Vector3(0, -g, 0));
  const BodyId bob = b.add_body({.name = "bob", .mass = 1, .inertia = Matrix3::Identity() * 0.1});
  const FrameId foot = b.add_frame({.name = "foot", .body = b.ground(), .X_BF = {R, Vector3::Zero()}});
  const FrameId pivot = b.add_frame({.name = "pivot", .body = bob, .X_BF = {Matrix3::Identity(), {0, 1, 0}}});
  if (closed)
    b.add_joint({.name = "flight",
                 .type = JointType::free,
                 .inboard = foot,
                 .outboard = b.frame_of(bob),
                 .initial = {1, 0, 0, 0, 0, 0.5 * kPi}});
  b.add_joint({.name = "pivot",
               .type = JointType::revolute,
               .inboard = foot,
               .outboard = pivot,
               .initial = closed ? std::vector<double>{} : std::vector<double>{0.5 * kPi}});
  return b.finalise();
}

/// Errors of angle, rate and force in the pivot after a second.
Vector3 pendulum_errors(Mechanism& m, const solver::State& state) {
  const verification::Pendulum exact{0.5 * kPi, std::sqrt(g / 1.1)};
  const double angle = exact.angle(1), rate = exact.rate(1);
  const double acceleration = -exact.omega0 * exact.omega0 * std::sin(angle);
  const Vector3 up(-std::sin(angle), std::cos(angle), 0), along(std::cos(angle), std::sin(angle), 0);
  const Vector3 force = acceleration * along + rate * rate * up + Vector3(0, g, 0);
  const Observation observation = m.observe(state);
  const FrameMotion& bob = observation.bodies[1];
  return {std::atan2(bob.X_WF.R(1, 0), bob.X_WF.R(0, 0)) - angle, bob.omega.z() - rate,
          (observation.joints.back().force - force).norm()};
}

TEST_CASE("PendulumInALoop_IsOfOrderEightInAngleRateAndForce") {
  for (const bool closed : {false, true}) {
    const auto errors = [&](int steps) {
      const auto m = pendulum(closed);
      solver::State state = test::start(*m);
      advance(*m, state, 1, steps);
      return pendulum_errors(*m, state);
    };
    const Vector3 coarse = errors(10), fine = errors(20);
    CAPTURE(closed);
    const double order = std::log2(coarse.norm() / fine.norm());
    MESSAGE("order ", order, ", errors ", fine.transpose());
    CHECK(std::abs(order - 8) < 0.5);  // the next term of steps of a twentieth of a second
    CHECK(fine.norm() < 1e-9);         // a coefficient of 1e-6 times 0.3^9 a step, times the force of ten
  }
}

TEST_CASE("RotatedWorld_RotatesTheMotion") {
  const Matrix3 R = (Eigen::AngleAxisd(0.7, Vector3::UnitX()) * Eigen::AngleAxisd(-1.1, Vector3::UnitY())).matrix();
  const auto here = pendulum(true), there = pendulum(true, R);
  solver::State one = test::start(*here), other = test::start(*there);
  advance(*here, one, 1, 15);
  advance(*there, other, 1, 15);
  const FrameMotion a = here->frame_motion(one, here->spec().body_frames[1]);
  const FrameMotion b = there->frame_motion(other, there->spec().body_frames[1]);
  constexpr double round_off = 1e-12;  // of fifteen steps
  CHECK((R * a.X_WF.r - b.X_WF.r).norm() < round_off);
  CHECK((R * a.omega - b.omega).norm() < round_off);
}

TEST_CASE("EnergyOfTheExplicitMethod_DriftsWithTheOrderOfItsError") {
  const auto drift = [](int steps) {
    const auto m = test::four_bars(2, true);
    solver::State state = test::start(*m);
    const auto energy = [&] {
      const Observation o = m->observe(state);
      return o.kinetic_energy + o.potential_energy;
    };
    const double before = energy();
    advance(*m, state, 0.6, steps);
    return std::abs(energy() - before);
  };
  const double coarse = drift(6), fine = drift(12);
  MESSAGE("drifts ", coarse, ", ", fine);
  CHECK(coarse / fine > 100);  // 2^8 but for the next term
}

TEST_CASE("GeneralizedAlpha_TendsToTheExplicitMethod") {
  // Every joint type, balls, closing joints, couplings, drives, loads, springs, friction and control. The difference is
  // that of the method of second order.
  const auto m = test::nasty_mechanism(false);
  const solver::State start = test::start(*m);
  solver::State exact = start;
  advance(*m, exact, 0.01, 50);
  const auto difference = [&](int steps) {
    const auto other = test::nasty_mechanism(false);
    solver::State state = test::start(*other);
    test::run(*other, state, 0.01, steps, 0.9);
    return (state.q - exact.q).norm() + (state.v - exact.v).norm();
  };
  const double coarse = difference(100), fine = difference(200);
  MESSAGE("differences ", coarse, ", ", fine);
  CHECK(std::abs(std::log2(coarse / fine) - 2) < 0.1);  // the next term of steps of generalized-alpha
}

TEST_CASE("RedundantLoop_MovesAsTheLoopWithoutRedundancy") {
  const auto hinges = test::four_bars(1, true), free = test::four_bars(1, false);
  solver::State one = test::start(*hinges), other = test::start(*free);
  advance(*hinges, one, 0.5, 10);
  advance(*free, other, 0.5, 10);
  const FrameMotion a = hinges->frame_motion(one, hinges->spec().body_frames[1]);
  const FrameMotion b = free->frame_motion(other, free->spec().body_frames[1]);
  constexpr double round_off = 1e-12;  // of ten steps
  CHECK((a.X_WF.R - b.X_WF.R).norm() < round_off);
}

TEST_CASE("ExplicitStepsAfterTheFirst_DoNotAllocate") {
  const auto allocations_of = [](Mechanism& mechanism, double dt) {
    solver::State state = test::start(mechanism);
    solver::DormandPrince integrator;
    long allocations = 0;
    for (int i = 0; i < 23; ++i) {
      const long before = hersey::test::allocations;
      const solver::StepSummary summary = integrator.step(mechanism, state, dt, {});
      if (i >= 3) allocations += hersey::test::allocations - before;
      REQUIRE(summary.solved());
    }
    return allocations;
  };
  CHECK(allocations_of(*test::four_bars(5), 5e-3) == 0);
  CHECK(allocations_of(*test::nasty_mechanism(false), 1e-4) == 0);
}

}  // namespace dormand_prince_motion_test
}  // namespace hersey::mbd
