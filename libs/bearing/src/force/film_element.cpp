#include "force/film_element.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "hersey/bearing/clearance.h"
#include "hersey/core/contract.h"
#include "hersey/film/observables.h"

namespace hersey::bearing {
namespace {

// Fraction of a control volume that may be left to the next one at the end of a step.
constexpr double kLargestRedistributedOverfill = 0.02;

// After so many iterations of film and bodies together the film is found by itself.
constexpr int kCommonIterations = 12;

// Residual of a film whose increment may come from an older factor: what that leaves out is of its square.
constexpr double kNearOnChord = 1e-6;

// A step this many times as long as the last one begins with the film that it left.
constexpr double kFurthestPrediction = 2;

// Films at the start of a run whose layers thin by their shear, and the change of viscosity with which they end.
constexpr int kMostFirstFilms = 20;
constexpr double kAsThin = 1e-6;

void persist_history(Archive& archive, film::FilmHistory& history) {
  archive.io("dt", history.dt), archive.io("by_gap", history.by_gap);
  archive.io("theta", history.theta), archive.io("w", history.w), archive.io("density", history.density);
  archive.io("gap", history.gap), archive.io("phi_journal", history.phi_journal);
  film::LayeredViscosity& viscosity = history.viscosity;
  archive.io("fluidity", viscosity.fluidity), archive.io("shear_fluidity", viscosity.shear_fluidity);
  archive.io("skew", viscosity.skew), archive.io("at_rest", viscosity.at_rest);
  archive.io("axial_fluidity", viscosity.axial_fluidity);
}

}  // namespace

FilmElement::FilmElement(const film::FilmModel& model, Options options)
    : options_(std::move(options)), reynolds_(model, film::linear_solver_of(options_.solve.solver)) {
  const int n = model.grid.size();
  u_ = u_start_ = u_before_ = du_ = Eigen::VectorXd::Zero(n);
  history_.theta = Eigen::VectorXd::Ones(n);
  history_.w = Eigen::VectorXd::Zero(n);
  if (options_.thermal) {
    heat_.emplace(model, *options_.thermal);
    history_.viscosity = heat_->viscosity();
  }
  history_start_ = history_accepted_ = history_;
}

film::FilmSolveSummary FilmElement::start(const film::SurfaceMotion& surfaces) {
  is_evaluated_ = is_at_accepted_ = false;
  history_.dt = options_.initial_dt;
  if (fill_at_start_.size() > 0)
    history_.theta = fill_at_start_;
  else
    history_.theta.setConstant(options_.initial_fill);
  history_.w.resize(0);
  history_.density.setOnes(u_.size());
  history_.gap.resize(0);
  history_.phi_journal = surfaces.phi_journal;
  has_started_ = false;
  film::FilmSolveSummary summary;
  for (int k = 0; k < kMostFirstFilms; ++k) {
    summary = film::solve_film(reynolds_, surfaces, history_, options_.solve, u_);
    if (!summary.solved()) return summary;
    // Later films of this start have the same viscosities: what asks for them compares forces.
    if (!heat_ || has_layer_shear_ || heat_->thin(surfaces, history_, u_) <= kAsThin) break;
    if (k + 1 < kMostFirstFilms) history_.viscosity = heat_->viscosity();
  }
  has_layer_shear_ = true;
  return summary;
}

void FilmElement::begin_from(const Eigen::VectorXd& fill, const film::HeatState* heat) {
  HERSEY_REQUIRE(fill.size() == u_.size(), "a fill fraction at each node");
  fill_at_start_ = fill;
  if (heat == nullptr) return;
  HERSEY_REQUIRE(heat_.has_value(), "a film with temperatures");
  film::HeatState state = *heat;
  state.thinning = heat_->state().thinning;
  heat_->set_state(state);
  history_.viscosity = history_start_.viscosity = heat_->viscosity();
  has_layer_shear_ = false;
}

film::FilmSolveSummary FilmElement::solve_steady(const film::SurfaceMotion& surfaces) {
  is_evaluated_ = is_at_accepted_ = false;
  history_.dt = 0;
  history_.phi_journal = surfaces.phi_journal;
  if (heat_) history_.viscosity = heat_->viscosity();
  has_started_ = false;
  return film::solve_film(reynolds_, surfaces, history_, options_.solve, u_);
}

void FilmElement::begin_step(double dt) {
  history_ = history_start_;
  history_.dt = dt;
  u_ = is_repeated_ ? u_start_ : predicted(dt);
  is_linearised_ = is_evaluated_ = is_at_accepted_ = false;
  is_repeated_ = true;
  iterations_ = 0;
}

// Unknowns go on as over the last step, but for a step that is tried again. Nodes may switch between full and cavitated
// on the way: most that do, switch.
Eigen::VectorXd FilmElement::predicted(double dt) const {
  if (dt == 0 || dt_before_ == 0 || dt > kFurthestPrediction * dt_before_) return u_start_;
  const Eigen::VectorXd u = u_start_ + dt / dt_before_ * (u_start_ - u_before_);
  return film::check_unknowns(model(), u).is_inside() ? u : u_start_;
}

// u += du0 + U (s - s_last): the film's part of the Newton increment the bodies have just taken.
void FilmElement::follow(const Eigen::VectorXd& parameters) {
  if (!is_linearised_) return;
  parameter_change_ = parameters - parameters_linearised_;
  for (const Eigen::Index k : options_.angles)
    parameter_change_[k] = std::remainder(parameter_change_[k], 2 * std::numbers::pi);
  reynolds_.follow(parameter_change_, du_);
  u_ = u_linearised_ + du_;
}

film::FilmDomain FilmElement::linearise(const film::SurfaceMotion& surfaces, const Eigen::VectorXd& parameters) {
  follow(parameters);
  film::FilmDomain domain = linearise(surfaces);
  if (!domain.is_inside() && is_linearised_) {
    u_ = u_linearised_;
    domain = linearise(surfaces);
  }
  const bool is_late = iterations_ > 0 && iterations_ % kCommonIterations == 0;
  if (is_late && domain.is_inside() && reynolds_.residual().relative > options_.solve.rtol)
    domain = find_by_itself(surfaces);
  if (!domain.is_inside()) return domain;
  parameters_linearised_ = parameters;
  u_linearised_ = u_;
  ++iterations_;
  return domain;
}

// Within a step a film is not swept: sweeps that find what Newton's method does not cost as much as a hundred steps, and
// the integrator shortens the step.
film::FilmSolveSummary FilmElement::solve_in_step(const film::SurfaceMotion& surfaces, Eigen::VectorXd& u) {
  film::FilmSolveOptions without_fallback = options_.solve;
  without_fallback.allows_fallback = false;
  return film::solve_film(reynolds_, surfaces, history_, without_fallback, u);
}

// Newton's iteration of film and bodies may switch the same nodes between full and cavitated for ever. The film by
// itself is often found at the bodies' present motion, on coarser grids first, and from there the iteration goes on.
film::FilmDomain FilmElement::find_by_itself(const film::SurfaceMotion& surfaces) {
  Eigen::VectorXd film = u_;
  const film::FilmSolveSummary summary = solve_in_step(surfaces, film);
  if (summary.solved()) u_ = film;
  return linearise(surfaces);
}

film::CondensedFilm& FilmElement::condense(const std::vector<film::MotionDirection>& directions,
                                           const Eigen::MatrixXd& openings, film::PortFlows flows) {
  reynolds_.condense(directions, openings, condensed_, flows);
  is_linearised_ = true;
  return condensed_;
}

FilmElement::Forces FilmElement::increment(const Eigen::MatrixXd& openings) {
  reynolds_.newton_increment(du_);
  is_linearised_ = false;
  return forces_after(du_, openings);
}

FilmElement::Forces FilmElement::forces_after(const Eigen::VectorXd& du, const Eigen::MatrixXd& openings) const {
  const film::FilmForces forces = reynolds_.forces();
  return {.wrench_on_shell = forces.wrench_on_shell + forces.wrench_by_u * du,
          .Q = openings.transpose() * (forces.normal.value + forces.normal.by_u.cwiseProduct(du))};
}

film::FilmDomain FilmElement::follow_on_chord(const film::SurfaceMotion& surfaces, const Eigen::VectorXd& parameters,
                                              const Eigen::MatrixXd& openings, Forces& forces) {
  film::FilmDomain domain{film::FilmDomain::Violation::not_finite, -1};
  if (is_linearised_ && reynolds_.linear_solver().has_factor) {
    follow(parameters);
    domain = reynolds_.chord_increment(surfaces, history_, u_, du_);
    is_linearised_ = false;
    is_evaluated_ = domain.is_inside();
    if (is_evaluated_ && reynolds_.residual().relative <= kNearOnChord) {
      ++iterations_;
      forces = forces_after(du_, openings);
      return domain;
    }
    if (!domain.is_inside()) u_ = u_linearised_;
  }
  domain = linearise(surfaces, parameters);
  if (domain.is_inside()) forces = increment(openings);
  return domain;
}

film::FilmSolveSummary FilmElement::solve(const film::SurfaceMotion& surfaces) {
  is_evaluated_ = false;
  const film::FilmSolveSummary summary = solve_in_step(surfaces, u_);
  iterations_ += summary.iterations;
  return summary;
}

film::FilmDomain FilmElement::linearise(const film::SurfaceMotion& surfaces) {
  is_at_accepted_ = false;
  const film::FilmDomain domain = reynolds_.linearise(surfaces, history_, u_);
  is_evaluated_ = domain.is_inside();
  return domain;
}

bool FilmElement::is_step_consistent(const film::SurfaceMotion& surfaces) {
  if (!has_started_) return true;
  compute_oil_balance(surfaces, is_evaluated_);
  if (oil_.of_step().redistributed_overfill <= kLargestRedistributedOverfill || history_.by_gap) return true;
  history_.by_gap = true;
  Eigen::VectorXd film = u_;
  const film::FilmSolveSummary summary = solve_in_step(surfaces, film);
  if (summary.solved()) u_ = film;
  is_evaluated_ = false;
  iterations_ += summary.iterations;
  return false;
}

// Uses up the linearisation of the film.
void FilmElement::compute_oil_balance(const film::SurfaceMotion& surfaces, bool is_evaluated) {
  if (is_evaluated)
    oil_.close_step(reynolds_);
  else
    oil_.close_step(reynolds_, surfaces, history_, u_);
  has_step_oil_ = true;
  is_linearised_ = false;
}

// The next step starts from the oil there is, which is what was there before and what has come in since. Temperatures
// follow the film by a step, so that its derivatives are those of what is solved.
void FilmElement::accept_step(const film::SurfaceMotion& surfaces, bool is_evaluated) {
  history_accepted_ = history_;
  const bool is_step = has_started_;
  if (is_step) {
    if (!has_step_oil_) compute_oil_balance(surfaces, is_evaluated && is_evaluated_);
  } else {
    oil_.initialise(model(), surfaces, history_, u_);
    has_started_ = true;
  }
  if (heat_) {
    heat_->advance(surfaces, history_, u_);
    history_start_.viscosity = heat_->viscosity();
  }
  is_at_accepted_ = is_step && is_evaluated;
  const film::FilmFields fields = is_at_accepted_ ? reynolds_.fields() : film::film_fields(model(), surfaces, u_);
  history_start_.w = fields.w;
  history_start_.density = fields.density;
  history_start_.theta = oil_.of_step().content.cwiseQuotient(fields.density);
  history_start_.gap = oil_.of_step().gap;
  history_start_.phi_journal = surfaces.phi_journal;
  if (is_step) oil_.accumulate(history_.dt);
  u_before_ = is_step ? u_start_ : u_;
  dt_before_ = is_step ? history_.dt : 0;
  u_start_ = u_;
  is_linearised_ = is_repeated_ = false;
}

film::FilmObservables FilmElement::observe(const film::SurfaceMotion& accepted, const Eigen::Vector2d& e,
                                           const Eigen::Vector2d& tilt) const {
  film::FilmObservables film = heat_ ? heat_->film(accepted, e, u_start_, tilt)
                               : is_at_accepted_
                                   ? reynolds_.observe(accepted, e, u_start_, tilt)
                                   : film::observe_film(model(), accepted, history_accepted_, e, u_start_, tilt);
  film.oil_volume = oil_.of_run().volume;
  // A film that bears tension has no past: its flows are those of the pressure that acts, at the end of the step.
  if (!film::cavitation_law(model()).has_tension())
    oil_.report_flows(history_accepted_.dt, film::sliding_flow(model(), accepted, clearance(model())), film);
  return film;
}

film::FilmFields FilmElement::fields(const film::SurfaceMotion& accepted) const {
  film::FilmFields fields = is_at_accepted_
                                ? reynolds_.fields()
                                : film::film_fields(model(), accepted, u_start_, history_accepted_.viscosity);
  if (film::cavitation_law(model()).has_fill() && history_start_.theta.size() == u_.size())
    fields.theta = history_start_.theta.cwiseMax(0.0).cwiseMin(1.0);
  fields.depth = film::mean_depth(model(), accepted.phi_journal);
  if (heat_) heat_->fields().show_in(fields);
  return fields;
}

void FilmElement::persist(Archive& archive) {
  persist_history(archive, history_start_);
  oil_.persist(archive);
  if (heat_) {
    const Archive::Group heat(archive, "heat");
    heat_->persist(archive);
  }
  archive.io("started", has_started_);
  archive.io("u", u_start_);
  archive.io("u_before", u_before_), archive.io("dt_before", dt_before_);
  if (archive.restores()) u_ = u_start_, is_at_accepted_ = is_repeated_ = false;
}

void FilmElement::persist_step(Archive& archive) { persist_history(archive, history_); }

}  // namespace hersey::bearing
