#include "steady/steady_film.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hersey/bearing/bearing_kind.h"
#include "hersey/bearing/clearance.h"
#include "hersey/core/contract.h"
#include "hersey/film/observables.h"

namespace hersey::bearing {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// One Newton step may thin the film at a node to this fraction of itself, an elastic one may thicken it by this factor.
constexpr double kThinnest = 0.3, kThickest = 5;

// Step lengths below this count as none.
constexpr double kSmallestStepLength = 1e-6;

// Iterations on film and deformation together without getting nearer by half, after which they are solved alternately,
// and iterations of either at most.
constexpr int kFilmPatience = 8, kMostIterations = 40;

// What multigrid leaves of the right-hand sides of a step towards the load. Newton's method gains as much in each
// iteration, and gets by with as few of them as with exact steps; with 1e-4 it takes one more.
constexpr double kStepTolerance = 1e-6;

// What it leaves of those of coefficients, which then differ from a factor's in the seventh digit; grids err in the
// fourth.
constexpr double kCoefficientTolerance = 1e-7;

// Residual of a film from which on it is found anew at the deformation of the step.
constexpr double kFarFilm = 0.1;

std::shared_ptr<const ElasticSurface> surface_of(const std::shared_ptr<const SurfaceFlexibility>& flexibility) {
  return flexibility ? flexibility->surface : nullptr;
}

/// A wrench expressed in axes from which its own are turned by `angle` about z.
Matrix6 about_z(double angle) {
  Matrix6 R = Matrix6::Zero();
  R.topLeftCorner<3, 3>() = R.bottomRightCorner<3, 3>() = Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix();
  return R;
}

/// d about_z(angle) / d angle at 0, times W.
Vector6 turning(const Vector6& W) {
  Vector6 change;
  change << Vector3::UnitZ().cross(W.head<3>()), Vector3::UnitZ().cross(W.tail<3>());
  return change;
}

/// Slopes of an axis that rotations turn.
Eigen::MatrixXd slopes(const Eigen::MatrixXd& turn) {
  Eigen::MatrixXd t(2, turn.cols());
  t << turn.row(1), -turn.row(0);
  return t;
}

film::LinearSolver linear_solver(const SteadyOptions& options) {
  // Every amplitude is a right-hand side: a factor answers all of them at once.
  const bool is_elastic = options.elasticity && (options.elasticity->shell || options.elasticity->journal);
  return is_elastic ? film::LinearSolver::direct : film::linear_solver_of(options.solver);
}

}  // namespace

SteadyFilm::SteadyFilm(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options)
    : model_(model),
      point_(point),
      coordinates_((options.kind ? options.kind : journal_kind())->steady_coordinates(model)),
      deforming_(model, options.elasticity ? surface_of(options.elasticity->shell) : nullptr,
                 options.elasticity ? surface_of(options.elasticity->journal) : nullptr),
      reynolds_(model, linear_solver(options)) {
  film_options_.rtol = options.rtol;
  film_options_.solver = deforms() ? film::FilmSolver::newton : options.solver;
  if (deforms()) gather_flexibility(*options.elasticity);
}

/// Both bodies side by side: one's film forces move the other through the film alone.
void SteadyFilm::gather_flexibility(const SteadyElasticity& elasticity) {
  HERSEY_REQUIRE(point_.shell_speed == 0 || !elasticity.shell, "a shell that turns does not deform");
  HERSEY_REQUIRE(point_.e_rate.isZero(0), "a journal at rest between surfaces that deform");
  C_ = MatrixXd::Zero(amplitudes(), amplitudes());
  C_W_ = MatrixXd::Zero(amplitudes(), 6);
  s_0_ = VectorXd::Zero(amplitudes());
  tilt_by_s_ = MatrixXd::Zero(2, amplitudes());
  offset_by_s_ = MatrixXd::Zero(3, amplitudes());
  by_offset_moment_ = MatrixXd::Zero(amplitudes(), 3);
  turn_by_s_ = turn_in_body_by_s_ = Eigen::RowVectorXd::Zero(amplitudes());
  Index first = 0;
  if (elasticity.shell) {
    const SurfaceFlexibility& shell = *elasticity.shell;
    first = shell.by_forces.rows();
    C_.topLeftCorner(first, first) = shell.by_forces;
    C_W_.topRows(first) = shell.by_wrench;
    tilt_by_s_.leftCols(first) = -slopes(shell.turn);
    offset_by_s_.leftCols(first) = shell.offset;
    by_offset_moment_.topRows(first) = shell.by_offset_moment;
    turn_by_s_.head(first) = shell.turn.row(2);
    turn_in_body_by_s_.head(first) = shell.turn_in_body.row(2);
  }
  if (elasticity.journal) {
    const SurfaceFlexibility& journal = *elasticity.journal;
    const Index count = journal.by_forces.rows();
    C_.bottomRightCorner(count, count) = journal.by_forces;
    // The journal takes the opposite wrench, expressed in its own axes, which are turned.
    const Matrix6 to_journal = about_z(-point_.journal_angle);
    C_W_.bottomRows(count) = -journal.by_wrench * to_journal;
    tilt_by_s_.rightCols(count) = slopes(to_journal.topLeftCorner<3, 3>().transpose() * journal.turn);
    s_0_.tail(count) = journal.by_spin * point_.journal_speed * point_.journal_speed;
  }
  lay_openings();
}

