#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hersey/film/film_solver.h"
#include "steady/angle_between.h"
#include "steady/steady_search.h"

// Newton's method on film and position (bearing.18).
namespace hersey::bearing {
namespace {

// Largest change of the attitude angle in one Newton step where the supply is at the widest gap [rad].
constexpr double kLargestAttitudeChange = 0.3;

// Iterations on film and position together without getting nearer by half, after which they are solved alternately.
constexpr int kPatience = 6;

// Fraction of the load below which a force has no size to compare with.
constexpr double kForceFloor = 1e-6;

// Newton's method leaves of a small residual this many times its square.
constexpr double kCurvature = 3;

// Residuals of film and force over their scales at which derivatives are those of the solution, to some times this;
// with edges in oil under pressure, whose flow is the scale of the residual, to some thousand times.
constexpr double kSameDerivatives = 1e-9;

// Steps of the chord method in one iteration at most, and what may be missing for a first one.
constexpr int kMostOnChord = 3;
constexpr double kFarOnChord = 0.01;

// Error allowed after chord steps as a fraction of the tolerance. They end just below their bound, steps of Newton's
// method far below the tolerance: so the bound is stricter.
constexpr double kChordTolerance = 0.1;

// A step of the journal over the smallest gap that needs no care.
constexpr double kSmallStep = 0.05;

}  // namespace

Coordinates SteadySearch::log_force_residual(const Coordinates& target) const {
  const double F = force_.norm(), W = target.norm();
  const double angle = angle_between(force_, target);
  if (F < kForceFloor * W || std::abs(angle) > 0.5 * std::numbers::pi) return target - force_;
  Coordinates missing = std::log(W / F) * force_;
  if (angle != 0) missing += angle * Eigen::Vector2d(-force_.y(), force_.x());
  return missing;
}

double SteadySearch::log_force_error(const Coordinates& target) const {
  const double F = std::max(force_.norm(), 1e-300), W = target.norm();
  const double angle = angle_between(force_, target);
  return std::hypot(std::log(W / F), angle);
}

SteadySearch::Step SteadySearch::newton_step(const Coordinates& target) {
  const Eigen::MatrixXd K = force_by_position();
  Step step{K.fullPivLu().solve(log_force_residual(target)), film_.increment()};
  if (!step.de.allFinite()) step.de.setZero();
  step.de *= std::min(1.0, 0.5 * coordinates_of().scale(point_, e_) / std::max(step.de.norm(), 1e-300));
  if (!film_.may_overlap()) step.de *= log_gap_step_factor(step.de);
  step.dx += dx_de_ * step.de;
  double step_length = 1;
  while (step_length > 1e-6 && !film_.reuses_film(e_, x_, e_ + step_length * step.de, x_ + step_length * step.dx))
    step_length *= 0.7;
  step.de *= step_length;
  step.dx *= step_length;
  return step;
}

double SteadySearch::log_gap_step_factor(const Coordinates& de) const {
  const double gap = gap_at(e_), tiny = 1e-3;
  const double x = (gap - gap_at(e_ + tiny * de)) / (tiny * gap);
  return std::abs(x) < 1e-6 ? 1 : std::min(2.0, -std::expm1(-x) / x);
}

bool SteadySearch::rotates_far(const Coordinates& from, const Coordinates& to) const {
  if (model_.supply.kind != film::SupplyKind::widest_gap) return false;
  return std::abs(angle_between(from, to)) > kLargestAttitudeChange;
}

bool SteadySearch::is_converged(const Coordinates& target) {
  summary_.force_error = (force_ - target).norm() / target.norm();
  return summary_.force_error <= rtol_ && film_.relative_residual() <= rtol_;
}

bool SteadySearch::take_last_increment() {
  const Eigen::VectorXd x = x_ + film_.increment();
  if (film::lowest_fill_node(model_, film_.film_of(x)) >= 0) return false;
  x_ = x;
  return true;
}

// (bearing.40)
bool SteadySearch::take_last_step(const Coordinates& target) {
  if (!film_.has_position_answers()) return false;
  const double off = std::max((force_ - target).norm() / target.norm(), film_.relative_residual());
  if (off > kSameDerivatives || kCurvature * off * off > rtol_) return false;
  const Coordinates de = force_by_position().fullPivLu().solve(target - force_);
  if (!(de.norm() < kSmallStep * gap_at(e_))) return false;
  const Eigen::VectorXd x = x_ + film_.increment() + dx_de_ * de;
  if (((x.array() < 0) != (x_.array() < 0)).any() || film::lowest_fill_node(model_, film_.film_of(x)) >= 0)
    return false;
  e_ += de;
  x_ = x;
  summary_.force_error = kCurvature * off * off;
  return true;
}

bool SteadySearch::take_one_step(const Coordinates& target) {
  if (is_swept()) return false;
  const double off = std::max((force_ - target).norm() / target.norm(), film_.relative_residual());
  if (kCurvature * off * off > rtol_) return false;
  K_ = force_by_position();
  const Coordinates de = K_.fullPivLu().solve(target - force_);
  if (!(de.norm() < kSmallStep * gap_at(e_))) return false;
  e_ += de;
  x_ += film_.increment() + dx_de_ * de;
  if (film_.has_factor()) change_since_factor_ = off;
  return true;
}

// (thermal.31)
bool SteadySearch::take_chord_steps(const Coordinates& target) {
  if (!change_since_factor_) return false;
  const Coordinates e = e_;
  const Eigen::VectorXd x = x_;
  for (int k = 0; k < kMostOnChord && film_.chord_about(e_, x_).is_inside(); ++k) {
    force_ = film_.force();
    const double off = std::max((force_ - target).norm() / target.norm(), film_.relative_residual());
    const Coordinates de = K_.fullPivLu().solve(target - force_);
    if (!(off < kFarOnChord && de.norm() < kSmallStep * gap_at(e))) break;
    e_ += de;
    x_ += film_.increment() + dx_de_ * de;
    if (((x.array() < 0) != (x_.array() < 0)).any()) break;
    *change_since_factor_ += off;
    if (kCurvature * off * *change_since_factor_ <= kChordTolerance * rtol_) return true;
  }
  e_ = e, x_ = x;
  change_since_factor_.reset();
  return false;
}

bool SteadySearch::solve_jointly(const Coordinates& target) {
  if (is_swept()) return false;
  double best = std::numeric_limits<double>::infinity();
  int idle = 0;
  for (int k = 0; k < options_.max_iterations && idle < kPatience; ++k) {
    if (is_converged(target)) {
      if (take_last_increment()) return true;
      if (!film_at(e_)) return false;  // solves the film alone, which can leave such a root
    }
    if (take_last_step(target)) return true;
    const double now = log_force_error(target) + film_.relative_residual();
    idle = now < 0.5 * best ? 0 : idle + 1;
    best = std::min(best, now);
    const Step step = newton_step(target);
    const Coordinates from = e_;
    e_ += step.de;
    const Eigen::VectorXd film = x_;
    x_ += step.dx;
    film_.advance_rupture_front(x_);
    if (has_open_gap() && !rotates_far(from, e_) && linearise()) continue;
    x_ = film;
    if (!film_at(e_)) return false;
  }
  return false;
}

bool SteadySearch::solve_nested(const Coordinates& target) {
  for (int k = 0; k < options_.max_iterations && !is_over_budget(); ++k) {
    if (is_converged(target) && take_last_increment()) return true;
    const Coordinates e = e_;
    const Eigen::VectorXd x = x_;
    const double distance = log_force_error(target);
    const Step step = newton_step(target);
    bool nearer = false;
    for (double step_length = 1; !nearer && step_length > 1e-4 && !is_over_budget(); step_length /= 2) {
      x_ = x + step_length * step.dx;
      if (!film::check_unknowns(model_, film_.film_of(x_)).is_inside()) x_ = x;
      nearer = film_at(e + step_length * step.de) && log_force_error(target) < distance;
    }
    if (!nearer) return false;
  }
  return false;
}

}  // namespace hersey::bearing
