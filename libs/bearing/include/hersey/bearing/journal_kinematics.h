#pragma once

#include <Eigen/Dense>

#include "hersey/core/spatial.h"
#include "hersey/film/film_model.h"
#include "hersey/film/reynolds.h"

namespace hersey::bearing {

/// Parameters through which a rigid journal acts on a film, in this order. `e` is the point in which the journal's axis
/// pierces the bearing's mid-plane z = 0, `t` its slope d e/dz, both in the bearing frame (theory manual, chapter
/// bearing).
enum Parameter : int {
  kEx,
  kEy,
  kTx,
  kTy,  ///< e_x, e_y [m], t_x, t_y [-]
  kExRate,
  kEyRate,
  kTxRate,
  kTyRate,        ///< their rates in the bearing frame
  kJournalSpeed,  ///< circumferential speed of the journal surface relative to the shell [m/s]
  kAxialSpeed,    ///< axial speed of the journal relative to the shell [m/s]
  kSupplyAngle,   ///< angle of the widest gap at z = 0 [rad]
  kRotation,      ///< rotation of the journal about the bearing's axis [rad], -pi to pi
  kParameterCount
};

using ParameterVector = Eigen::Matrix<double, kParameterCount, 1>;
using ParameterJacobian = Eigen::Matrix<double, kParameterCount, 6>;

/// Film parameters of a journal frame B that moves relative to a bearing frame A, with derivatives with respect to the
/// twist xi that moves B in A (dX_AB = xi^ X_AB) and to the relative velocity V_AB_A.
struct JournalKinematics {
  ParameterVector value = ParameterVector::Zero();
  ParameterJacobian d_dX = ParameterJacobian::Zero();
  ParameterJacobian d_dV = ParameterJacobian::Zero();

  /// Eccentricity in the mid-plane [m].
  [[nodiscard]] Eigen::Vector2d e() const { return value.segment<2>(kEx); }
  /// Slope of the journal's axis [-].
  [[nodiscard]] Eigen::Vector2d tilt() const { return value.segment<2>(kTx); }
};

/// True if the journal's axis is within 84 degrees of the bearing's, so that it pierces the mid-plane.
[[nodiscard]] bool is_aligned(const Pose& X_AB);

/// @param X_AB,V_AB_A  journal relative to bearing, as in mbd::RelativeMotion.
/// @param R            bearing radius [m].
/// @param e_floor      eccentricity below which the angle of the widest gap is taken not to change [m].
/// @throws ContractError unless the journal is aligned.
/// @verified_by journal_kinematics_test.cpp: Derivatives_MatchFiniteDifferences, Rates_AreTimeDerivatives
[[nodiscard]] JournalKinematics journal_kinematics(const Pose& X_AB, const Vector6& V_AB_A, double R, double e_floor);

}  // namespace hersey::bearing