/// A tilt opens the gap at z by -z t . e_r.
void SteadyFilm::lay_openings() {
  const Index count = coordinates_->count();
  film::SurfaceMotion motion = coordinates_->surfaces(point_, coordinates_->widest());
  deforming_.add_displacements(s_0_, VectorXd::Zero(amplitudes()), {.angle = point_.journal_angle}, motion);
  positions_.assign(static_cast<std::size_t>(amplitudes()), {});
  for (Eigen::Index a = 0; a < amplitudes(); ++a)
    deforming_.shapes().find_along_amplitude(a, positions_[static_cast<std::size_t>(a)]);
  all_openings_ = deforming_.shapes().openings;
  for (const film::MotionDirection& tilt : coordinates_->directions(coordinates_->widest(), count, 2))
    positions_.push_back(tilt);
  for (const Index k : {0, 1})
    all_openings_ += positions_[static_cast<std::size_t>(amplitudes() + k)].g * tilt_by_s_.row(k);
}

film::SurfaceMotion SteadyFilm::rigid_surfaces(const OperatingPoint& point, const Coordinates& e) const {
  film::SurfaceMotion motion = coordinates_->surfaces(point, e);
  shapes_.add_to(motion);
  return motion;
}

double SteadyFilm::undeformed_gap(const Coordinates& e) const {
  return shapes_.empty() ? coordinates_->smallest_gap(point_, e) : rigid_surfaces(point_, e).g.minCoeff();
}

film::SurfaceMotion SteadyFilm::surfaces(const Coordinates& e, const VectorXd& x) {
  if (!deforms()) return rigid_surfaces(point_, e);
  OperatingPoint tilted = point_;
  tilted.tilt = tilt(x);
  film::SurfaceMotion motion = rigid_surfaces(tilted, e);
  // A deformation at rest in the bearing's axes opens the gap at no rate, even where the journal rotates beneath it.
  deforming_.add_displacements(amplitudes_of(x), VectorXd::Zero(amplitudes()), {.angle = point_.journal_angle}, motion);
  return motion;
}

Eigen::Vector2d SteadyFilm::tilt(const VectorXd& x) const {
  return deforms() ? Eigen::Vector2d(point_.tilt + tilt_by_s_ * amplitudes_of(x)) : point_.tilt;
}

double SteadyFilm::turn(const VectorXd& x) const { return deforms() ? turn_by_s_.dot(amplitudes_of(x)) : 0; }

VectorXd SteadyFilm::start() const {
  VectorXd x = VectorXd::Zero(size());
  x.tail(amplitudes()) = s_0_;
  return x;
}

// Where linear systems are too hard for multigrid: what a film bears is no matter of the solver.
film::FilmSolveSummary SteadyFilm::solve_by_factorisation(const film::SurfaceMotion& motion, VectorXd& u) {
  film::Reynolds direct(model_);
  film::FilmSolveOptions options = film_options_;
  options.solver = film::FilmSolver::newton;
  u.setZero();
  return film::solve_film(direct, motion, history_, options, u);
}

film::FilmSolveSummary SteadyFilm::solve_film(const film::SurfaceMotion& motion, VectorXd& u) {
  film::FilmSolveSummary solved = film::solve_film(reynolds_, motion, history_, film_options_, u);
  ends_linearised_ = solved.solved() && !deforms() && film_options_.solver != film::FilmSolver::sor;
  if (solved.solved() || film_options_.solver != film::FilmSolver::multigrid) return solved;
  const int before = solved.iterations;
  solved = solve_by_factorisation(motion, u);
  solved.iterations += before;
  return solved;
}

