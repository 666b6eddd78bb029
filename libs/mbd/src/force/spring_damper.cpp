#include "hersey/mbd/spring_damper.h"

#include "hersey/core/contract.h"
#include "tree/quadrature.h"

namespace hersey::mbd {

SpringDamper::SpringDamper(double stiffness, double damping, double free_length,
                           std::shared_ptr<const ScalarFunction> tension)
    : stiffness_(stiffness), damping_(damping), free_length_(free_length), tension_(std::move(tension)) {
  HERSEY_REQUIRE(stiffness >= 0 && damping >= 0 && free_length >= 0, "a spring-damper stores and takes energy");
}

void SpringDamper::evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) {
  const Vector3& r = motion.X_AB.r;
  const Vector3 omega = motion.V_AB_A.head<3>();
  const Vector3 rdot = motion.V_AB_A.tail<3>() + omega.cross(r);
  const double length = r.norm();
  response = ForceResponse{};
  collapsed_ = length == 0 && (free_length_ > 0 || damping_ > 0 || tension_);
  if (length == 0) {
    if (want_tangent && !collapsed_) response.dW_dX.bottomRightCorner<3, 3>().diagonal().setConstant(-stiffness_);
    return;
  }
  // f on B = -(tension) u, u = r / l.
  const Vector3 u = r / length;
  const double rate = u.dot(rdot);
  double tension = stiffness_ * (length - free_length_) + damping_ * rate, stiffness = stiffness_;
  if (tension_) {
    double slope = 0;
    tension_->gradient({&length, 1}, {&slope, 1});
    tension += tension_->value({&length, 1});
    stiffness += slope;
  }
  const Vector3 f = -tension * u;
  response.W_B_A << r.cross(f), f;
  if (!want_tangent) return;

  // Both r and rdot follow a twist [phi; rho]: dr = rho + phi x r, d(rdot) = omega x dr.
  const Matrix3 across = Matrix3::Identity() - u * u.transpose();
  const Matrix3 df_dr = -(stiffness * u * u.transpose() + tension / length * across +
                          damping_ / length * u * (across * rdot).transpose());
  const Matrix3 df_drdot = -damping_ * u * u.transpose();
  const Matrix3 df = df_dr + df_drdot * skew(omega);
  Eigen::Matrix<double, 3, 6> dr;
  dr << -skew(r), Matrix3::Identity();
  response.dW_dX.topRows<3>() = (skew(r) * df - skew(f)) * dr;
  response.dW_dX.bottomRows<3>() = df * dr;
  response.dW_dV.topRows<3>() = skew(r) * df_drdot * dr;
  response.dW_dV.bottomRows<3>() = df_drdot * dr;
}

double SpringDamper::energy_of_tension(double length) const {
  if (!tension_ || reached_ < 0) return 0;
  return energy_ + integrate([&](double l) { return tension_->value({&l, 1}); }, reached_, length);
}

double SpringDamper::stored_energy(const RelativeMotion& motion) const {
  const double length = motion.X_AB.r.norm(), stretch = length - free_length_;
  return 0.5 * stiffness_ * stretch * stretch + energy_of_tension(length);
}

double SpringDamper::lost_power(const RelativeMotion& motion) const {
  const Vector3& r = motion.X_AB.r;
  const double length = r.norm();
  if (length == 0) return 0;
  const double rate = r.dot(motion.V_AB_A.tail<3>()) / length;
  return damping_ * rate * rate;
}

void SpringDamper::begin_step(const RelativeMotion& start, double) {
  if (reached_ < 0) reached_ = start.X_AB.r.norm();
}

void SpringDamper::accept_step(const RelativeMotion& end) {
  if (!tension_) return;
  const double length = end.X_AB.r.norm();
  energy_ = energy_of_tension(length);
  reached_ = length;
}

void SpringDamper::persist(Archive& archive) {
  if (tension_) archive.io("reached", reached_), archive.io("energy", energy_);
}

std::string SpringDamper::domain_error() const {
  return collapsed_ ? "the ends meet, so its direction is undefined" : std::string();
}

}  // namespace hersey::mbd
