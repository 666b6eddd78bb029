#pragma once

#include <Eigen/Dense>
#include <memory>
#include <span>
#include <string>

#include "hersey/core/archive.h"
#include "hersey/core/spatial.h"
#include "hersey/film/active_set.h"
#include "hersey/film/film_domain.h"
#include "hersey/film/film_model.h"
#include "hersey/film/film_observables.h"
#include "hersey/film/film_response.h"
#include "hersey/film/film_work.h"
#include "hersey/film/surface_shapes.h"

namespace hersey::film {

/// How the linear systems of a film are solved: by a sparse factorisation, or by GMRES with multigrid, whose cost grows
/// with the number of nodes only. Where the latter does not arrive, the former takes over.
enum class LinearSolver { direct, multigrid };

/// The linear solver of a film, and what it has done since the film was made.
struct LinearSolverState {
  LinearSolver kind = LinearSolver::direct;  ///< as asked for
  bool has_factor = false;                   ///< of the Jacobian last linearised
  int factorisations = 0;                    ///< of the Jacobian
  int setups = 0;                            ///< of multigrid
  int iterations = 0;                        ///< of GMRES, over all right-hand sides
  int fallback_solves = 0;                   ///< right-hand sides that multigrid left to the direct solver
};

/// Of which matrix a system is: the film's Jacobian J, or its transposed.
enum class SystemMatrix { jacobian, transposed };

/// How Newton's increment of a film is found.
struct IncrementOptions {
  double rtol = 1e-10;  ///< what `multigrid` leaves of the residual
  /// A thousandth of each row's largest entry is added to the Jacobian's diagonal: a bounded step where the Jacobian is
  /// all but singular and its own increment runs away. Always by factorisation.
  bool is_regularised = false;
};

/// Whether a condensation includes the flows through the film's ports, for a right-hand side more per feature.
enum class PortFlows { left_out, included };

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

  /// The film's constant data, as given.
  [[nodiscard]] const FilmModel& model() const;
  /// Which linear solver this film has, whether it has a factor for chord_increment(), and what it has done so far.
  [[nodiscard]] LinearSolverState linear_solver() const;
  /// What the film has cost since it was made.
  [[nodiscard]] FilmWork work() const;

  /// Linearises about `u`: every iteration begins with it. After it the members below refer to this state; the first of
  /// them that needs the factorised Jacobian factorises it. Where the Jacobian is singular (nothing fixes the fill
  /// level) a shift far below its entries picks an answer near `u`. Says where `u` and the surfaces lie outside the
  /// domain, and is then without a linearisation.
  /// @throws ContractError on a wrong shape.
  FilmDomain linearise(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u);

  /// How far the state is from a film, node by node and as one number: what Newton's method ends by.
  [[nodiscard]] FilmResidual residual() const;
  /// Wrench and normal forces of the film with their derivatives by u. After changes of u and of the surfaces for which
  /// respond() has the answers, the wrench changes by wrench_by_u * du and the partial derivative.
  [[nodiscard]] FilmForces forces() const;

  /// observe_film() of the state last linearised or settled, for the cost of sums alone, since nothing is evaluated
  /// again: `motion` and `u` are those of linearise() or settle().
  [[nodiscard]] FilmObservables observe(const SurfaceMotion& motion, const Eigen::Vector2d& e, const Eigen::VectorXd& u,
                                        const Eigen::Vector2d& tilt) const;
  /// film_fields() of that state, as cheaply.
  [[nodiscard]] FilmFields fields() const;

  /// du = -J^{-1} residual, the Newton increment of the film at fixed surfaces: to solve a film by itself. Where the
  /// surfaces move with bodies, condense() and follow() take their place.
  void newton_increment(Eigen::VectorXd& du, const IncrementOptions& options = {});

  /// A step of the chord method: du = -J^{-1} residual(u) with the factor that the last linearisation has. It saves the
  /// factorisation where little has changed since. Residual and wrench are then those at `u`, all derivatives still
  /// those of that linearisation. Says where `u` lies outside the
  /// domain, and is then without a linearisation. @pre linear_solver().has_factor
  FilmDomain chord_increment(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u,
                             Eigen::VectorXd& du);
  /// What a Newton step from the last linearisation needs where it fills or empties nodes. Valid until the next one.
  [[nodiscard]] ActiveSet active_set() const;

