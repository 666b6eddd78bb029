#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <string>

#include "hersey/solver/alpha_parameters.h"
#include "hersey/solver/condensed.h"

namespace hersey::solver {

/// State of a mechanical system at one instant.
struct State {
  double t = 0;            ///< time [s]
  Eigen::VectorXd q;       ///< configuration, shape (nq); an orientation is a unit quaternion (w, x, y, z)
  Eigen::VectorXd v;       ///< velocities, shape (nv); an angular velocity for an orientation
  Eigen::VectorXd vdot;    ///< accelerations, shape (nv)
  Eigen::VectorXd lambda;  ///< Lagrange multipliers, shape (nlambda)
};

/// Change of the state by one Newton increment dx of positions: position by k dx, velocity by c dx, acceleration by m
/// dx. The tangent asked for is  J = k K T + c C + m M,  bordered by the constraint Jacobian.
struct Stage {
  double dt = 0;            ///< length of the step being solved [s]; 0 asks for a steady or instantaneous evaluation
  double k = 1;             ///< d position / dx
  double c = 0;             ///< d velocity / dx
  double m = 0;             ///< d acceleration / dx
  Eigen::VectorXd dq = {};  ///< increment of position since the step's start, shape (nv) or empty: K acts on T(dq) dx
  AlphaParameters parameters{};  ///< parameters of the step being solved
  bool fresh = false;            ///< no step has been accepted since the last reset of the history
  /// True: inertia forces and all forces of elastic bodies are evaluated at the velocities given to begin_step and do
  /// not depend on c; only forces between bodies contribute damping (theory manual eq. (integrator.8)).
  bool holds_inertia = false;
};

/// Equations of motion with constraints,
///
///     r(q, v, vdot, lambda, t) = M(q) vdot + h(q, v, t) + G(q)^T lambda = 0,      Phi(q, t) = 0,
/// the interface used by the integrator, the initial assembly and the linearisation (theory manual eq. (integrator.1)).
/// Positions are elements of a manifold, nq >= nv, and `retract` moves along it. Contributors may condense unknowns of
/// their own.
class Equations : public Condensed<State> {
 public:
  using Index = Eigen::Index;
  using SparseMatrix = Eigen::SparseMatrix<double>;  ///< compressed columns; its pattern never changes

  /// Returns the number of entries of q.
  [[nodiscard]] virtual Index nq() const = 0;
  /// Returns the number of velocity components, nv <= nq.
  [[nodiscard]] virtual Index nv() const = 0;
  /// Returns the number of constraints; each has one multiplier.
  [[nodiscard]] virtual Index nlambda() const = 0;

  /// Computes q = q0 (+) dq: a sum for plain coordinates, q0 exp(dq) for an orientation.
  virtual void retract(const Eigen::VectorXd& q0, const Eigen::VectorXd& dq, Eigen::VectorXd& q) const = 0;

  /// Computes the rate of the increment dq of q0 (+) dq where the velocity is v, T(dq) rate = v with T the derivative
  /// of the retraction, for methods that integrate increments: v for plain coordinates.
  virtual void increment_rate(const Eigen::VectorXd& dq, const Eigen::VectorXd& v, Eigen::VectorXd& rate) const {
    (void)dq;
    rate = v;
  }

  /// Computes the residual r, shape (nv + nlambda), the magnitude of the terms that each row balances (`scale`, same
  /// shape, for relative norms), and, unless `tangent` is null, the tangent of the residual with respect to [dx;
  /// lambda].
  virtual void assemble(const State& state, const Stage& stage, Eigen::VectorXd& residual, Eigen::VectorXd& scale,
                        SparseMatrix* tangent) = 0;

  /// Computes Phi(q, t), shape (nlambda), the length with which each row is compared (`scale`), and, unless null, G = d
  /// Phi / d velocity direction, shape (nlambda, nv). Uses neither velocities nor condensed unknowns.
  virtual void constraints(const State& state, Eigen::VectorXd& phi, Eigen::VectorXd& scale,
                           SparseMatrix* jacobian) = 0;

  /// Computes the constraint velocity G v + Phi_t and the bias gamma with G vdot + gamma = d2 Phi/dt2.
  virtual void constraint_rates(const State& state, Eigen::VectorXd& velocity, Eigen::VectorXd& bias) = 0;

  /// Returns the scale of a change of each position, shape (nv): 1 [rad] for an angle, the system's size for a length.
  [[nodiscard]] virtual Eigen::VectorXd position_scales() const { return Eigen::VectorXd::Ones(nv()); }

  /// Returns the name of row `row` of the residual for messages, e.g. "joint main, rotation".
  [[nodiscard]] virtual std::string name_of_row(Index row) const = 0;

  /// True if the tangent contains all forces; a partitioned coupling omits some of them and iterates.
  [[nodiscard]] virtual bool has_whole_tangent() const { return true; }
};

}  // namespace hersey::solver
