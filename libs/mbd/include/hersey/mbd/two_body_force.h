#pragma once

#include <Eigen/Dense>

#include "hersey/core/spatial.h"
#include "hersey/solver/condensed.h"

namespace hersey::mbd {

/// Motion on which a force between two frames depends: that of frame B relative to frame A, in A, and the deformation
/// of the bodies if the force depends on it.
struct RelativeMotion {
  double t = 0;                      ///< time [s]
  double dt = 0;                     ///< length of the step being solved [s]; 0: steady or instantaneous
  Pose X_AB;                         ///< pose of B in A
  Vector6 V_AB_A = Vector6::Zero();  ///< velocity of B relative to A at A's origin, in A's axes, [omega; v]
  /// Rate of V_AB_A as an observer on A sees it, in A's axes (theory manual eq. (mechanisms.29)).
  Vector6 A_AB_A = Vector6::Zero();
  Eigen::VectorXd s, s_rate;  ///< amplitudes of the shapes of A's elastic body, then of B's, and their rates
};

/// The wrench the force puts on B, at A's origin and in A's axes; on A acts its negative at the same point.
/// Derivatives are with respect to a twist xi_A that moves B relative to A, dX_AB = xi^ X_AB at fixed V_AB_A and
/// A_AB_A, to V_AB_A and to A_AB_A. A force that depends on amplitudes s of shapes also exerts generalised forces Q on
/// them: its power is W . V_AB_A + Q . s_rate (theory manual eq. (flexible-bodies.25)).
struct ForceResponse {
  Vector6 W_B_A = Vector6::Zero();  ///< [tau; f] [N m; N]
  Matrix6 dW_dX = Matrix6::Zero();
  Matrix6 dW_dV = Matrix6::Zero();
  /// Negative added inertia [kg; kg m; kg m^2], of which the wrench is an affine function; always computed.
  Matrix6 dW_dA = Matrix6::Zero();

  /// Sum of the magnitudes of the forces whose resultant is the wrench; it scales the round-off of the wrench [N]; 0 if
  /// the wrench is no such resultant.
  double summed = 0;
  double arm = 0;  ///< length of their arms about the origin of frame A, around which they act [m]

  Eigen::VectorXd Q;                                      ///< shape (amplitudes) [N m; N]
  Eigen::Matrix<double, 6, Eigen::Dynamic> dW_ds, dW_dr;  ///< derivatives by amplitudes and by their rates
  Eigen::Matrix<double, Eigen::Dynamic, 6> dQ_dX, dQ_dV;
  Eigen::MatrixXd dQ_ds, dQ_dr;

  /// Sets all entries to zero, for `amplitudes` amplitudes.
  void set_zero(Eigen::Index amplitudes);
};

/// A force that two bodies exert on each other and that depends on their relative motion alone: spring, bushing, film.
/// Action equals reaction, moment included, by construction. It may keep unknowns of its own and condense them.
class TwoBodyForce : public solver::Condensed<RelativeMotion> {
 public:
  /// Computes the wrench and, if `want_tangent`, its derivatives, condensed unknowns included.
  virtual void evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) = 0;

  /// True if an evaluation is long enough for a thread of its own.
  [[nodiscard]] virtual bool is_costly() const { return false; }

  /// True if `evaluate` computes the derivatives of the wrench; a partitioned coupling does not.
  [[nodiscard]] virtual bool has_tangent() const { return true; }

  /// Returns the stored energy [J]; 0 if the force stores none.
  [[nodiscard]] virtual double stored_energy(const RelativeMotion&) const { return 0; }

  /// Returns the kinetic energy of what the force moves along with the bodies [J], as the oil of a damper's film; 0 if
  /// it has no inertia. The wrench contains the inertia forces.
  [[nodiscard]] virtual double kinetic_energy(const RelativeMotion&) const { return 0; }

  /// Returns the power taken from the bodies that does not increase `stored_energy`, in general the dissipated power
  /// [W]. It is not computed from the wrench, because the energy balance compares both. 0 for forces that report their
  /// losses separately (films, contacts).
  [[nodiscard]] virtual double lost_power(const RelativeMotion&) const { return 0; }
};

}  // namespace hersey::mbd
