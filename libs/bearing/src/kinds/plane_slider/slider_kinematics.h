#pragma once

#include <Eigen/Dense>

#include "hersey/core/spatial.h"

namespace hersey::bearing {

/// Parameters through which the plane of a runner opens the gap below a pad, in this order (theory manual, slider.1).
/// In the pad's frame, whose plane x = 0 faces the runner, the runner's plane is x = e + t_y y + t_z z.
enum SliderParameter : int {
  kSliderE,   ///< e, negative: minus the film thickness at the pad's origin [m]
  kSliderTy,  ///< t_y, slope along the sliding direction [-]
  kSliderTz,  ///< t_z, slope across it [-]
  kSliderERate,
  kSliderTyRate,
  kSliderTzRate,     ///< their rates in the pad's frame
  kSliderSpeed,      ///< speed of the runner along y at the pad's origin [m/s]
  kSliderSideSpeed,  ///< the same along z [m/s]
  kSliderParameterCount
};

/// Values of SliderParameter for a runner frame B that moves relative to a pad frame A, with derivatives with respect
/// to the twist xi that moves B in A (dX_AB = xi^ X_AB) and to the relative velocity V_AB_A.
struct SliderKinematics {
  Eigen::Matrix<double, kSliderParameterCount, 1> value = Eigen::Matrix<double, kSliderParameterCount, 1>::Zero();
  Eigen::Matrix<double, kSliderParameterCount, 6> d_dX = Eigen::Matrix<double, kSliderParameterCount, 6>::Zero();
  Eigen::Matrix<double, kSliderParameterCount, 6> d_dV = Eigen::Matrix<double, kSliderParameterCount, 6>::Zero();
};

/// True if the runner's plane is within 84 degrees of the pad's.
[[nodiscard]] bool faces_pad(const Pose& X_AB);

/// @param X_AB,V_AB_A  runner relative to pad, as in mbd::RelativeMotion.
/// @throws ContractError unless the runner faces the pad.
/// @verified_by slider_kinematics_test.cpp: Derivatives_MatchFiniteDifferences, Rates_AreTimeDerivatives
[[nodiscard]] SliderKinematics slider_kinematics(const Pose& X_AB, const Vector6& V_AB_A);

}  // namespace hersey::bearing
