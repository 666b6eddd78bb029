#pragma once

#include <Eigen/Dense>
#include <memory>
#include <span>
#include <string>

#include "hersey/core/archive.h"
#include "hersey/core/spatial.h"
#include "hersey/film/film_domain.h"
#include "hersey/film/film_model.h"
#include "hersey/film/film_observables.h"
#include "hersey/film/film_response.h"

namespace hersey::film {

/// How the linear systems of a film are solved: by a sparse factorisation, or by GMRES with multigrid, whose cost grows
/// with the number of nodes only. Where the latter does not arrive, the former takes over.
enum class LinearSolver { direct, multigrid };

/// What the linear solver has done since a film was made.
struct LinearSolverCounts {
  int factorisations = 0;   ///< of the Jacobian
  int setups = 0;           ///< of multigrid
  int iterations = 0;       ///< of GMRES, over all right-hand sides
  int fallback_solves = 0;  ///< right-hand sides that multigrid left to the direct solver
};

/// Reynolds' equation on the grid with its derivatives (theory manual, chapter film): residual and Jacobian at a state,
/// the film's wrench and the answer of both to any change of the surfaces.
///
/// One unknown u [Pa] per node: p = p_cav + max(u, 0) and, in `mass_conserving`, theta = 1 + min(u, 0)/P0. In
/// `guembel`, p = p_cav + u in the equation and p = p_cav + max(u, 0) in the forces. In `reynolds`, u < 0 carries the
/// slack of the complementarity. On an edge at p_cav in `mass_conserving`, u > 0 stands for the oil that leaves there
/// and p = p_cav: take pressures from film_fields(), not from u.
///
/// Holds the sparse pattern, factor and scratch of one film: one object per film and thread, no allocation after the
/// first call.
class Reynolds {
 public:
  /// The film of `model`. @throws ContractError for a model that describes none: no size, no viscosity, edges below
  /// p_cav
  explicit Reynolds(const FilmModel& model, LinearSolver linear = LinearSolver::direct);
  ~Reynolds();
  Reynolds(Reynolds&&) noexcept;
  Reynolds& operator=(Reynolds&&) noexcept;

  /// As given.
  [[nodiscard]] const FilmModel& model() const;
  /// Nodes, n.
  [[nodiscard]] int size() const;
  /// As asked for.
  [[nodiscard]] LinearSolver linear_solver() const;
  /// Of all solutions so far.
  [[nodiscard]] const LinearSolverCounts& counts() const;

  /// Linearises about `u`. After it the members below refer to this state; the first of them that needs the factorised
  /// Jacobian factorises it. Where the Jacobian is singular (nothing fixes the fill level) a shift far below its
  /// entries picks an answer near `u`. Says where `u` and the surfaces lie outside the domain, and is then without a
  /// linearisation.
  /// @throws ContractError on a wrong shape.
  FilmDomain linearise(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u);

  [[nodiscard]] const Eigen::VectorXd& residual() const;  ///< [m^3/s], shape (n)
  [[nodiscard]] double relative_residual() const;         ///< max |residual| / largest throughput of a control volume
  [[nodiscard]] int worst_node() const;

  /// Wrench of the film (pressure, shear, asperities) on the shell at the grid frame's origin; on the journal acts its
  /// negative at the same point: action equals reaction, moment included.
  [[nodiscard]] const Vector6& wrench_on_shell() const;

  /// observe_film() of the state last linearised, nothing evaluated again: `motion` and `u` are those of linearise().
  [[nodiscard]] FilmObservables observe(const SurfaceMotion& motion, const Eigen::Vector2d& e, const Eigen::VectorXd& u,
                                        const Eigen::Vector2d& tilt) const;

  /// du = -J^{-1} residual, the Newton increment of the film at fixed surfaces. `multigrid` leaves `rtol` of the
  /// residual.
  void newton_increment(Eigen::VectorXd& du, double rtol = 1e-10);

  /// Likewise with a thousandth of each row's largest entry added to the Jacobian's diagonal: a bounded step where the
  /// Jacobian is all but singular and its own increment runs away.
  void regularised_increment(Eigen::VectorXd& du);

