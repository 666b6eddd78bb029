#include "steady/steady_search.h"

#include <cmath>
#include <variant>

#include "hersey/bearing/bearing_kind.h"
#include "hersey/film/observables.h"
#include "hersey/film/reynolds.h"

// Entry points of the search, and the state that it has found.
namespace hersey::bearing {
namespace {

// ln(mu(p)/mu0) above which the oil counts as a solid, and a film between rigid surfaces is no answer. In terms of the
// reduced pressure of Weibull (1925), alpha p = -ln(1 - alpha p_iso): 1 - alpha p_iso = 6e-6.
constexpr double kLogViscosityOfSolid = 12;

// Positions tried on the way from the start to the bearing's centre, where the film at the start cannot be found.
constexpr int kMostStarts = 5;

// Linearisations allowed to search_outwards() in addition to those of the paths from the start, as a fraction of these.
constexpr double kOutwardSearchBudget = 0.6;

}  // namespace

SteadySearch::SteadySearch(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options)
    : model_(model), point_(point), options_(options), film_(model, point_, options), x_(film_.start()) {
  e_ = force_ = Coordinates::Zero(coordinates_of().count());
  if (point_.load) film_.look_for_position();
}

bool SteadySearch::film_at(const Coordinates& e) {
  e_ = e;
  solver_failed_ = false;
  if (!has_open_gap()) return false;
  const film::FilmSolveSummary solved = film_.solve(e, x_);
  (is_swept() ? summary_.film_iterations : summary_.iterations) += solved.iterations;
  summary_.message = solved.message;
  solver_failed_ = solver_failed(solved);
  return solved.solved() && is_fluid() && linearise();
}

bool SteadySearch::solver_failed(const film::FilmSolveSummary& solved) const {
  using Violation = film::FilmDomain::Violation;
  if (solved.domain.is_inside()) return solved.relative_residual > rtol_;
  const bool stiffens = !std::holds_alternative<film::ConstantViscosity>(model_.lubricant.viscosity_law);
  return solved.domain.violation != Violation::closed && !(solved.domain.violation == Violation::pressure && stiffens);
}

bool SteadySearch::is_fluid() {
  Eigen::Index node = 0;
  const double p = film_.film_of(x_).maxCoeff(&node);
  if (film_.may_overlap() || film::log_viscosity_ratio(model_.lubricant, p).value < kLogViscosityOfSolid) return true;
  summary_.message =
      film::text(model_, {.violation = film::FilmDomain::Violation::pressure, .node = static_cast<int>(node)});
  return false;
}

SteadySummary SteadySearch::solve() {
  if (has_film_ && point_.load && linearise() && solve_jointly(*point_.load)) {
    summary_.set_solved(true);
    summary_.message.clear();
    return summary_;
  }
  has_film_ = true;
  if (!point_.load && options_.start_heat) take_start();
  return point_.load ? under_load() : at_given_position();
}

void SteadySearch::begin_at(const Coordinates& e, const Eigen::VectorXd& u, const Eigen::VectorXd& s) {
  e_ = e;
  x_.head(u.size()) = u;
  x_.tail(s.size()) = s;
  has_film_ = true;
}

SteadySummary SteadySearch::at_given_position() {
  summary_.set_solved(film_at(point_.e));
  if (summary_.solved()) x_ += film_.increment();  // beyond the tolerance: derivatives and differences then agree
  return summary_;
}

bool SteadySearch::prepare_coefficients() {
  if (film_.deforms() || is_swept()) return at_given_position().solved();
  e_ = point_.e;
  if (!has_open_gap() || !film_.solve(e_, x_).solved() || !is_fluid()) return false;
  return film_.ends_linearised() || linearise();
}

SteadySummary SteadySearch::under_load() {
  if (!film_at_start()) return summary_;
  if (carries_no_load()) {
    summary_.message =
        "the film bears no load: it has no pressure anywhere. Where edges at the cavitation pressure "
        "and no supply let no oil in, there is no other film";
    return summary_;
  }
  budget_ = options_.max_linearisations;
  const bool found = solve_jointly(*point_.load) || raise_from_light_load() || continue_nested() || raise_load();
  budget_ = summary_.iterations + static_cast<int>(kOutwardSearchBudget * options_.max_linearisations);
  if (!found && !search_outwards()) {
    summary_.message = failure_message();
    return summary_;
  }
  summary_.set_solved(true);
  summary_.message.clear();
  return summary_;
}

SteadySummary SteadySearch::retry() {
  if (!point_.load) return at_given_position();
  budget_ = summary_.iterations + options_.max_linearisations;
  const Coordinates e = e_;
  const Eigen::VectorXd x = x_;
  summary_.set_solved(take_chord_steps(*point_.load) ||
                      (linearise() && (take_one_step(*point_.load) || solve_jointly(*point_.load))));
  if (!summary_.solved()) {
    x_ = x;
    summary_.set_solved(film_at(e) && solve_jointly(*point_.load));
  }
  if (!summary_.solved()) return under_load();
  summary_.message.clear();
  return summary_;
}

bool SteadySearch::accept_if_converged() {
  if (!linearise() || film_.relative_residual() > options_.rtol) return false;
  if (point_.load) {
    summary_.force_error = (force_ - *point_.load).norm() / point_.load->norm();
    if (summary_.force_error > options_.rtol) return false;
  }
  x_ += film_.increment();
  return true;
}

void SteadySearch::set_growth(double growth) {
  e_ *= clearance(model_, growth) / clearance(model_, point_);
  point_ = with_growth(point_, model_, growth);
}

void SteadySearch::set_tolerance(double rtol) {
  rtol_ = rtol;
  film_.set_tolerance(rtol);
}

DynamicCoefficients SteadySearch::coefficients() {
  Eigen::MatrixXd dx;
  Columns by_position, by_rate;
  const Eigen::Index count = e_.size() + 2;
  film_.respond(coordinates_of().directions(e_, 0, count), dx, by_position);
  std::vector<film::MotionDirection> rates = coordinates_of().directions(e_, count, count);
  for (Eigen::Index a = 0; film_.deforms() && a < count; ++a) {
    film::MotionDirection& rate = rates[static_cast<std::size_t>(a)];
    rate.g_rate += film_.opening(film_.amplitudes_of(dx.col(a)));
  }
  film_.respond(rates, dx, by_rate);
  DynamicCoefficients result{coordinates_of().force_rows() * by_position, coordinates_of().force_rows() * by_rate};
  if (options_.inertia_factor > 0)
    result.inertia = coordinates_of().force_rows() * film_.by_acceleration(dx, options_.inertia_factor);
  return result;
}

SteadyState SteadySearch::state() {
  SteadyState state;
  state.point = point_;
  state.e = e_;
  state.u = film_.film_of(x_);
  state.s = film_.amplitudes_of(x_);
  state.tilt = film_.tilt(x_);
  state.turn = film_.turn(x_);
  state.d_shell = film_.shell_displacement(x_);
  state.d_journal = film_.journal_displacement(x_);
  state.shapes = film_.shapes();
  state.coefficients = coefficients();
  state.film = film_.observe(e_, x_, axis_offset(e_));
  state.kind = options_.kind ? options_.kind : journal_kind();
  state.load = coordinates_of().force_rows().topRows(e_.size()) * state.film.wrench_on_shell;
  state.viscosity = film_.history().viscosity;
  return state;
}

bool SteadySearch::carries_no_load() {
  const film::FilmFields fields = film::film_fields(model_, film_.surfaces(e_, x_), film_.film_of(x_));
  const double scale =
      model_.lubricant.mu0 * point_.film_speed(clearance(model_), model_.L) * std::pow(model_.R / clearance(model_), 2);
  return fields.p.maxCoeff() - fields.p.minCoeff() <= 1e-9 * scale &&
         model_.asperities.model == film::AsperityModel::none;
}

bool SteadySearch::linearise() {
  change_since_factor_.reset();
  const int linearisations = film_.linearise_near(e_, x_);
  force_ = film_.force();
  summary_.iterations += linearisations;
  return linearisations > 0;
}

Eigen::MatrixXd SteadySearch::force_by_position() {
  Columns dW;
  film_.respond_to_position(e_, dx_de_, dW);
  return film_.change_of_force(dx_de_, dW);
}

bool SteadySearch::film_at_start() {
  const Coordinates start = options_.start ? *options_.start : coordinates_of().start(point_);
  for (int k = 0; k < kMostStarts; ++k) {
    x_ = film_.start();
    if (k == 0) take_start();
    if (film_at(coordinates_of().opened(point_, start, k))) return true;
  }
  return false;
}

void SteadySearch::take_start() {
  const Eigen::Index n = model_.grid.size();
  if (options_.start_film.size() == n) x_.head(n) = options_.start_film;
  if (options_.start_deformation.size() == film_.amplitudes()) x_.tail(x_.size() - n) = options_.start_deformation;
}

}  // namespace hersey::bearing
