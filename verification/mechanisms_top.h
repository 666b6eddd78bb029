#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>

/// Torque-free rotation of a symmetric body (Landau and Lifshitz, Mechanics, sec. 33 and 36).
namespace hersey::verification {

/// Moments A about the two transverse body axes, C about the body's z axis; angular velocity omega (body axes) at t =
/// 0, when body and space axes coincide.
struct SymmetricTop {
  double A, C;
  Eigen::Vector3d omega;

  /// Precession about the fixed angular momentum H at H/A, then spin about the body's axis at (1 - C/A) omega_z.
  [[nodiscard]] Eigen::Matrix3d orientation(double t) const {
    const Eigen::Vector3d H(A * omega.x(), A * omega.y(), C * omega.z());
    const Eigen::AngleAxisd precession(H.norm() / A * t, H.normalized());
    const Eigen::AngleAxisd spin((1 - C / A) * omega.z() * t, Eigen::Vector3d::UnitZ());
    return precession.toRotationMatrix() * spin.toRotationMatrix();
  }

  /// Body axes.
  [[nodiscard]] Eigen::Vector3d angular_velocity(double t) const {
    return Eigen::AngleAxisd(-(1 - C / A) * omega.z() * t, Eigen::Vector3d::UnitZ()) * omega;
  }
};

}  // namespace hersey::verification
