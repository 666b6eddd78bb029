#pragma once

#include <Eigen/Dense>

#include "hersey/core/spatial.h"
#include "hersey/solver/condensed.h"

namespace hersey::mbd {

/// What a force between two frames sees: frame B relative to frame A, in A; and how the bodies deform, where it sees
/// that.
struct RelativeMotion {
  double t = 0;                      ///< time [s]
  double dt = 0;                     ///< length of the step being solved [s]; 0: steady or instantaneous
  Pose X_AB;                         ///< pose of B in A
  Vector6 V_AB_A = Vector6::Zero();  ///< velocity of B relative to A at A's origin, in A's axes, [omega; v]
  Eigen::VectorXd s, s_rate;         ///< amplitudes of the shapes of A's elastic body, then of B's, and their rates
};

/// The wrench the force puts on B, at A's origin and in A's axes; on A acts its negative at the same point.
/// Derivatives are with respect to a twist xi_A that moves B relative to A, dX_AB = xi^ X_AB at fixed V_AB_A, and to
/// V_AB_A. A force that sees amplitudes s of shapes puts generalised forces Q on them, beside the wrench: it does the
/// power W . V_AB_A + Q . s_rate (theory manual eq. (flexible-bodies.25)).
struct ForceResponse {
  Vector6 W_B_A = Vector6::Zero();  ///< [tau; f] [N m; N]
  Matrix6 dW_dX = Matrix6::Zero();
  Matrix6 dW_dV = Matrix6::Zero();

  /// Sum of the magnitudes of the forces that the wrench is the rest of, whose round-off it has [N]; 0: it is no rest.
  double summed = 0;

  Eigen::VectorXd Q;                                      ///< shape (amplitudes) [N m; N]
  Eigen::Matrix<double, 6, Eigen::Dynamic> dW_ds, dW_dr;  ///< by amplitudes and by their rates
  Eigen::Matrix<double, Eigen::Dynamic, 6> dQ_dX, dQ_dV;
  Eigen::MatrixXd dQ_ds, dQ_dr;

  /// All zero, for `amplitudes` of them.
  void set_zero(Eigen::Index amplitudes);
};

/// A force that two bodies exert on each other and that depends on their relative motion alone: spring, bushing, film.
/// Action equals reaction, moment included, by construction. It may keep unknowns of its own and condense them.
class TwoBodyForce : public solver::Condensed<RelativeMotion> {
 public:
  /// The wrench and, if `want_tangent`, its derivatives, condensed unknowns included.
  virtual void evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) = 0;

  /// Whether an evaluation takes long enough to have a thread of its own.
  [[nodiscard]] virtual bool is_costly() const { return false; }

  /// Whether `evaluate` gives the derivatives of what it returns; a partitioned coupling does not.
  [[nodiscard]] virtual bool has_tangent() const { return true; }

  /// Energy stored [J]; 0 where the force stores none.
  [[nodiscard]] virtual double stored_energy(const RelativeMotion&) const { return 0; }

  /// Power taken from the bodies that `stored_energy` does not hold: dissipated, as a rule [W]. Not from the wrench:
  /// the balance of energy compares both. 0 for a force that shows its losses itself (films, contacts).
  [[nodiscard]] virtual double lost_power(const RelativeMotion&) const { return 0; }
};

}  // namespace hersey::mbd
