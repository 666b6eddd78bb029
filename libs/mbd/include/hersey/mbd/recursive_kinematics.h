#pragma once

#include <Eigen/Dense>
#include <span>

#include "hersey/core/spatial.h"
#include "hersey/mbd/joint.h"

namespace hersey::mbd {

/// The recursive velocity relation across one joint (Choi et al. 2012, Eq. 5-7; theory manual eq. (mechanisms.1)):
///
///     Y_j = B1 Y_i + B2 qdot,
///
/// Y the velocity [omega; v] of a body at its own origin and in its own axes, i inboard, j outboard; both matrices
/// depend on the joint's values alone.
struct RecursiveVelocity {
  Matrix6 B1 = Matrix6::Identity();
  Eigen::Matrix<double, 6, Eigen::Dynamic> B2;  ///< shape (6, degrees of freedom), columns in the order of the values
};

/// @param X_iI    inboard joint frame on body i
/// @param X_jO    outboard joint frame on body j
/// @param values  joint values, an orientation as rotation vector; its rate is the angular velocity in O's axes
/// @param lead    of a screw, see joint_pose
/// @verified_by derivatives_test.cpp: B1AndB2_MatchFiniteDifferences
[[nodiscard]] RecursiveVelocity recursive_velocity(JointType type, const Vector3& axis, const Pose& X_iI,
                                                   const Pose& X_jO, std::span<const double> values, double lead = 0);

}  // namespace hersey::mbd
