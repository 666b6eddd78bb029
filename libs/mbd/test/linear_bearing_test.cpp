#include "hersey/mbd/linear_bearing.h"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include "relative.h"
#include "test_mechanisms.h"

// Bearings by a table of their coefficients (theory manual, rotors.1 to rotors.3).
namespace hersey::mbd {
namespace linear_bearing_test {

constexpr double kRoundOff = 1e-13;  // of a few operations

BearingCoefficients coefficients(double scale) {
  BearingCoefficients c;
  c.stiffness << 3e6, 2e6, -1.5e6, 5e6;
  c.damping << 4e3, -6e2, -5e2, 7e3;
  c.inertia << 3, 0.2, 0.2, 2;
  c.position = {2e-5, -4e-5};
  c.force = {30, 400};
  c.stiffness *= scale, c.damping /= scale, c.inertia *= scale, c.position /= scale;
  return c;
}

std::shared_ptr<const BearingCoefficientTable> table() {
  return std::make_shared<const BearingCoefficientTable>(
      std::vector{100.0, 200.0, 350.0, 500.0},
      std::vector{coefficients(1), coefficients(1.4), coefficients(1.7), coefficients(2.5)});
}

RelativeMotion motion_at(double speed) {
  RelativeMotion motion;
  motion.X_AB = {rotation_exp({0.02, -0.03, 0.4}).toRotationMatrix(), {8e-5, -2e-5, 3e-3}};
  motion.V_AB_A << 0.3, -0.2, speed, 0.04, -0.03, 0.02;
  motion.A_AB_A << 4, 7, 60, 3, -5, 2;
  return motion;
}

// In a motion along x and y alone, f = F_0 - K (x - x_0) - C xdot - M xddot.
TEST_CASE("LinearBearing_ActsByItsCoefficients") {
  LinearBearing bearing(table());
  RelativeMotion motion;
  motion.X_AB.r = {7e-5, -1e-5, 2e-3};
  motion.V_AB_A << 0, 0, 200, 0, 0, 0;
  const Eigen::Vector2d u(0.03, -0.05), rate(11, 4);
  // At A's origin the velocity lacks omega x r, the acceleration alpha x r + omega x u.
  motion.V_AB_A.tail<3>() = Vector3(u.x(), u.y(), 0) - Vector3(0, 0, 200).cross(motion.X_AB.r);
  motion.A_AB_A.tail<3>() = Vector3(rate.x(), rate.y(), 0) - Vector3(0, 0, 200).cross(Vector3(u.x(), u.y(), 0));
  ForceResponse response;
  bearing.evaluate(motion, false, response);
  const BearingCoefficients c = coefficients(1.4);
  const Eigen::Vector2d f =
      c.force - c.stiffness * (motion.X_AB.r.head<2>() - c.position) - c.damping * u - c.inertia * rate;
  CHECK(response.W_B_A[3] == relative(f.x()).epsilon(kRoundOff));
  CHECK(response.W_B_A[4] == relative(f.y()).epsilon(kRoundOff));
  CHECK(response.W_B_A[5] == 0);
  const Vector3 moment = motion.X_AB.r.cross(Vector3(f.x(), f.y(), 0));
  CHECK((response.W_B_A.head<3>() - moment).norm() < kRoundOff * moment.norm());
}

TEST_CASE("LinearBearing_HasExactDerivatives") {
  LinearBearing bearing(table());
  for (const double speed : {250.0, 80.0, 600.0}) {  // within the table and beyond both ends
    CAPTURE(speed);
    const RelativeMotion motion = motion_at(speed);
    ForceResponse centre, other, less;
    bearing.evaluate(motion, true, centre);
    for (int k = 0; k < 6; ++k) {
      CAPTURE(k);
      constexpr double step = 1e-5;
      const auto differs = [&](auto change, const Matrix6& derivative, double size) {
        RelativeMotion plus = motion, minus = motion;
        change(plus, step), change(minus, -step);
        bearing.evaluate(plus, false, other), bearing.evaluate(minus, false, less);
        const Vector6 difference = (other.W_B_A - less.W_B_A) / (2 * step) - derivative.col(k);
        CHECK(difference.norm() < 1e-6 * size);  // of central differences of smooth functions
      };
      const auto twist = [&](RelativeMotion& m, double by) {
        Vector6 xi = Vector6::Zero();
        xi[k] = by;
        m.X_AB.r = rotation_exp(xi.head<3>()).toRotationMatrix() * m.X_AB.r + xi.tail<3>();
      };
      differs(twist, centre.dW_dX, centre.dW_dX.norm());
      differs([&](RelativeMotion& m, double by) { m.V_AB_A[k] += by; }, centre.dW_dV, centre.dW_dV.norm());
      differs([&](RelativeMotion& m, double by) { m.A_AB_A[k] += by; }, centre.dW_dA, centre.dW_dA.norm());
    }
  }
}

// What the bearing takes from the shaft is stored, moved along or lost, also while the speed changes.
TEST_CASE("LinearBearing_AccountsForAllOfItsPower") {
  LinearBearing bearing(table());
  for (const double speed : {250.0, 420.0}) {
    const RelativeMotion motion = motion_at(speed);
    // The motion a little earlier and later: r' = u, V' = A, as an observer on A sees them.
    const auto moved = [&](double dt) {
      RelativeMotion m = motion;
      const Vector3 omega = motion.V_AB_A.head<3>(), alpha = motion.A_AB_A.head<3>();
      const Vector3 u = motion.V_AB_A.tail<3>() + omega.cross(motion.X_AB.r);
      const Vector3 rate = motion.A_AB_A.tail<3>() + alpha.cross(motion.X_AB.r) + omega.cross(u);
      m.X_AB.r += dt * u + 0.5 * dt * dt * rate;
      m.V_AB_A += dt * motion.A_AB_A;
      return m;
    };
    constexpr double dt = 1e-7;
    const auto energy = [&](double by) { return bearing.stored_energy(moved(by)) + bearing.kinetic_energy(moved(by)); };
    const double stored = (energy(dt) - energy(-dt)) / (2 * dt);
    ForceResponse response;
    bearing.evaluate(motion, false, response);
    const double taken = -response.W_B_A.dot(motion.V_AB_A);
    CHECK(taken == relative(stored + bearing.lost_power(motion)).epsilon(1e-6));  // of central differences
  }
}

TEST_CASE("BearingCoefficients_AreThoseOfTheTableAndConstantBeyondIt") {
  const auto t = table();
  CHECK((t->at(350).stiffness - coefficients(1.7).stiffness).norm() < kRoundOff * 1e7);
  CHECK(t->at(20).stiffness == t->at(100).stiffness);
  CHECK(t->at(900).damping == t->at(500).damping);
  CHECK(t->slope(900).stiffness.isZero());
  CHECK(t->at(-200).force == coefficients(1).force);
  const BearingCoefficientTable constant({0}, {coefficients(2)});
  for (const double speed : {0.0, 50.0, -4.0, 504.0}) CHECK(t->fault_at(speed).empty());
  for (const double speed : {-10.0, 510.0})
    CHECK(t->fault_at(speed).find("the table of coefficients has speeds from") != std::string::npos);
  CHECK(constant.fault_at(-900).empty());
  CHECK(constant.at(-300).stiffness == coefficients(2).stiffness);
  CHECK(constant.slope(0).damping.isZero());
}

}  // namespace linear_bearing_test
}  // namespace hersey::mbd
