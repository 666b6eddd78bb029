#pragma once

#include <Eigen/Dense>

/// Rotations and 6D spatial algebra (theory manual, chapter core).
///
/// Spatial vectors put the rotational part first: motion V = [omega; v], force W = [tau; f]. A spatial vector belongs
/// to a frame: V_AB_E is the velocity of B relative to A, taken at the origin of E and in the axes of E; its linear
/// part is the velocity of the point of B that passes through the origin of E. Power is W . V.
namespace hersey {

using Vector3 = Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix3 = Eigen::Matrix3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Returns a~ with a~ b = a x b.
[[nodiscard]] inline Matrix3 skew(const Vector3& a) {
  return (Matrix3() << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0).finished();
}

/// Returns the rotation by the rotation vector `phi` (Rodrigues' formula), smooth at phi = 0.
[[nodiscard]] Eigen::Quaterniond rotation_exp(const Vector3& phi);

/// Returns the rotation vector of `R`; its length is at most pi.
[[nodiscard]] Vector3 rotation_log(const Eigen::Quaterniond& R);

/// Returns T with exp(phi)^T d exp(phi) = (T(phi) dphi)~, the right Jacobian of SO(3): it maps a change of the rotation
/// vector to the rotation of the rotated frame in the axes of that frame.
[[nodiscard]] Matrix3 rotation_exp_tangent(const Vector3& phi);

/// X_AB: pose of frame B in frame A, r_A = R_AB r_B + r_AB_A.
struct Pose {
  Matrix3 R = Matrix3::Identity();  ///< R_AB, axes of B in A
  Vector3 r = Vector3::Zero();      ///< r_AB_A, origin of B from the origin of A [m]

  [[nodiscard]] Pose operator*(const Pose& X_BC) const { return {R * X_BC.R, r + R * X_BC.r}; }
  /// Returns X_BA.
  [[nodiscard]] Pose inverse() const { return {R.transpose(), -(R.transpose() * r)}; }
  [[nodiscard]] Vector3 operator*(const Vector3& r_B) const { return R * r_B + r; }
};

/// Returns Ad(X_AB), which transforms a motion vector from frame B to frame A: V_A = Ad(X_AB) V_B.
[[nodiscard]] inline Matrix6 motion_transform(const Pose& X_AB) {
  Matrix6 Ad;
  Ad << X_AB.R, Matrix3::Zero(), skew(X_AB.r) * X_AB.R, X_AB.R;
  return Ad;
}

/// Returns Ad*(X_AB) = Ad(X_AB)^{-T}, which transforms a force vector from frame B to frame A: W_A = Ad*(X_AB) W_B.
[[nodiscard]] inline Matrix6 force_transform(const Pose& X_AB) {
  Matrix6 Ad;
  Ad << X_AB.R, skew(X_AB.r) * X_AB.R, Matrix3::Zero(), X_AB.R;
  return Ad;
}

/// Returns Ad*(X_AB) W_B without forming the matrix.
[[nodiscard]] inline Vector6 moved_force(const Pose& X_AB, const Vector6& W_B) {
  const Vector3 f = X_AB.R * W_B.tail<3>();
  Vector6 W;
  W << X_AB.R * W_B.head<3>() + X_AB.r.cross(f), f;
  return W;
}

/// Returns V x U for two motion vectors (the Lie bracket of se(3)).
[[nodiscard]] inline Vector6 cross_motion(const Vector6& V, const Vector6& U) {
  Vector6 c;
  c << V.head<3>().cross(U.head<3>()), V.head<3>().cross(U.tail<3>()) + V.tail<3>().cross(U.head<3>());
  return c;
}

/// Returns V x* W for a motion and a force vector; (V x* W) . U = -W . (V x U).
[[nodiscard]] inline Vector6 cross_force(const Vector6& V, const Vector6& W) {
  Vector6 c;
  c << V.head<3>().cross(W.head<3>()) + V.tail<3>().cross(W.tail<3>()), V.head<3>().cross(W.tail<3>());
  return c;
}

/// Returns the matrix of U -> V x U.
[[nodiscard]] inline Matrix6 cross_motion_matrix(const Vector6& V) {
  Matrix6 c;
  c << skew(V.head<3>()), Matrix3::Zero(), skew(V.tail<3>()), skew(V.head<3>());
  return c;
}

/// Returns the matrix of W -> V x* W.
[[nodiscard]] inline Matrix6 cross_force_matrix(const Vector6& V) { return -cross_motion_matrix(V).transpose(); }

/// Returns exp(xi^), the pose reached by the constant twist xi after unit time, in the frame of xi.
[[nodiscard]] Pose pose_exp(const Vector6& xi);

}  // namespace hersey
