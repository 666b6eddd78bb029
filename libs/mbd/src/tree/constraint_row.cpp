#include "tree/constraint_row.h"

#include "tree/joint_kind.h"

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
  std::vector<ConstraintRow> rows;
  for (const auto& [a, b] : kind_of(type).rows)
    rows.push_back({b ? ConstraintRow::Kind::orientation : ConstraintRow::Kind::position, direction(a, axes),
                    b ? direction(*b, axes) : Vector3::Zero()});
  return rows;
}

}  // namespace hersey::mbd