  /// Static condensation of the film, where bodies move its surfaces: the wrench after its Newton increment at fixed
  /// surfaces, and the wrench's total derivative along each direction (theory manual, bearing.10). `direct` solves the
  /// transposed system, once per entry of the wrench (bearing.11); `multigrid` once per direction.
  ///
  /// Surfaces that deform bring their shapes, rigid ones SurfaceShapes::none(): the film puts the force Q = openings^T
  /// forces().normal on them (theory manual, bearing.14 and bearing.15). Their amplitudes and then the rates of these
  /// are parameters as well. They come behind the directions, but before those of ports, which have to be the last.
  ///
  /// The pressures of its ports are directions as well (MotionDirection::port_pressure), and the flows through them
  /// outputs: with these a circuit of oil is solved together with the film. Flows are those at the end of a step, from
  /// which those of settle(), means over it, differ by what the gap's exact rate leaves.
  void condense(std::span<const MotionDirection> directions, const SurfaceShapes& shapes, CondensedFilm& film,
                PortFlows flows = PortFlows::left_out);

  /// The film's part `du` of a Newton step in which the bodies have moved by `ds` along the parameters last condensed
  /// (theory manual, bearing.9). Comes after `condense` and before the next `linearise` inside the domain: a trial
  /// outside leaves what it takes. Shapes that have turned since change it by the second order.
  void follow(const Eigen::Ref<const Eigen::VectorXd>& ds, const SurfaceShapes& shapes, Eigen::VectorXd& du);

  /// Derivatives along each change of the surfaces at fixed u, a column each: of the residual [m^3/s], shape (n,
  /// directions), and of the wrench. What respond() needs; by themselves for adjoints.
  void partials(std::span<const MotionDirection> directions, Eigen::MatrixXd& residual,
                Eigen::Matrix<double, 6, Eigen::Dynamic>& wrench);
  /// J v at the state last linearised, shape (n): what a change of u does to the residual.
  [[nodiscard]] Eigen::VectorXd jacobian_product(const Eigen::Ref<const Eigen::VectorXd>& v) const;
  /// Replaces each column by the solution of J x = column: the film's answer to a change of its residual that no motion
  /// of the surfaces makes; or of J^T x = column, the adjoint of a force, by `direct` only.
  /// @param rtol  what `multigrid` leaves of each column
  void solve(Eigen::MatrixXd& columns, SystemMatrix matrix = SystemMatrix::jacobian, double rtol = 1e-10);

  /// Closes a step of history.dt > 0 that has ended at `u`: forces belong to its end, where the gap opens at its exact
  /// rate; flows are to bring what the gap has gained over the whole step. Their difference is led through the film
  /// along the last linearisation. linearise() comes next. A run begins with oil_at_start() instead.
  void settle(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u, StepOilBalance& oil);
  /// The same of a step that has ended at the state last linearised or tried on its factor, without evaluating it
  /// again.
  void settle(StepOilBalance& oil);

  /// Change of the film's unknowns with accelerations of its surfaces by the inertia of the oil to first order
  /// (damper.6), a column each [Pa s^2/m for accelerations in m/s^2].
  /// @param du_by_rate  what respond() says of the rates whose changes these accelerations are
  /// @param momentum_factor  6/5 of a parabolic velocity profile, 1 of a uniform one (damper.7)
  [[nodiscard]] Eigen::MatrixXd inertia(const Eigen::MatrixXd& du_by_rate, double momentum_factor);

  /// The pivot order in use; linearise() comes next.
  void persist(Archive& archive);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Answers of the film last linearised to changes of the surfaces (film.39), a column each: `du` = -J^{-1}
/// dr/d(parameter), and the wrench's *partial* derivative at fixed u. The total derivative is
/// wrench_partial + forces().wrench_by_u * du. For coefficients and searches, which need the film's own change; where
/// only forces are needed, condense() has them for less.
/// @param rtol  what `multigrid` leaves of the right-hand sides
void respond(Reynolds& film, std::span<const MotionDirection> directions, Eigen::MatrixXd& du,
             Eigen::Matrix<double, 6, Eigen::Dynamic>& wrench_partial, double rtol = 1e-10);

}  // namespace hersey::film
