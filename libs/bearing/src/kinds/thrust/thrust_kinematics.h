#pragma once

#include <Eigen/Dense>

#include "hersey/core/spatial.h"

namespace hersey::bearing {

/// Parameters through which the plane of a runner opens the gap above a stator, in this order (theory manual,
/// thrust.1). In the stator's frame, whose plane z = 0 faces the runner, the runner's plane is z = zeta - a_x x - a_y
/// y.
enum ThrustParameter : int {
  kThrustZ,   ///< zeta, height of the runner's plane on the stator's axis [m]
  kThrustAx,  ///< a_x, slope of the runner's axis towards x [-]
  kThrustAy,  ///< a_y, the same towards y [-]
  kThrustZRate,
  kThrustAxRate,
  kThrustAyRate,  ///< their rates in the stator's frame
  kThrustSpeed,   ///< angular velocity of the runner about z [rad/s]
  kThrustParameterCount
};

/// Values of ThrustParameter for a runner frame B that moves relative to a stator frame A, with derivatives with
/// respect to the twist xi that moves B in A (dX_AB = xi^ X_AB) and to the relative velocity V_AB_A.
struct ThrustKinematics {
  Eigen::Matrix<double, kThrustParameterCount, 1> value = Eigen::Matrix<double, kThrustParameterCount, 1>::Zero();
  Eigen::Matrix<double, kThrustParameterCount, 6> d_dX = Eigen::Matrix<double, kThrustParameterCount, 6>::Zero();
  Eigen::Matrix<double, kThrustParameterCount, 6> d_dV = Eigen::Matrix<double, kThrustParameterCount, 6>::Zero();
};

/// True if the runner's plane is within 84 degrees of the stator's.
[[nodiscard]] bool faces_stator(const Pose& X_AB);

/// Returns the parameters of a runner that moves relative to its stator (thrust.1 to thrust.3).
/// @param X_AB,V_AB_A  runner relative to stator, as in mbd::RelativeMotion.
/// @throws ContractError unless the runner faces the stator.
/// @verified_by thrust_kinematics_test.cpp: ThrustDerivatives_MatchFiniteDifferences, ThrustRates_AreTimeDerivatives
[[nodiscard]] ThrustKinematics thrust_kinematics(const Pose& X_AB, const Vector6& V_AB_A);

}  // namespace hersey::bearing
