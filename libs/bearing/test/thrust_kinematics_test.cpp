#include "kinds/thrust/thrust_kinematics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "hersey/core/contract.h"

namespace hersey::bearing {
namespace thrust_kinematics_test {

// A runner above a stator, tilted both ways, off the axis, and moving in every direction.
Pose tilted_pose() { return {rotation_exp({0.02, -0.03, 0.4}).toRotationMatrix(), {12e-3, -7e-3, 30e-6}}; }
Vector6 any_velocity() { return (Vector6() << -0.5, 0.8, 2.0, 0.3, -0.3, 0.02).finished(); }

using ThrustValues = Eigen::Matrix<double, kThrustParameterCount, 1>;

ThrustValues values_at(const Pose& X, const Vector6& V) { return thrust_kinematics(X, V).value; }

// Central differences with a step of 1e-6 err by its square and by eps over it.
constexpr double of_central_differences = 1e-8;

TEST_CASE("ThrustDerivatives_MatchFiniteDifferences") {
  const Pose X = tilted_pose();
  const Vector6 V = any_velocity();
  const ThrustKinematics k = thrust_kinematics(X, V);
  for (int j = 0; j < 6; ++j) {
    CAPTURE(j);
    constexpr double h = 1e-6;  // as said above
    const Vector6 xi = h * Vector6::Unit(j);
    const ThrustValues by_pose = (values_at(pose_exp(xi) * X, V) - values_at(pose_exp(-xi) * X, V)) / (2 * h);
    const ThrustValues by_velocity = (values_at(X, V + xi) - values_at(X, V - xi)) / (2 * h);
    CHECK((k.d_dX.col(j) - by_pose).norm() < of_central_differences * std::max(1.0, by_pose.norm()));
    CHECK((k.d_dV.col(j) - by_velocity).norm() < of_central_differences * std::max(1.0, by_velocity.norm()));
  }
}

TEST_CASE("ThrustRates_AreTimeDerivatives") {
  const Pose X = tilted_pose();
  const Vector6 V = any_velocity();
  constexpr double dt = 1e-6;  // as said above
  const ThrustValues rate = (values_at(pose_exp(dt * V) * X, V) - values_at(pose_exp(-dt * V) * X, V)) / (2 * dt);
  CHECK((values_at(X, V).segment<3>(kThrustZRate) - rate.segment<3>(kThrustZ)).norm() < of_central_differences);
}

// The plane that is meant: every point of the runner's face lies on it.
TEST_CASE("PointsOfTheRunner_LieOnItsPlane") {
  const Pose X = tilted_pose();
  const ThrustValues k = values_at(X, Vector6::Zero());
  for (const Vector3& on_face : {Vector3(0, 0, 0), Vector3(0.1, 0, 0), Vector3(-0.03, 0.07, 0)}) {
    const Vector3 at = X.R * on_face + X.r;
    CHECK(std::abs(at.z() - (k[kThrustZ] - k[kThrustAx] * at.x() - k[kThrustAy] * at.y())) < 1e-16);  // round-off
  }
}

// An even plane has no mark: turned about its own normal, shifted in itself or seen from behind it is the same.
TEST_CASE("RunnerThatTurnsInItsPlane_KeepsTheGap") {
  const Pose X = tilted_pose();
  const Pose within{rotation_exp({0, 0, 0.7}).toRotationMatrix(), {5e-3, -9e-3, 0}},
      behind{rotation_exp({std::numbers::pi, 0, 0}).toRotationMatrix(), Vector3::Zero()};
  const ThrustValues here = values_at(X, Vector6::Zero());
  CHECK((here - values_at(X * within, Vector6::Zero())).norm() < 1e-15);  // round-off of lengths of a centimetre
  CHECK((here - values_at(X * behind, Vector6::Zero())).norm() < 1e-15);  // likewise
  Vector6 turning = Vector6::Zero();
  turning.head<3>() = 300 * X.R.col(2), turning.tail<3>() = X.r.cross(turning.head<3>());
  const ThrustValues turns = values_at(X, turning);
  CHECK(turns.segment<3>(kThrustZRate).norm() < 1e-13);  // round-off of 300 rad/s
  CHECK(turns[kThrustSpeed] == doctest::Approx(300 * X.R(2, 2)));
}

TEST_CASE("RunnerAcrossTheStator_IsRejected") {
  const Pose across{rotation_exp({std::numbers::pi / 2, 0, 0}).toRotationMatrix(), Vector3::Zero()};
  CHECK_THROWS_AS((void)thrust_kinematics(across, Vector6::Zero()), ContractError);
}

}  // namespace thrust_kinematics_test
}  // namespace hersey::bearing