  /// A step of the chord method: du = -J^{-1} residual(u) with the factor that the last linearisation has. Residual and
  /// wrench are then those at `u`, all derivatives still those of that linearisation. Says where `u` lies outside the
  /// domain, and is then without a linearisation. @pre has_factor()
  FilmDomain chord_increment(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u,
                             Eigen::VectorXd& du);
  /// Whether the last linearisation has been factorised.
  [[nodiscard]] bool has_factor() const;

  /// Empties the nodes downstream of those that the step to `u` from the last linearisation has emptied, as far as they
  /// live on their oil: fronts then follow in one iteration instead of one per node.
  void advance_rupture_front(Eigen::VectorXd& u) const;
  /// Of nodes that a Newton step `du` from the last linearisation fills, steps to a pressure in place of what is too
  /// much of the oil that was missing (film.31).
  void press_filled_nodes(const Eigen::VectorXd& u, Eigen::VectorXd& du) const;

  /// Answer to a change of the surfaces (film.39): `du` = -J^{-1} dr/d(parameter), and the wrench's *partial*
  /// derivative at fixed u. The total derivative is  partial + wrench_gradient(du).
  void response(const MotionDirection& direction, Eigen::VectorXd& du, Vector6& wrench_partial);

  /// Likewise for several changes at once, a column each: one solve with many right-hand sides.
  void responses(std::span<const MotionDirection> directions, Eigen::MatrixXd& du,
                 Eigen::Matrix<double, 6, Eigen::Dynamic>& wrench_partial);

  /// Static condensation of the film: the wrench after its Newton increment at fixed surfaces, and the wrench's total
  /// derivative along each direction (theory manual, bearing.10). `direct` solves the transposed system, once per entry
  /// of the wrench (bearing.11); `multigrid` once per direction.
  ///
  /// Surfaces that deform bring the shapes by which they open the gap, `openings` (n, shapes) for unit amplitudes: the
  /// film puts the force Q = openings^T normal_forces() on them (theory manual, bearing.14 and bearing.15). (n, 0): no
  /// shapes.
  void condense(std::span<const MotionDirection> directions, const Eigen::MatrixXd& openings, CondensedFilm& film);

  /// At the state last linearised.
  [[nodiscard]] const NormalForces& normal_forces() const;

  /// The film's part `du` of a Newton step in which the bodies have moved by `ds` along the directions last condensed
  /// (theory manual, bearing.9). Comes after `condense` and before the next `linearise` inside the domain: a trial
  /// outside leaves what it takes.
  void follow(const Eigen::Ref<const Eigen::VectorXd>& ds, Eigen::VectorXd& du);

  /// (d wrench_on_shell / du) du.
  [[nodiscard]] Vector6 wrench_gradient(const Eigen::Ref<const Eigen::VectorXd>& du) const;
  /// d wrench_on_shell / du, shape (6, n).
  [[nodiscard]] const Eigen::Matrix<double, 6, Eigen::Dynamic>& wrench_by_u() const;

  /// The residual's derivative along a change of the surfaces at fixed u [m^3/s], shape (n), and the wrench's.
  void partial(const MotionDirection& direction, Eigen::VectorXd& residual, Vector6& wrench);
  /// J v at the state last linearised, shape (n).
  [[nodiscard]] Eigen::VectorXd jacobian_product(const Eigen::Ref<const Eigen::VectorXd>& v) const;
  /// J^{-1} of each column, in its place. `direct` only.
  void solve(Eigen::MatrixXd& columns);
  /// J^{-T} of each column, in its place. `direct` only.
  void solve_transposed(Eigen::MatrixXd& columns);

  /// The oil of a film at `u` with which a run starts: no step has led there; flows are undefined.
  void initialise_oil_balance(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u,
                              StepOilBalance& oil);

  /// Closes a step of history.dt > 0 that has ended at `u`: forces belong to its end, where the gap opens at its exact
  /// rate; flows are to bring what the gap has gained over the whole step. Their difference is led through the film
  /// along the last linearisation. linearise() comes next.
  void settle(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u, StepOilBalance& oil);

  /// The pivot order in use; linearise() comes next.
  void persist(Archive& archive);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey::film
