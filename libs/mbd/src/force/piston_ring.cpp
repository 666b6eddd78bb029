#include "hersey/mbd/piston_ring.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hersey/core/contract.h"

namespace hersey::mbd {
namespace {

/// Speed of the ring along the liner [m/s].
double sliding_speed(const RelativeMotion& motion) {
  const Vector3 omega = motion.V_AB_A.head<3>();
  return (motion.V_AB_A.tail<3>() + omega.cross(motion.X_AB.r)).z();
}

}  // namespace

PistonRing::PistonRing(Data data) : data_(std::move(data)) {
  HERSEY_REQUIRE(data_.bore > 0 && data_.height > 0, "a ring has a bore and a face");
  HERSEY_REQUIRE(data_.tension >= 0 && data_.viscosity >= 0, "a ring is pressed outwards, and oil has a viscosity");
  HERSEY_REQUIRE(data_.transition_speed > 0, "friction passes zero speed smoothly");
  HERSEY_REQUIRE(data_.stribeck != nullptr && data_.lowest <= data_.highest, "a Stribeck curve with its range");
}

double PistonRing::radial_load(double t) const {
  const double tension = 2 * data_.tension / (data_.bore * data_.height);
  const double p = tension + (data_.gas ? data_.gas->value({&t, 1}) : 0);
  return std::max(p, 0.0) * std::numbers::pi * data_.bore * data_.height;
}

PistonRing::Friction PistonRing::friction(double speed, double t) const {
  const double N = radial_load(t);
  if (N == 0) return {};
  const double per_speed = data_.viscosity * std::numbers::pi * data_.bore / N;  // H over |v|
  const double H = per_speed * std::abs(speed), within = std::clamp(H, data_.lowest, data_.highest);
  const double mu_friction = data_.stribeck->value({&within, 1});
  double slope = 0;
  if (H == within) data_.stribeck->gradient({&within, 1}, {&slope, 1});
  const double v_t = data_.transition_speed, s = std::hypot(speed, v_t);
  return {.force = mu_friction * N * speed / s,
          .by_speed = N * (slope * per_speed * std::abs(speed) / s + mu_friction * v_t * v_t / (s * s * s))};
}

void PistonRing::evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) {
  const Vector3& r = motion.X_AB.r;
  const Vector3 omega = motion.V_AB_A.head<3>(), axis = Vector3::UnitZ();
  const Friction friction = this->friction(sliding_speed(motion), motion.t);
  const Vector3 f = -friction.force * axis;
  response = ForceResponse{};
  response.W_B_A << r.cross(f), f;
  if (!want_tangent) return;

  // A twist [phi; rho] of B moves its origin by dr = rho + phi x r, and its speed by (omega x dr)_z.
  Eigen::Matrix<double, 3, 6> dr;
  dr << -skew(r), Matrix3::Identity();
  const Eigen::Matrix<double, 3, 6> df_dX = -friction.by_speed * axis * (axis.transpose() * skew(omega) * dr),
                                    df_dV = -friction.by_speed * axis * (axis.transpose() * dr);
  response.dW_dX.topRows<3>() = skew(r) * df_dX - skew(f) * dr;
  response.dW_dX.bottomRows<3>() = df_dX;
  response.dW_dV.topRows<3>() = skew(r) * df_dV;
  response.dW_dV.bottomRows<3>() = df_dV;
}

double PistonRing::lost_power(const RelativeMotion& motion) const {
  const double speed = sliding_speed(motion);
  return friction(speed, motion.t).force * speed;
}

}  // namespace hersey::mbd
