#pragma once

#include <vector>

#include "hersey/core/spatial.h"
#include "hersey/mbd/joint.h"

namespace hersey::mbd {

/// One scalar constraint on the pose of frame B relative to frame A (theory manual eq. (mechanisms.14)):
/// positional  Phi = a . r_AB_A,  or orientational  Phi = a . R_AB b.
struct ConstraintRow {
  enum class Kind { position, orientation };
  Kind kind = Kind::position;
  Vector3 a = Vector3::Zero();  ///< in A
  Vector3 b = Vector3::Zero();  ///< in B; unused by a positional row

  [[nodiscard]] double value(const Pose& X_AB) const;

  /// w with  dPhi = w . xi  for a twist xi_A that moves B relative to A (mechanisms.15): the wrench on B, at A's origin
  /// and in A's axes, that a unit multiplier means.
  [[nodiscard]] Vector6 wrench(const Pose& X_AB) const;

  /// dw/dxi: the geometric stiffness of a unit multiplier.
  [[nodiscard]] Matrix6 wrench_derivative(const Pose& X_AB) const;
};

/// The rows that leave free what a joint of this type leaves free.
[[nodiscard]] std::vector<ConstraintRow> constraint_rows(JointType type, const Vector3& axis);

}  // namespace hersey::mbd
