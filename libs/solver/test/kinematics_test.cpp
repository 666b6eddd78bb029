#include "hersey/solver/kinematics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "several_coordinates.h"

// A point mass on a circle, rotated by a drive: motions that drives and constraints prescribe, and those that they do
// not.
namespace hersey::solver {
namespace kinematics_test {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double mass = 2, gravity = 9.81, omega = 3;
// Positions are solved to 1e-13; rates and forces follow with the factors omega^2 and m omega^2.
constexpr double of_positions = 1e-12, of_forces = 1e-10;

/// x^2 + y^2 = 1, and x sin wt - y cos wt = 0 if `driven`; weight along -y.
test::SeveralCoordinates crank(bool driven) {
  test::SeveralCoordinates e(mass * Matrix2d::Identity(), driven ? 2 : 1);
  e.force = [](const VectorXd&, const VectorXd&, double) { return VectorXd(Vector2d(0, mass * gravity)); };
  e.phi = [driven](const VectorXd& q, double t) {
    const Vector2d phi(q.squaredNorm() - 1, q[0] * std::sin(omega * t) - q[1] * std::cos(omega * t));
    return VectorXd(phi.head(driven ? 2 : 1));
  };
  e.G = [driven](const VectorXd& q, double t) {
    const Matrix2d G = (Matrix2d() << 2 * q[0], 2 * q[1], std::sin(omega * t), -std::cos(omega * t)).finished();
    return MatrixXd(G.topRows(driven ? 2 : 1));
  };
  e.phi_t = [driven](const VectorXd& q, double t) {
    const Vector2d rate(0, omega * (q[0] * std::cos(omega * t) + q[1] * std::sin(omega * t)));
    return VectorXd(rate.head(driven ? 2 : 1));
  };
  e.bias = [driven](const VectorXd& q, const VectorXd& v, double t) {
    const double s = std::sin(omega * t), c = std::cos(omega * t);
    const Vector2d bias(2 * v.squaredNorm(), 2 * omega * (c * v[0] + s * v[1]) + omega * omega * (c * q[1] - s * q[0]));
    return VectorXd(bias.head(driven ? 2 : 1));
  };
  return e;
}

TEST_CASE("DrivenPoint_FollowsTheClosedForms") {
  test::SeveralCoordinates e = crank(true);
  State state = e.at(Vector2d(0.9, -0.2));
  for (const double t : {0.0, 0.1, 0.35, 0.7}) {
    CAPTURE(t);
    const int before = e.accepted;
    state.t = t;
    const KinematicsSummary summary = solve_kinematics(e, state);
    REQUIRE(summary.solved());
    CHECK(summary.message.empty());
    const double c = std::cos(omega * t), s = std::sin(omega * t);
    CHECK((state.q - Vector2d(c, s)).norm() < of_positions);
    CHECK((state.v - omega * Vector2d(-s, c)).norm() < omega * of_positions);
    CHECK((state.vdot + omega * omega * Vector2d(c, s)).norm() < omega * omega * of_positions);
    // Along the radius the centripetal force, along the circle the weight.
    CHECK(std::abs(state.lambda[0] - 0.5 * mass * (omega * omega - gravity * s)) < of_forces);
    CHECK(std::abs(state.lambda[1] - mass * gravity * c) < of_forces);
    CHECK(e.accepted == before + 1);
  }
}

TEST_CASE("FreeCoordinates_AreThoseThatNothingPrescribes") {
  test::SeveralCoordinates driven = crank(true), loose = crank(false);
  CHECK(free_coordinates(driven, driven.at(Vector2d(1, 0))).empty());
  // On the x axis the circle allows the point to move along y alone, elsewhere both coordinates move.
  CHECK(free_coordinates(loose, loose.at(Vector2d(1, 0))) == std::vector<std::string>{"coordinate 1"});
  CHECK(free_coordinates(loose, loose.at(Vector2d(0.6, 0.8))).size() == 2);
  CHECK(free_coordinates(loose, loose.at(Vector2d(0, 0))).size() == 2);  // where it has no derivative
  test::SeveralCoordinates nothing(MatrixXd(0, 0));
  State none = nothing.at(VectorXd(0));
  CHECK(free_coordinates(nothing, none).empty());
  CHECK(solve_kinematics(nothing, none).solved());
}

/// x^2 + y^2 = 1 and x = reach(t).
test::SeveralCoordinates pushed(double reach, double rate = 0) {
  test::SeveralCoordinates e(Matrix2d::Identity(), 2);
  e.phi = [=](const VectorXd& q, double) { return VectorXd(Vector2d(q.squaredNorm() - 1, q[0] - reach)); };
  e.G = [](const VectorXd& q, double) { return MatrixXd((Matrix2d() << 2 * q[0], 2 * q[1], 1, 0).finished()); };
  e.phi_t = [=](const VectorXd&, double) { return VectorXd(Vector2d(0, rate)); };
  // These depend on velocities, as forces of rotating bodies do.
  e.force = [](const VectorXd&, const VectorXd& v, double) { return VectorXd(Vector2d(0.1 * v[1], -0.1 * v[0])); };
  return e;
}

/// Checks a failure with `status` and a message that contains `words`; nothing is changed.
void check_failure(test::SeveralCoordinates& e, const State& start, KinematicsStatus status, const std::string& words) {
  State state = start;
  const KinematicsSummary summary = solve_kinematics(e, state);
  CAPTURE(summary.message);
  CHECK(summary.status == status);
  CHECK(summary.message.find(words) != std::string::npos);
  CHECK(state.q == start.q);
  CHECK(state.v == start.v);
  CHECK(e.accepted == 0);
}

TEST_CASE("MotionThatCannotBeFollowed_IsReportedWithItsInstant") {
  test::SeveralCoordinates out_of_reach = pushed(1.3), at_the_end = pushed(1), jumping = pushed(0.6);
  check_failure(out_of_reach, out_of_reach.at(Vector2d(0.8, 0.6)), KinematicsStatus::cannot_close, "stays open");
  // At the end of the range of the drive x does not determine y.
  check_failure(at_the_end, at_the_end.at(Vector2d(1, 0)), KinematicsStatus::undetermined,
                "a dead point: drives and joints do not prescribe the motion of coordinate 1 here");
  // A root of time has no rate at zero.
  const double infinite = std::numeric_limits<double>::infinity();
  jumping.bias = [=](const VectorXd&, const VectorXd&, double) { return VectorXd(Vector2d(0, infinite)); };
  check_failure(jumping, jumping.at(Vector2d(0.6, 0.8)), KinematicsStatus::singular, "accelerations are not numbers");
  test::SeveralCoordinates leaping = pushed(0.6, infinite);
  check_failure(leaping, leaping.at(Vector2d(0.6, 0.8)), KinematicsStatus::singular,
                "the forces there are not numbers");
  test::SeveralCoordinates outside = pushed(0.6);
  outside.outside = [](const State&) { return std::string("gap closed"); };
  check_failure(outside, outside.at(Vector2d(0.6, 0.8)), KinematicsStatus::singular, "t = 0 s: gap closed");
}

// A constraint of the fourth power is closed by less and less at a time: what is open in the end is round-off of what
// it compares.
TEST_CASE("ConstraintsThatTouch_AreClosedToRoundOff") {
  test::SeveralCoordinates e(MatrixXd::Identity(1, 1), 1);
  e.phi = [](const VectorXd& q, double) { return VectorXd(q.array().pow(4)); };
  e.G = [](const VectorXd& q, double) { return MatrixXd(4 * q.array().pow(3)); };
  State state = e.at(VectorXd::Constant(1, 0.4));
  const KinematicsSummary summary = solve_kinematics(e, state);
  CHECK(summary.solved());
  CHECK(summary.residual > 1e-13);  // the tolerance
  CHECK(summary.residual < 1e-11);  // what is accepted
}

}  // namespace kinematics_test
}  // namespace hersey::solver
