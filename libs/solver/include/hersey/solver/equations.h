#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <string>

#include "hersey/solver/alpha_parameters.h"
#include "hersey/solver/condensed.h"

namespace hersey::solver {

/// A mechanical system at one instant.
struct State {
  double t = 0;            ///< time [s]
  Eigen::VectorXd q;       ///< configuration, shape (nq); an orientation is a unit quaternion (w, x, y, z)
  Eigen::VectorXd v;       ///< velocities, shape (nv); an angular velocity for an orientation
  Eigen::VectorXd vdot;    ///< accelerations, shape (nv)
  Eigen::VectorXd lambda;  ///< Lagrange multipliers, shape (nlambda)
};

/// How one Newton increment dx of positions moves the state: position by k dx, velocity by c dx, acceleration by m dx.
/// The tangent asked for is  J = k K T + c C + m M,  bordered by the constraint Jacobian.
struct Stage {
  double dt = 0;            ///< length of the step being solved [s]; 0 asks for a steady or instantaneous evaluation
  double k = 1;             ///< d position / dx
  double c = 0;             ///< d velocity / dx
  double m = 0;             ///< d acceleration / dx
  Eigen::VectorXd dq = {};  ///< increment of position since the step's start, shape (nv) or empty: K acts on T(dq) dx
  AlphaParameters parameters{};  ///< of the step being solved
  bool fresh = false;            ///< no step was accepted since the motion started afresh
  /// Inertia forces, and all that elastic bodies need, are those of the velocities given to begin_step, and c moves
  /// them not: forces between bodies damp alone (theory manual eq. (integrator.8)).
  bool holds_inertia = false;
};

/// Equations of motion with constraints,
///
///     r(q, v, vdot, lambda, t) = M(q) vdot + h(q, v, t) + G(q)^T lambda = 0,      Phi(q, t) = 0,
///
/// as the integrator, the initial assembly and the linearisation see them (theory manual eq. (integrator.1)). Positions
/// live on a manifold: nq >= nv, and `retract` walks on it. What contributes to them may have unknowns of
/// its own, which it condenses.
class Equations : public Condensed<State> {
 public:
  using Index = Eigen::Index;
  using SparseMatrix = Eigen::SparseMatrix<double>;  ///< compressed columns; its pattern never changes

  /// Entries of q.
  [[nodiscard]] virtual Index nq() const = 0;
  /// Velocity components, nv <= nq.
  [[nodiscard]] virtual Index nv() const = 0;
  /// Constraints, one multiplier each.
  [[nodiscard]] virtual Index nlambda() const = 0;

  /// q = q0 (+) dq; for plain coordinates a sum, for an orientation q0 exp(dq).
  virtual void retract(const Eigen::VectorXd& q0, const Eigen::VectorXd& dq, Eigen::VectorXd& q) const = 0;

  /// Residual r, shape (nv + nlambda), the magnitude of the terms each row balances (`scale`, same shape, for relative
  /// norms), and the tangent of that residual with respect to [dx; lambda] unless `tangent` is null.
  virtual void assemble(const State& state, const Stage& stage, Eigen::VectorXd& residual, Eigen::VectorXd& scale,
                        SparseMatrix* tangent) = 0;

  /// Phi(q, t), shape (nlambda), the lengths each row compares (`scale`), and unless null G = d Phi / d velocity
  /// direction, shape (nlambda, nv). Needs neither velocities nor condensed unknowns.
  virtual void constraints(const State& state, Eigen::VectorXd& phi, Eigen::VectorXd& scale,
                           SparseMatrix* jacobian) = 0;

  /// Constraint velocity and acceleration terms:  G v + Phi_t  and  the bias gamma with  G vdot + gamma = d2 Phi/dt2.
  virtual void constraint_rates(const State& state, Eigen::VectorXd& velocity, Eigen::VectorXd& bias) = 0;

  /// What a change of each position is compared with, shape (nv): 1 [rad] for an angle, the system's size for a length.
  [[nodiscard]] virtual Eigen::VectorXd position_scales() const { return Eigen::VectorXd::Ones(nv()); }

  /// What row `row` of the residual balances, e.g. "joint main, rotation"; for messages.
  [[nodiscard]] virtual std::string name_of_row(Index row) const = 0;

  /// Whether the tangent is that of all forces: a partitioned coupling leaves some out and iterates on them.
  [[nodiscard]] virtual bool has_whole_tangent() const { return true; }
};

}  // namespace hersey::solver
