#include "hersey/mbd/bushing.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "hersey/core/contract.h"

namespace hersey::mbd {
namespace {

/// The rotation vector phi as a coordinate: its rate is  u = omega + s/2 phi x omega + c phi x (phi x omega)  with
/// s = -1, and a moment m that works on it acts on the body as the same expression with s = +1.
class RotationVector {
 public:
  explicit RotationVector(const Vector3& phi) : phi_(phi) {
    const double a = phi.norm();
    if (a < 0.05) {
      // Series of 1/a^2 - (1 + cos a)/(2 a sin a) and of its derivative over a.
      const double a2 = a * a;
      c_ = 1.0 / 12 + a2 / 720 + a2 * a2 / 30240 + a2 * a2 * a2 / 1209600;
      dc_over_a_ = 1.0 / 360 + a2 / 7560 + a2 * a2 / 201600;
      return;
    }
    const double half_cot = 0.5 / std::tan(0.5 * a);
    c_ = (1 - a * half_cot) / (a * a);
    const double d_half_cot = -0.25 / (std::sin(0.5 * a) * std::sin(0.5 * a));
    dc_over_a_ = ((-half_cot - a * d_half_cot) / (a * a) - 2 * c_ / a) / a;
  }

  /// The matrix that takes x to x + s/2 phi x x + c phi x (phi x x).
  [[nodiscard]] Matrix3 map(double s) const {
    const Matrix3 P = skew(phi_);
    return Matrix3::Identity() + 0.5 * s * P + c_ * P * P;
  }

  /// Derivative of map(s) x with respect to phi.
  [[nodiscard]] Matrix3 derivative(double s, const Vector3& x) const {
    const double along = phi_.dot(x);
    return -0.5 * s * skew(x) + dc_over_a_ * phi_.cross(phi_.cross(x)) * phi_.transpose() +
           c_ * (along * Matrix3::Identity() + phi_ * x.transpose() - 2 * x * phi_.transpose());
  }

 private:
  Vector3 phi_;
  double c_, dc_over_a_;
};

Vector6 deformation(const Pose& X_AB) {
  Vector6 x;
  x << rotation_log(Eigen::Quaterniond(X_AB.R)), X_AB.r;
  return x;
}

/// B in xdot = B V.
Matrix6 rates_of(const Vector6& x) {
  Matrix6 B = Matrix6::Identity();
  B.topLeftCorner<3, 3>() = RotationVector(x.head<3>()).map(-1);
  B.bottomLeftCorner<3, 3>() = -skew(x.tail<3>());
  return B;
}

}  // namespace

Bushing::Bushing(const Matrix6& stiffness, const Matrix6& damping) : K_(stiffness), D_(damping) {
  HERSEY_REQUIRE(K_.isApprox(K_.transpose(), 1e-9) || K_.isZero(), "a bushing's stiffness is symmetric");
  HERSEY_REQUIRE(D_.isApprox(D_.transpose(), 1e-9) || D_.isZero(), "a bushing's damping is symmetric");
}

void Bushing::evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) {
  const Vector6 x = deformation(motion.X_AB);
  const Vector3 phi = x.head<3>();
  const Vector3 omega = motion.V_AB_A.head<3>();
  const RotationVector rotation(phi);
  angle_ = phi.norm();
  // xdot = B V, and W = -B^T s with s = K x + D xdot.
  const Matrix6 B = rates_of(x);
  const Vector6 s = K_ * x + D_ * (B * motion.V_AB_A);
  response = ForceResponse{};
  response.W_B_A = -B.transpose() * s;
  if (!want_tangent) return;

  // A twist moves x by B xi. d(xdot) = dB V: of the map in phi, and of omega x r in r.
  Matrix6 rate_by_x = Matrix6::Zero();
  rate_by_x.topLeftCorner<3, 3>() = rotation.derivative(-1, omega);
  rate_by_x.bottomRightCorner<3, 3>() = skew(omega);
  const Matrix6 ds = K_ + D_ * rate_by_x;
  // d(B^T) s: of the map's transpose in phi, and of r x s_r in r.
  Matrix6 rotated = Matrix6::Zero();
  rotated.topLeftCorner<3, 3>() = rotation.derivative(+1, s.head<3>());
  rotated.topRightCorner<3, 3>() = -skew(s.tail<3>());
  response.dW_dX = -(B.transpose() * ds + rotated) * B;
  response.dW_dV = -B.transpose() * D_ * B;
}

double Bushing::stored_energy(const RelativeMotion& motion) const {
  const Vector6 x = deformation(motion.X_AB);
  return 0.5 * x.dot(K_ * x);
}

double Bushing::lost_power(const RelativeMotion& motion) const {
  const Vector6 rate = rates_of(deformation(motion.X_AB)) * motion.V_AB_A;
  return rate.dot(D_ * rate);
}

std::string Bushing::domain_error() const {
  constexpr double largest = 170.0 / 180 * std::numbers::pi;
  if (angle_ <= largest) return {};
  return fmt::format("rotated by {:.0f} deg; its rotation is defined below 180 deg", angle_ * 180 / std::numbers::pi);
}

}  // namespace hersey::mbd
