#include "hersey/bearing/journal_kinematics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "hersey/core/contract.h"

namespace hersey::bearing {
namespace journal_kinematics_test {

constexpr double kR = 0.0225;

// A journal well off the bearing's axis, tilted and moving in every direction.
Pose some_pose() { return {rotation_exp({0.03, -0.02, 0.7}).toRotationMatrix(), {20e-6, -13e-6, 4e-3}}; }
Vector6 some_velocity() { return (Vector6() << 3.0, -5.0, 370.0, 0.02, -0.04, 0.3).finished(); }

ParameterVector value(const Pose& X, const Vector6& V) { return journal_kinematics(X, V, kR, 0).value; }

// Entries differ in size by orders; a column is compared by its own largest entry. Central differences with step h err
// by h^2 and eps/h: cbrt(eps) = 6e-6 balances them at about 1e-10 of the scale of the second derivative.
void check_close(const ParameterVector& exact, const ParameterVector& difference, double scale) {
  for (int i = 0; i < kParameterCount; ++i) {
    CAPTURE(i);
    CHECK(std::abs(exact[i] - difference[i]) <= 1e-7 * std::max(std::abs(exact[i]), scale));  // as said above
  }
}

TEST_CASE("Derivatives_MatchFiniteDifferences") {
  const Pose X = some_pose();
  const Vector6 V = some_velocity();
  const JournalKinematics k = journal_kinematics(X, V, kR, 0);
  for (int j = 0; j < 6; ++j) {
    CAPTURE(j);
    const double h = 1e-7;
    const Vector6 xi = h * Vector6::Unit(j);
    const ParameterVector by_pose = (value(pose_exp(xi) * X, V) - value(pose_exp(-xi) * X, V)) / (2 * h);
    // The widest gap turns by 1 rad over 24 um: its curvature over h = 0.1 um is (h/24 um)^2 = 2e-5 of its slope.
    ParameterVector exact = k.d_dX.col(j), differences = by_pose;
    CHECK(exact[kSupplyAngle] == doctest::Approx(differences[kSupplyAngle]).epsilon(1e-4));  // as said above
    exact[kSupplyAngle] = differences[kSupplyAngle] = 0;
    check_close(exact, differences, 1.0);
    const Vector6 dV = 1e-3 * Vector6::Unit(j);
    check_close(k.d_dV.col(j), (value(X, V + dV) - value(X, V - dV)) / 2e-3, 1e-3);
  }
}

TEST_CASE("Rates_AreTimeDerivatives") {
  const Pose X = some_pose();
  const Vector6 V = some_velocity();
  const double dt = 1e-7;
  const ParameterVector rate = (value(pose_exp(dt * V) * X, V) - value(pose_exp(-dt * V) * X, V)) / (2 * dt);
  const ParameterVector now = value(X, V);
  // Differences of lengths of 1e-2 m over 2e-7 s: round-off 1e-2 * eps / 2e-7 = 1e-11 m/s.
  for (int i = 0; i < 4; ++i) CHECK(now[kExRate + i] == doctest::Approx(rate[i]).epsilon(1e-6));
}

TEST_CASE("Parameters_AreTheSameFromAnyGround") {
  // The bearing sees relative motion only; a common rigid motion of both frames cancels before it gets here, so all
  // that can differ is the choice of x-axis: turned by alpha, vectors turn back by alpha, scalars stay.
  const double alpha = 0.9;
  const Pose turn{rotation_exp({0, 0, alpha}).toRotationMatrix(), Vector3::Zero()};
  const Pose X = some_pose();
  const Vector6 V = some_velocity();
  const ParameterVector here = value(X, V), there = value(turn.inverse() * X, motion_transform(turn.inverse()) * V);
  const Eigen::Rotation2Dd back(-alpha);
  for (int i : {kEx, kTx, kExRate, kTxRate}) {
    const Eigen::Vector2d turned = back * here.segment<2>(i);
    CHECK((there.segment<2>(i) - turned).norm() <= 1e-12 * std::max(1.0, turned.norm()));  // round-off
  }
  CHECK(there[kJournalSpeed] == doctest::Approx(here[kJournalSpeed]));
  CHECK(there[kAxialSpeed] == doctest::Approx(here[kAxialSpeed]));
  // Round-off.
  CHECK(std::remainder(there[kSupplyAngle] - here[kSupplyAngle] + alpha, 2 * std::numbers::pi) ==
        doctest::Approx(0).epsilon(1e-9));
}

TEST_CASE("JournalAcrossTheBearing_IsRejected") {
  const Pose across{rotation_exp({std::numbers::pi / 2, 0, 0}).toRotationMatrix(), Vector3::Zero()};
  CHECK_THROWS_AS((void)journal_kinematics(across, Vector6::Zero(), kR, 0), ContractError);
}

}  // namespace journal_kinematics_test
}  // namespace hersey::bearing
