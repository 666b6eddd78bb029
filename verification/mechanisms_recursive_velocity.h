#pragma once

#include <Eigen/Dense>
#include <numbers>
#include <span>

#include "hersey/core/spatial.h"
#include "hersey/mbd/joint.h"

/// The recursive velocity relation across one joint as Choi et al. (2012), Eq. 5-7, have it: in the bodies' own axes,
/// where the program works in ground's.
namespace hersey::verification {

/// Theory manual eq. (mechanisms.1): Y_j = B1 Y_i + B2 qdot, Y the velocity [omega; v] of a body at its own origin and
/// in its own axes, i inboard, j outboard; both matrices depend on the joint's values alone.
struct RecursiveVelocity {
  Matrix6 B1 = Matrix6::Identity();
  Eigen::Matrix<double, 6, Eigen::Dynamic> B2;  ///< shape (6, degrees of freedom), columns in the order of the values
};

/// @param X_iI    inboard joint frame on body i
/// @param X_jO    outboard joint frame on body j
/// @param values  joint values, an orientation as rotation vector; its rate is the angular velocity in O's axes
/// @param lead    of a screw, see mbd::joint_pose
/// @verified_by derivatives_test.cpp: B1AndB2_MatchFiniteDifferences
[[nodiscard]] inline RecursiveVelocity recursive_velocity(mbd::JointType type, const Vector3& axis, const Pose& X_iI,
                                                          const Pose& X_jO, std::span<const double> values,
                                                          double lead = 0) {
  using mbd::JointType;
  const Pose X_IO = joint_pose(type, axis, values, lead);
  const Pose X_Oj = X_jO.inverse();
  const Pose X_ji = (X_iI * X_IO * X_Oj).inverse();
  RecursiveVelocity relation;
  relation.B1 = motion_transform(X_ji);

  // Columns at O's origin: translations run along the inboard axes, so turn into O's with R_OI; rotations run about
  // O's.
  const Matrix3 axes = mbd::joint_axes(axis);
  const Vector3 n = axes.col(2);
  const Matrix3 R_OI = X_IO.R.transpose();
  const int dof = degrees_of_freedom(type);
  Eigen::Matrix<double, 6, Eigen::Dynamic> H = Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, dof);
  switch (type) {
    case JointType::fixed:
      break;
    case JointType::revolute:
      H.col(0).head<3>() = n;
      break;
    case JointType::prismatic:
      H.col(0).tail<3>() = n;
      break;
    case JointType::cylindrical:
      H.col(0).tail<3>() = R_OI * n;
      H.col(1).head<3>() = n;
      break;
    case JointType::spherical:
      H.topRows<3>().setIdentity();
      break;
    case JointType::planar:
      H.col(0).tail<3>() = R_OI * axes.col(0);
      H.col(1).tail<3>() = R_OI * axes.col(1);
      H.col(2).head<3>() = n;
      break;
    case JointType::free:
      H.block<3, 3>(3, 0) = R_OI;
      H.block<3, 3>(0, 3).setIdentity();
      break;
    case JointType::universal:
      H.col(0).head<3>() = R_OI * axes.col(0);
      H.col(1).head<3>() = axes.col(1);
      break;
    case JointType::screw:
      H.col(0) << n, lead / (2 * std::numbers::pi) * n;
      break;
  }
  relation.B2 = motion_transform(X_jO) * H;
  return relation;
}

}  // namespace hersey::verification
