#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <string>

#include "hersey/core/archive.h"
#include "hersey/solver/alpha_parameters.h"

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
};

/// Equations of motion with constraints,
///
///     r(q, v, vdot, lambda, t) = M(q) vdot + h(q, v, t) + G(q)^T lambda = 0,      Phi(q, t) = 0,
///
/// as the integrator, the initial assembly and the linearisation see them (theory manual eq. (integrator.1)). Positions
/// live on a manifold: nq >= nv, and `retract` walks on it. A contributor may keep unknowns of its own (a film) and
/// condense them exactly; then it owns their history between `begin_step` and `accept_step` and says through
/// `internal_residual` how well they are solved.
class Equations {
 public:
  using Index = Eigen::Index;
  using SparseMatrix = Eigen::SparseMatrix<double>;  ///< compressed columns; its pattern never changes

  virtual ~Equations() = default;

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

  /// A step from `start` over `dt` begins (again): condensed unknowns return to their state at `start`.
  virtual void begin_step(const State& start, double dt) = 0;

  /// Whether the step may end where `assemble` was called last and Newton's method found it solved. False: what belongs
  /// to the whole of the step changes the equations (a film whose oil the step's end does not account for), and they
  /// are to be solved once more from there; asked again afterwards.
  [[nodiscard]] virtual bool step_stands() { return true; }

  /// The step ended in `end`: condensed unknowns keep what they have.
  virtual void accept_step(const State& end) = 0;

  /// Whether there are condensed unknowns: each `assemble` moves them on, and the tangent is that of the place they
  /// have reached.
  [[nodiscard]] virtual bool has_condensed_unknowns() const { return false; }

  /// Largest relative residual among condensed unknowns at the last `assemble`; 0 where there are none.
  [[nodiscard]] virtual double internal_residual() const { return 0; }

  /// Name of the condensed equation behind `internal_residual`.
  [[nodiscard]] virtual std::string name_of_internal_residual() const { return {}; }

  /// Whether the tangent is that of all forces: a partitioned coupling leaves some out and iterates on them.
  [[nodiscard]] virtual bool has_whole_tangent() const { return true; }

  /// A state outside the domain of the equations, e.g. "bearing big_end: gap closed (-1.2 um at ...)"; empty if inside.
  /// The integrator asks after each `assemble` and shortens the Newton increment where it is not empty.
  [[nodiscard]] virtual std::string domain_error() const { return {}; }

  /// Everything that steps to come depend on beside the state: histories of condensed unknowns, and what is kept from
  /// one solution to the next if it changes their round-off. After restoring, steps are those of the run that saved.
  virtual void persist(Archive& archive) { (void)archive; }
};

}  // namespace hersey::solver
