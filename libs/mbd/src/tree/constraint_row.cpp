#include "tree/constraint_row.h"

namespace hersey::mbd {

double ConstraintRow::value(const Pose& X_AB) const {
  return kind == Kind::position ? a.dot(X_AB.r) : a.dot(X_AB.R * b);
}

Vector6 ConstraintRow::wrench(const Pose& X_AB) const {
  // A twist [phi; rho] changes r by rho + phi x r and R b by phi x R b.
  Vector6 w;
  if (kind == Kind::position) {
    w << X_AB.r.cross(a), a;
  } else {
    w << (X_AB.R * b).cross(a), Vector3::Zero();
  }
  return w;
}

Matrix6 ConstraintRow::wrench_derivative(const Pose& X_AB) const {
  Matrix6 K = Matrix6::Zero();
  const Matrix3 A = skew(a);
  if (kind == Kind::position) {
    // d(r x a) = -a~ (rho - r~ phi)
    K.topLeftCorner<3, 3>() = A * skew(X_AB.r);
    K.topRightCorner<3, 3>() = -A;
  } else {
    // d(Rb x a) = -a~ (phi x Rb) = a~ (Rb)~ phi
    K.topLeftCorner<3, 3>() = A * skew(X_AB.R * b);
  }
  return K;
}

std::vector<ConstraintRow> constraint_rows(JointType type, const Vector3& axis) {
  const Matrix3 axes = joint_axes(axis);
  const Vector3 t1 = axes.col(0), t2 = axes.col(1), n = axes.col(2);
  const auto position = [](const Vector3& a) {
    return ConstraintRow{ConstraintRow::Kind::position, a, Vector3::Zero()};
  };
  const auto orientation = [](const Vector3& a, const Vector3& b) {
    return ConstraintRow{ConstraintRow::Kind::orientation, a, b};
  };
  switch (type) {
    case JointType::fixed:
      return {position(t1), position(t2), position(n), orientation(t1, t2), orientation(t2, n), orientation(n, t1)};
    case JointType::revolute:
      return {position(t1), position(t2), position(n), orientation(t1, n), orientation(t2, n)};
    case JointType::prismatic:
      return {position(t1), position(t2), orientation(t1, t2), orientation(t2, n), orientation(n, t1)};
    case JointType::cylindrical:
      return {position(t1), position(t2), orientation(t1, n), orientation(t2, n)};
    case JointType::spherical:
      return {position(t1), position(t2), position(n)};
    case JointType::planar:
      return {position(n), orientation(t1, n), orientation(t2, n)};
    case JointType::universal:
      return {position(t1), position(t2), position(n), orientation(t1, t2)};
    case JointType::free:
    case JointType::screw:  // becomes a chain, see build_tree
      return {};
  }
  return {};
}

}  // namespace hersey::mbd