film::FilmSolveSummary SteadyFilm::solve(const Coordinates& e, VectorXd& x) {
  if (!deforms()) return solve_film(surfaces(e, x), x);
  film::FilmSolveSummary solved;
  const VectorXd start = x;
  if (!x.head(model_.grid.size()).isZero(0)) solved = solve_jointly(e, x);
  if (!solved.solved()) {
    const int before = solved.iterations;
    x = start;
    solved = solve_nested(e, x);
    solved.iterations += before;
  }
  if (!solved.solved()) {
    // No film at one deformation says nothing of others.
    solved.domain = {};
    solved.relative_residual = std::max(1.0, solved.relative_residual);
    return solved;
  }
  // One more solve of the film found reports its state, such as starvation.
  VectorXd u = film_of(x);
  film::FilmSolveSummary checked = solve_film(surfaces(e, x), u);
  checked.iterations += solved.iterations;
  return checked;
}

/// Newton on film and deformation at once.
film::FilmSolveSummary SteadyFilm::solve_jointly(const Coordinates& e, VectorXd& x) {
  film::FilmSolveSummary summary;
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0, idle = 0; k < kMostIterations && idle < kFilmPatience; ++k) {
    const int linearisations = linearise_near(e, x);
    if (linearisations == 0) return summary;
    summary.iterations += linearisations;
    summary.relative_residual = relative_residual();
    summary.set_solved(summary.relative_residual <= film_options_.rtol);
    if (summary.solved()) return summary;
    idle = summary.relative_residual < 0.5 * best ? 0 : idle + 1;
    best = std::min(best, summary.relative_residual);
    x += limit_step(e, x, dx_);
  }
  return summary;
}

/// Newton on the deformation with the film solved at each; a step that does not bring the deformation nearer is halved.
film::FilmSolveSummary SteadyFilm::solve_nested(const Coordinates& e, VectorXd& x) {
  film::FilmSolveSummary summary;
  int iterations = 0;
  const auto film_at = [&](VectorXd& at) {
    VectorXd u = film_of(at);
    summary = solve_film(surfaces(e, at), u);
    iterations += summary.iterations;
    if (!summary.solved()) return false;
    at.head(u.size()) = u;
    summary.domain = linearise(e, at);
    summary.set_solved(false);
    return summary.domain.is_inside();
  };
  const auto finish = [&] {
    summary.iterations = iterations;
    return summary;
  };
  if (!film_at(x)) return finish();
  for (int k = 0; k < kMostIterations; ++k) {
    summary.relative_residual = relative_residual();
    summary.set_solved(summary.relative_residual <= film_options_.rtol);
    if (summary.solved()) return finish();
    const VectorXd from = x, dx = limit_step(e, x, dx_);
    const double missing = r_s_.norm();
    bool nearer = false;
    for (double step_length = 1; !nearer && step_length > 1e-3; step_length /= 2) {
      x = from + step_length * dx;
      nearer = film_at(x) && (r_s_.norm() < missing || relative_residual() <= film_options_.rtol);
    }
    if (!nearer) break;
  }
  summary.message = "film and deformation of the surfaces do not converge";
  return finish();
}

VectorXd SteadyFilm::limit_step(const Coordinates& e, const VectorXd& x, const VectorXd& dx) {
  double step_length = 1;
  while (step_length > kSmallestStepLength && !reuses_film(e, x, e, x + step_length * dx)) step_length *= 0.7;
  return step_length * dx;
}

bool SteadyFilm::reuses_film(const Coordinates& e, const VectorXd& x, const Coordinates& e_next,
                             const VectorXd& x_next) {
  const VectorXd u = film_of(x), u_next = film_of(x_next);
  if (!film::check_unknowns(model_, u_next).is_inside()) return false;
  const VectorXd before = film::film_fields(model_, surfaces(e, x), u).h;
  const VectorXd after = film::film_fields(model_, surfaces(e_next, x_next), u_next).h;
  if (!(after.array() >= kThinnest * before.array()).all()) return false;
  return !may_overlap() || (after.array() <= kThickest * before.array()).all();
}

