#include <doctest/doctest.h>

#include <cmath>

#include "hersey/mbd/mechanism_builder.h"
#include "simulate.h"
#include "test_mechanisms.h"
#include "tree/drive_motion.h"

namespace hersey::mbd {
namespace drive_test {

constexpr double kEps = 2.2e-16;

TEST_CASE("ConstantSpeed_IsExact") {
  const DriveMotion motion(
      {.name = "d", .coordinate = {}, .kind = DriveSpec::Kind::speed, .function = test::constant(373.85)}, 0.3);
  CHECK(motion.position(12.5) == 0.3 + 373.85 * 12.5);
  CHECK(motion.velocity(1) == 373.85);
  CHECK(motion.acceleration(1) == 0);
}

TEST_CASE("SpeedFunction_IsIntegratedToRoundOff") {
  const auto speed =
      test::time_function([](double t) { return 3 * std::cos(40 * t) + t; },
                          [](double t) { return -120 * std::sin(40 * t) + 1; }, [](double) { return 0.0; });
  DriveMotion motion({.name = "d", .coordinate = {}, .kind = DriveSpec::Kind::speed, .function = speed}, 0.1);
  const auto exact = [](double t) { return 0.1 + 3.0 / 40 * std::sin(40 * t) + 0.5 * t * t; };
  // Adaptive quadrature to 1e-13, over one long interval and in 1000 anchored pieces.
  CHECK(std::abs(motion.position(2) - exact(2)) < 1e-12);
  for (int i = 1; i <= 1000; ++i) motion.anchor(0.002 * i);
  CHECK(std::abs(motion.position(2.001) - exact(2.001)) < 1e-12);  // as said above
}

TEST_CASE("SpeedWithAKink_IsIntegratedToo") {
  const auto speed = test::time_function([](double t) { return std::abs(t - 0.3); }, [](double) { return 0.0; },
                                         [](double) { return 0.0; });
  const DriveMotion motion({.name = "d", .coordinate = {}, .kind = DriveSpec::Kind::speed, .function = speed}, 0);
  CHECK(std::abs(motion.position(1) - (0.5 * 0.09 + 0.5 * 0.49)) < 1e-12);  // the same quadrature
}

/// A wheel with inertia J rotated by the angle f(t): torque J f''.
TEST_CASE("PositionDrive_ReportsTheTorqueItNeeds") {
  MechanismBuilder b;
  const BodyId wheel = b.add_body({.name = "wheel", .mass = 1, .inertia = Vector3(0.2, 0.2, 0.3).asDiagonal()});
  const JointId axle = b.add_joint(
      {.name = "axle", .type = JointType::revolute, .inboard = b.frame_of(b.ground()), .outboard = b.frame_of(wheel)});
  b.add_drive({.name = "servo",
               .coordinate = {axle, 0},
               .kind = DriveSpec::Kind::position,
               .function = test::time_function([](double t) { return 0.5 + std::sin(3 * t); },
                                               [](double t) { return 3 * std::cos(3 * t); },
                                               [](double t) { return -9 * std::sin(3 * t); })});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  // rtol of the start.
  CHECK(std::abs(state.q[0] - 0.5) < 1e-12);
  CHECK(std::abs(state.v[0] - 3) < 1e-12);
  test::run(*m, state, 1, 1000, 0.8);
  const Observation observation = m->observe(state);
  const double torque = 0.3 * -9 * std::sin(3.0);
  CHECK(std::abs(state.q[0] - 0.5 - std::sin(3.0)) < 1e-12);  // a constraint, satisfied to round-off
  // Second order in the multiplier: (omega dt)^2 of the torque's amplitude.
  CHECK(std::abs(observation.drive_efforts[0] - torque) < std::pow(3e-3, 2) * 2.7);
  CHECK(observation.drive_powers[0] ==
        doctest::Approx(torque * 3 * std::cos(3.0)).epsilon(1e-4));  // the torque's own error
  CHECK(observation.joints[0].torque.norm() < 64 * kEps * 2.7);      // an ideal bearing's part of it
}

/// Two ways to model one slider on a rail: the coordinate in the tree, or of a joint that closes a loop.
TEST_CASE("CoordinateOfAClosingJoint_ActsLikeOneOfTheTree") {
  const auto oscillate = [](bool closing) {
    MechanismBuilder b;
    const BodyId slider = b.add_body({.name = "slider", .mass = 2, .inertia = Matrix3::Identity()});
    const FrameId ground = b.frame_of(b.ground());
    // Chain of two joints to ground; both have coordinates that are read, so the second one closes the loop.
    if (closing) {
      const JointId flight =
          b.add_joint({.name = "flight", .type = JointType::free, .inboard = ground, .outboard = b.frame_of(slider)});
      b.add_spring({.name = "null", .coordinate = {flight, 0}, .stiffness = 0});
    }
    const JointId rail = b.add_joint({.name = "rail",
                                      .type = JointType::prismatic,
                                      .inboard = ground,
                                      .outboard = b.frame_of(slider),
                                      .axis = {1, 1, 0},
                                      .initial = {0.25}});
    b.add_spring({.name = "coil", .coordinate = {rail, 0}, .stiffness = 72, .damping = 0.1});
    const auto m = b.finalise();
    CHECK(m->closing_joints().size() == (closing ? 1u : 0u));
    solver::State state = test::start(*m);
    test::run(*m, state, 1, 400, 0.9);
    const Observation observation = m->observe(state);
    // The spring's force, up to 18 N, is not the rail's; Newton's tolerance is 1e-9 of it.
    CHECK(observation.joints[rail.index].force.norm() < 2e-8);
    return std::pair{observation.joints[rail.index].position[0], observation.joints[rail.index].rate[0]};
  };
  const auto tree = oscillate(false), loop = oscillate(true);
  CHECK(std::abs(tree.first - 0.25 * std::exp(-0.025) * std::cos(6.0)) < 1e-3);  // damped oscillator, (6 dt)^2
  // Two sets of equations, each solved to Newton's 1e-9.
  CHECK(std::abs(loop.first - tree.first) < 1e-8);
  CHECK(std::abs(loop.second - tree.second) < 1e-7);
}

}  // namespace drive_test
}  // namespace hersey::mbd
