#include "kinds/plane_slider/slider_kinematics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "hersey/core/contract.h"

namespace hersey::bearing {
namespace slider_kinematics_test {

// A runner below a pad, tilted both ways and moving in every direction.
Pose some_pose() { return {rotation_exp({0.4, 0.02, -0.03}).toRotationMatrix(), {-30e-6, 12e-3, -7e-3}}; }
Vector6 some_velocity() { return (Vector6() << 2.0, -0.5, 0.8, 0.02, 3.0, -0.3).finished(); }

using Values = Eigen::Matrix<double, kSliderParameterCount, 1>;

Values value(const Pose& X, const Vector6& V) { return slider_kinematics(X, V).value; }

// Central differences with a step of 1e-6 err by its square and by eps over it.
constexpr double kOfDifferences = 1e-8;

TEST_CASE("Derivatives_MatchFiniteDifferences") {
  const Pose X = some_pose();
  const Vector6 V = some_velocity();
  const SliderKinematics k = slider_kinematics(X, V);
  for (int j = 0; j < 6; ++j) {
    CAPTURE(j);
    constexpr double h = 1e-6;  // as said above
    const Vector6 xi = h * Vector6::Unit(j);
    const Values by_pose = (value(pose_exp(xi) * X, V) - value(pose_exp(-xi) * X, V)) / (2 * h);
    const Values by_velocity = (value(X, V + xi) - value(X, V - xi)) / (2 * h);
    CHECK((k.d_dX.col(j) - by_pose).norm() < kOfDifferences * std::max(1.0, by_pose.norm()));
    CHECK((k.d_dV.col(j) - by_velocity).norm() < kOfDifferences * std::max(1.0, by_velocity.norm()));
  }
}

TEST_CASE("Rates_AreTimeDerivatives") {
  const Pose X = some_pose();
  const Vector6 V = some_velocity();
  constexpr double dt = 1e-6;
  const Values rate = (value(pose_exp(dt * V) * X, V) - value(pose_exp(-dt * V) * X, V)) / (2 * dt);
  CHECK((value(X, V).segment<3>(kSliderERate) - rate.segment<3>(kSliderE)).norm() < kOfDifferences);
}

// An even plane has no mark: sliding and spinning in itself it stays where it is.
TEST_CASE("RunnerThatSlidesInItsPlane_KeepsTheGap") {
  const Pose X = some_pose();
  const Pose within{rotation_exp({0.3, 0, 0}).toRotationMatrix(), {0, 5e-3, -9e-3}};
  const Values here = value(X, Vector6::Zero()), there = value(X * within, Vector6::Zero());
  CHECK((here - there).norm() < 1e-15);  // round-off of lengths of a centimetre
  Vector6 sliding = Vector6::Zero();
  sliding.tail<3>() = 3 * X.R.col(1) - 2 * X.R.col(2);
  CHECK(value(X, sliding).segment<3>(kSliderERate).norm() < 1e-15);  // round-off
}

// A runner whose x-axis points away from the pad is the same plane.
TEST_CASE("RunnerSeenFromBehind_IsTheSamePlane") {
  const Pose X = some_pose();
  const Pose behind{rotation_exp({0, std::numbers::pi, 0}).toRotationMatrix(), Vector3::Zero()};
  CHECK((value(X, some_velocity()) - value(X * behind, some_velocity())).norm() < 1e-14);  // round-off
}

TEST_CASE("RunnerAcrossThePad_IsRejected") {
  const Pose across{rotation_exp({0, 0, std::numbers::pi / 2}).toRotationMatrix(), Vector3::Zero()};
  CHECK_THROWS_AS((void)slider_kinematics(across, Vector6::Zero()), ContractError);
}

}  // namespace slider_kinematics_test
}  // namespace hersey::bearing