film::FilmDomain SteadyFilm::linearise(const Coordinates& e, const VectorXd& x) {
  film::FilmDomain domain;
  if (!std::exchange(ends_linearised_, false)) domain = reynolds_.linearise(surfaces(e, x), history_, film_of(x));
  if (!domain.is_inside()) return domain;
  VectorXd du;
  u_by_position_.resize(0, 0);
  if (finds_position_ && !deforms() && reynolds_.linear_solver().kind == film::LinearSolver::multigrid)
    solve_with_position(e, du);
  else
    reynolds_.newton_increment(du, {.rtol = kStepTolerance});
  wrench_ = reynolds_.forces().wrench_on_shell + reynolds_.forces().wrench_by_u * du;
  dx_ = du;
  force_ = force_of(wrench_);
  if (!deforms()) return domain;
  turn_ = turn(x);
  turn_in_body_ = turn_in_body_by_s_.dot(amplitudes_of(x));
  C_W_now_ = C_W_;
  C_W_now_.rightCols<3>() += by_offset_moment_ * skew(offset_by_s_ * amplitudes_of(x));
  eliminate_deformation();
  const film::NormalForces& normal = reynolds_.forces().normal;
  const MatrixXd& B = deforming_.shapes().openings;
  const VectorXd s = amplitudes_of(x);
  r_s_ = s_0_ + answer(B.transpose() * normal.value, reynolds_.forces().wrench_on_shell) - s;
  const VectorXd Q = B.transpose() * (normal.value + normal.by_u.cwiseProduct(du));
  const VectorXd ds = condensed_.solve(s_0_ + answer(Q, wrench_) - s);
  dx_.resize(size());
  dx_ << du + u_by_s_ * ds, ds;
  wrench_ += W_by_s_ * ds;
  turn_ += turn_by_s_.dot(ds);
  force_ = force_of(about_z(turn_) * wrench_);
  return domain;
}

// Multigrid solves several right-hand sides for little more than one: increment and answer to the position together.
void SteadyFilm::solve_with_position(const Coordinates& e, VectorXd& du) {
  reynolds_.partials(coordinates_->directions(e, 0, e.size()), u_by_position_, W_by_position_);
  u_by_position_ = -u_by_position_;
  u_by_position_.conservativeResize(Eigen::NoChange, e.size() + 1);
  u_by_position_.col(e.size()) = -reynolds_.residual().value;
  reynolds_.solve(u_by_position_, film::SystemMatrix::jacobian, kStepTolerance);
  du = u_by_position_.col(e.size());
  u_by_position_.conservativeResize(Eigen::NoChange, e.size());
}

void SteadyFilm::respond_to_position(const Coordinates& e, MatrixXd& dx, Columns& dW) {
  if (!has_position_answers()) return respond(coordinates_->directions(e, 0, e.size()), dx, dW);
  dx = u_by_position_;
  dW = W_by_position_ + reynolds_.forces().wrench_by_u * dx;
}

film::FilmDomain SteadyFilm::chord_about(const Coordinates& e, const VectorXd& x) {
  const film::FilmDomain domain = reynolds_.chord_increment(surfaces(e, x), history_, x, dx_);
  if (!domain.is_inside()) return domain;
  wrench_ = reynolds_.forces().wrench_on_shell + reynolds_.forces().wrench_by_u * dx_;
  force_ = force_of(wrench_);
  return domain;
}

film::FilmObservables SteadyFilm::observe(const Coordinates& e, const VectorXd& x, const Eigen::Vector2d& offset) {
  const film::SurfaceMotion motion = surfaces(e, x);
  const VectorXd u = film_of(x);
  const film::FilmDomain domain = reynolds_.linearise(motion, history_, u);
  HERSEY_REQUIRE(domain.is_inside(), film::text(model_, domain));
  ends_linearised_ = false;
  return reynolds_.observe(motion, offset, u, tilt(x));
}

/// The part of wrenches on the fixed surface that works on the position.
MatrixXd SteadyFilm::force_of(const Eigen::Ref<const MatrixXd>& wrench) const {
  return coordinates_->force_rows().topRows(coordinates_->count()) * wrench;
}

/// The shell's body takes its wrench in its own axes, in which a frame of it may turn.
VectorXd SteadyFilm::answer(const VectorXd& Q, const Vector6& W) const {
  return C_ * Q + C_W_now_ * (about_z(turn_in_body_) * W);
}

/// Change of the wrench in those axes with the amplitudes.
MatrixXd SteadyFilm::wrench_by_amplitudes() const {
  return about_z(turn_in_body_) * (W_by_s_ + turning(wrench_) * turn_in_body_by_s_);
}

MatrixXd SteadyFilm::change_of_force(const MatrixXd& dx, const Columns& dW) const {
  if (!deforms()) return force_of(dW);
  return force_of(about_z(turn_) * (dW + turning(wrench_) * (turn_by_s_ * dx.bottomRows(amplitudes()))));
}

/// Changes of the forces on shapes with changes of the film's unknowns and of the gap, column by column.
MatrixXd SteadyFilm::forces_on_shapes(const MatrixXd& du, const MatrixXd& g) const {
  const film::NormalForces& normal = reynolds_.forces().normal;
  return deforming_.shapes().openings.transpose() * (normal.by_u.asDiagonal() * du + normal.by_g.asDiagonal() * g);
}

