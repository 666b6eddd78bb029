#include "hersey/core/spatial.h"

#include <cmath>

namespace hersey {
namespace {

// Returns (1 - cos a)/a^2 and (a - sin a)/a^3, by their series where the closed forms lose digits.
double versine_ratio(double a) { return a < 1e-3 ? 0.5 - a * a / 24.0 : (1.0 - std::cos(a)) / (a * a); }
double sine_defect_ratio(double a) {
  return a < 1e-2 ? 1.0 / 6.0 - a * a / 120.0 + a * a * a * a / 5040.0 : (a - std::sin(a)) / (a * a * a);
}

}  // namespace

Eigen::Quaterniond rotation_exp(const Vector3& phi) {
  const double half = 0.5 * phi.norm();
  // sin(half)/(2 half): half of sinc, by its series near zero.
  const double s = half < 1e-4 ? 0.5 * (1.0 - half * half / 6.0) : 0.5 * std::sin(half) / half;
  return Eigen::Quaterniond(std::cos(half), s * phi.x(), s * phi.y(), s * phi.z());
}

Vector3 rotation_log(const Eigen::Quaterniond& R) {
  const double sign = R.w() < 0 ? -1.0 : 1.0;
  const double sine = R.vec().norm();
  const double angle = 2.0 * std::atan2(sine, sign * R.w());
  const double factor = sine < 1e-8 ? 2.0 : angle / sine;
  return sign * factor * R.vec();
}

Matrix3 rotation_exp_tangent(const Vector3& phi) {
  const double a = phi.norm();
  const Matrix3 P = skew(phi);
  return Matrix3::Identity() - versine_ratio(a) * P + sine_defect_ratio(a) * P * P;
}

Pose pose_exp(const Vector6& xi) {
  const Vector3 phi = xi.head<3>();
  const double a = phi.norm();
  const Matrix3 P = skew(phi);
  const Matrix3 left = Matrix3::Identity() + versine_ratio(a) * P + sine_defect_ratio(a) * P * P;
  return {rotation_exp(phi).toRotationMatrix(), left * xi.tail<3>()};
}

}  // namespace hersey