/// The film's answers to the amplitudes, and the factor of 1 - C P_s, the matrix of (bearing.27).
void SteadyFilm::eliminate_deformation() {
  film::respond(reynolds_, positions_, u_by_s_, W_by_s_);
  W_by_s_ += reynolds_.forces().wrench_by_u * u_by_s_;
  // The tilt follows the amplitudes.
  u_by_s_ = (u_by_s_.leftCols(amplitudes()) + u_by_s_.rightCols<2>() * tilt_by_s_).eval();
  W_by_s_ = (W_by_s_.leftCols(amplitudes()) + W_by_s_.rightCols<2>() * tilt_by_s_).eval();
  const MatrixXd Q_by_s = forces_on_shapes(u_by_s_, all_openings_);
  MatrixXd A = MatrixXd::Identity(amplitudes(), amplitudes());
  A.noalias() -= C_ * Q_by_s;
  A.noalias() -= C_W_now_ * wrench_by_amplitudes();
  const Vector3 f = (about_z(turn_in_body_) * wrench_).tail<3>();
  A.noalias() += by_offset_moment_ * (skew(f) * offset_by_s_);
  condensed_.compute(A);
}

int SteadyFilm::linearise_near(const Coordinates& e, VectorXd& x) {
  if (!linearise(e, x).is_inside()) return 0;
  if (!deforms() || reynolds_.residual().relative < kFarFilm) return 1;
  VectorXd u = film_of(x);
  const film::FilmSolveSummary solved = solve_film(surfaces(e, x), u);
  if (solved.solved()) x.head(u.size()) = u;
  return linearise(e, x).is_inside() ? solved.iterations + 2 : 0;
}

double SteadyFilm::relative_residual() const {
  if (!deforms()) return reynolds_.residual().relative;
  const double off = (all_openings_ * r_s_).cwiseAbs().maxCoeff() / clearance(model_);
  return std::max(reynolds_.residual().relative, off);
}

void SteadyFilm::respond(std::span<const film::MotionDirection> directions, MatrixXd& dx, Columns& dW) {
  MatrixXd du;
  film::respond(reynolds_, directions, du, dW, kCoefficientTolerance);
  dW += reynolds_.forces().wrench_by_u * du;
  if (!deforms()) {
    dx = std::move(du);
    return;
  }
  MatrixXd g = MatrixXd::Zero(du.rows(), du.cols());
  for (Index k = 0; k < du.cols(); ++k) {
    const VectorXd& opening = directions[static_cast<std::size_t>(k)].g;
    if (opening.size() > 0) g.col(k) = opening;
  }
  const MatrixXd ds = condensed_.solve(C_ * forces_on_shapes(du, g) + C_W_now_ * (about_z(turn_in_body_) * dW));
  dx.resize(size(), du.cols());
  dx << du + u_by_s_ * ds, ds;
  dW += W_by_s_ * ds;
}

SteadyFilm::Columns SteadyFilm::by_acceleration(const MatrixXd& dx_by_rate, double inertia_factor) {
  HERSEY_REQUIRE(!deforms(), "rigid surfaces: amplitudes that follow have an inertia of their own");
  return reynolds_.forces().wrench_by_u * reynolds_.inertia(dx_by_rate, inertia_factor);
}

double SteadyFilm::depth(const Coordinates& load) {
  if (!deforms()) return 0;
  // Under a pressure that falls from the load's side around the bearing like a cosine and bears the load.
  const Eigen::Vector2d along = axis_offset(load).normalized();
  VectorXd forces = VectorXd::Zero(model_.grid.size());
  double borne = 0;
  for (int k = 0; k < forces.size(); ++k) {
    const double phi = model_.grid.phi(k / model_.grid.n_z);
    const double cosine = along.dot(Eigen::Vector2d(std::cos(phi), std::sin(phi)));
    forces[k] = std::max(0.0, cosine);
    borne += forces[k] * cosine;
  }
  forces *= load.norm() / borne;
  const MatrixXd& B = deforming_.shapes().openings;
  return (B * (C_ * (B.transpose() * forces))).cwiseAbs().maxCoeff();
}

VectorXd SteadyFilm::shell_displacement(const VectorXd& x) const {
  return deforming_.shell_deforms() ? deforming_.shell_displacement(amplitudes_of(x)) : VectorXd();
}

VectorXd SteadyFilm::journal_displacement(const VectorXd& x) const {
  return deforming_.journal_deforms() ? deforming_.journal_displacement(amplitudes_of(x)) : VectorXd();
}

}  // namespace hersey::bearing
