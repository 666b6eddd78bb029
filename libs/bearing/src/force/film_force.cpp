#include "hersey/bearing/film_force.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "force/deforming_surfaces.h"
#include "gap/clearance_growth.h"
#include "gap/hot_clearance.h"
#include "gap/thermal_shape.h"
#include "hersey/bearing/operating_point.h"
#include "hersey/core/contract.h"
#include "steady/temperature_path.h"

namespace hersey::bearing {
namespace {

// Share of a control volume that may be left to the next one at the end of a step.
constexpr double kLargestRedistributedOverfill = 0.02;

// Steps taken as one system after an exchange without end, before exchanging is tried again.
constexpr int kStepsAsOne = 16;

// Linearisations of a step from which on nodes that empty do so as their oil says: one that the linear film empties far
// too much and the next one fills again would do so for ever. Between surfaces that deform the gap would not follow.
constexpr int kMostByItself = 4;

// And from which on only half of the nodes that would break or fill do so: by then they go round.
constexpr int kMostAtOnce = 6;

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

FilmForce::FilmForce(std::string name, const film::FilmModel& model, std::unique_ptr<GapKinematics> gap,
                     const BearingOptions& options)
    : name_(std::move(name)),
      options_(options),
      reynolds_(model, film::linear_solver_of(options.film.solver)),
      thermal_shape_(std::make_unique<ThermalShape>()),
      journal_shape_(std::make_unique<ThermalShape>()),
      growth_(std::make_unique<ClearanceGrowth>()),
      gap_(std::move(gap)),
      deforming_(std::make_unique<DeformingSurfaces>(model, options.shell_surface, options.journal_surface)),
      gap_parameter_count_(gap_->parameters().size()),
      directions_(static_cast<std::size_t>(gap_parameter_count_ + 2 * deforming_->amplitudes())),
      interface_(options.acceleration, options.relaxation) {
  const int n = model.grid.size();
  u_ = u_start_ = du_ = Eigen::VectorXd::Zero(n);
  history_.theta = Eigen::VectorXd::Ones(n);
  history_.w = Eigen::VectorXd::Zero(n);
  if (options_.thermal) {
    heat_.emplace(model, *options_.thermal);
    history_.viscosity = heat_->viscosity();
    thermal_shape_->start_at(heat_->shell_opening_in_time());
    journal_shape_->start_at(journal_shape_by_temperature());
  }
  growth_->start_at(growth_by_temperature());
  history_start_ = observed_history_ = history_;
  observed_s_ = Eigen::VectorXd::Zero(deforming_->amplitudes());
  parameters_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(directions_.size()));
  interface_wrench_ = interface_wrench_start_ = Eigen::VectorXd::Zero(6 + deforming_->amplitudes());
}

FilmForce::~FilmForce() = default;

// By the walls as they are now (thermal.42).
double FilmForce::growth_by_temperature() const {
  if (!heat_) return options_.growth;
  const std::optional<film::ThermalExpansion>& walls = heat_->thermal().expansion;
  const film::HeatObservables& seen = heat_->observables();
  return walls ? walls->growth(model().R, seen.T_shell_wall, seen.T_journal_wall) : 0;
}

// Of a journal in a body, at the nodes (thermal.61, thermal.62).
Eigen::VectorXd FilmForce::journal_shape_by_temperature() const {
  return film::around(model().grid, heat_->journal_growth_in_time());
}

void FilmForce::place(const mbd::RelativeMotion& motion) {
  gap_->set_clearance_change(growth_->now(), growth_->rate());
  domain_error_ = gap_->place(motion, surfaces_);
  if (!domain_error_.empty()) return;
  HERSEY_REQUIRE(motion.s.size() == deforming_->amplitudes(), "the amplitudes of both surfaces' bodies");
  parameters_.head(gap_parameter_count_) = gap_->parameters();
  parameters_.segment(gap_parameter_count_, motion.s.size()) = motion.s;
  parameters_.tail(motion.s.size()) = motion.s_rate;
  add_to_shell(thermal_shape_->now(), surfaces_);
  if (thermal_shape_->moves()) surfaces_.g_rate += thermal_shape_->rate();
  add_to_journal(journal_shape_->now(), surfaces_);
  if (journal_shape_->moves()) surfaces_.g_rate -= journal_shape_->rate();
  deforming_->place(motion.s, motion.s_rate, gap_->turning(), surfaces_);
  feed(motion.t);
  // A liner may be pushed beyond its undeformed surface; surfaces without one may not meet.
  const double gap = smallest_gap();
  if (!std::isfinite(gap) || (model().compliance == 0 && gap <= 0)) report_contact();
}

void FilmForce::feed(double t) {
  const auto& pressures = options_.feature_pressures;
  surfaces_.feature_pressure.resize(static_cast<Eigen::Index>(pressures.size()));
  for (std::size_t f = 0; f < pressures.size(); ++f) {
    surfaces_.feature_pressure[static_cast<Eigen::Index>(f)] = pressures[f]->value({&t, 1});
  }
}

/// Of the surfaces as their bodies deform, without the liner.
double FilmForce::smallest_gap() const {
  const bool has_shape = thermal_shape_->now().size() > 0 || journal_shape_->now().size() > 0;
  return deforming_->deform() || has_shape ? surfaces_.g.minCoeff() : gap_->smallest_gap();
}

void FilmForce::report_contact() {
  Eigen::Index node = 0;
  surfaces_.g.minCoeff(&node);
  const film::Grid& grid = model().grid;
  const int i = static_cast<int>(node) / grid.n_z, j = static_cast<int>(node) % grid.n_z;
  domain_error_ =
      fmt::format("the journal touches the shell (smallest undeformed gap {:.4g} um at {:.0f} deg, z = {:.3g} mm; {})",
                  1e6 * smallest_gap(), grid.phi(i) * 180 / std::numbers::pi, 1e3 * model().L * grid.z_over_L(j),
                  gap_->position_text());
  const HotClearance hot = hot_clearance(model(), growth_->now(), thermal_shape_->now(), journal_shape_->now());
  if (hot.has_shape || growth_->now() != 0)
    domain_error_ += fmt::format("; its clearance of {:.4g} um is {:.4g} um at the temperatures of its walls",
                                 1e6 * clearance(model()), 1e6 * hot.smallest);
  if (model().asperities.model != film::AsperityModel::none) return;
  domain_error_ += model().compliance > 0 ? "; where no film pressure parts them, as at the edges, only `asperities` do"
                                          : "; smooth surfaces have nothing but the film between them: `asperities` "
                                            "let them touch";
}

// A film that closes where the undeformed surfaces overlap is a journal that touches.
void FilmForce::report(const film::FilmDomain& domain) {
  if (domain.trouble == film::FilmDomain::Trouble::closed && smallest_gap() <= 0) return report_contact();
  domain_error_ = film::text(model(), domain);
}

// The film of a freshly filled gap; its liner has yielded to it and rests.
void FilmForce::fill_gap() {
  history_.dt = options_.initial_dt;
  history_.theta.setOnes();
  history_.w.resize(0);
  history_.density.setOnes(u_.size());
  history_.gap.resize(0);
  history_.phi_journal = surfaces_.phi_journal;
  started_ = false;
  for (int k = 0; k < kMostFirstFilms; ++k) {
    const film::FilmSolveSummary summary = film::solve_film(reynolds_, surfaces_, history_, options_.film, u_);
    if (!summary.domain.is_inside()) return report(summary.domain);
    if (!summary.solved()) {
      domain_error_ = "no film at the start: " + summary.message;
      return;
    }
    // Later films of this start have the same viscosities: what asks for them compares forces.
    if (!heat_ || is_thinned_ || heat_->thin(surfaces_, history_, u_) <= kAsThin) break;
    if (k + 1 < kMostFirstFilms) history_.viscosity = heat_->viscosity();
  }
  is_thinned_ = true;
}

void FilmForce::begin_step(const mbd::RelativeMotion& start, double dt) {
  gap_->begin_step(start);
  // A trial of this step has exchanged wrenches without end, as where the film damps more than inertia holds.
  if (exchanges_ > 0 && !exchange_has_ended_) monolithic_steps_left_ = kStepsAsOne;
  exchange_has_ended_ = false;
  is_monolithic_step_ = options_.coupling == Coupling::monolithic || monolithic_steps_left_ > 0;
  history_ = history_start_;
  history_.dt = dt;
  growth_->begin_step(dt);
  thermal_shape_->begin_step(dt);
  journal_shape_->begin_step(dt);
  u_ = u_start_;
  linearised_ = false;
  iterations_ = exchanges_ = 0;
  interface_wrench_ = interface_wrench_start_;
  has_interface_response_ = false;
  interface_.begin_step();
}

// u += du0 + U (s - s_last): the film's share of the Newton increment the bodies have just taken.
void FilmForce::follow_surfaces() {
  if (!linearised_) return;
  parameter_change_ = parameters_ - parameters_linearised_;
  for (Eigen::Index k = 0; k < gap_parameter_count_; ++k)
    if (gap_->is_angle(k)) parameter_change_[k] = std::remainder(parameter_change_[k], 2 * std::numbers::pi);
  reynolds_.follow(parameter_change_, du_);
  u_ = u_linearised_ + du_;
  const bool is_rigid = deforming_->amplitudes() == 0 && model().compliance == 0;
  if (is_rigid && iterations_ > kMostByItself) reynolds_.advance_rupture_front(u_);
  if (iterations_ > kMostAtOnce) reynolds_.limit_active_set_changes(u_linearised_, iterations_, u_);
}

// Pressures from a linear prediction may lie beyond any film: then the film stays as it was while the surfaces move.
film::FilmDomain FilmForce::linearise_film() {
  follow_surfaces();
  const film::FilmDomain domain = reynolds_.linearise(surfaces_, history_, u_);
  if (domain.is_inside() || !linearised_) return domain;
  u_ = u_linearised_;
  return reynolds_.linearise(surfaces_, history_, u_);
}

// The journal takes the negative of the wrench that the shell takes.
void FilmForce::condense_film(mbd::ForceResponse& response) {
  const Eigen::Index m = deforming_->amplitudes();
  for (Eigen::Index k = 0; k < gap_parameter_count_; ++k) directions_[static_cast<std::size_t>(k)] = gap_->direction(k);
  std::copy(deforming_->directions().begin(), deforming_->directions().end(),
            directions_.begin() + gap_parameter_count_);
  deforming_->add_turning(gap_->turning(), directions_);
  reynolds_.condense(directions_, deforming_->openings(), condensed_);
  response.W_B_A = -condensed_.wrench;
  const auto by_journal = condensed_.wrench_ds.leftCols(gap_parameter_count_);
  response.dW_dX.noalias() = -by_journal * gap_->d_dX();
  response.dW_dV.noalias() = -by_journal * gap_->d_dV();
  if (m == 0) return;
  deforming_->add_turning_forces(gap_->turning(), reynolds_.normal_forces().value, condensed_.Q_ds);
  response.Q = condensed_.Q;
  response.dW_ds = -condensed_.wrench_ds.middleCols(gap_parameter_count_, m);
  response.dW_dr = -condensed_.wrench_ds.rightCols(m);
  response.dQ_dX.noalias() = condensed_.Q_ds.leftCols(gap_parameter_count_) * gap_->d_dX();
  response.dQ_dV.noalias() = condensed_.Q_ds.leftCols(gap_parameter_count_) * gap_->d_dV();
  response.dQ_ds = condensed_.Q_ds.middleCols(gap_parameter_count_, m);
  response.dQ_dr = condensed_.Q_ds.rightCols(m);
}

// Wrench and forces on shapes after the film's own increment (bearing.10), without derivatives.
void FilmForce::increment_film(mbd::ForceResponse& response) {
  reynolds_.newton_increment(du_);
  response.W_B_A = -(reynolds_.wrench_on_shell() + reynolds_.wrench_gradient(du_));
  const film::NormalForces& normal = reynolds_.normal_forces();
  response.Q.noalias() = deforming_->openings().transpose() * (normal.value + normal.by_u.cwiseProduct(du_));
}

void FilmForce::evaluate(const mbd::RelativeMotion& motion, bool want_tangent, mbd::ForceResponse& response) {
  response.set_zero(deforming_->amplitudes());
  settled_ = false;
  place(motion);
  if (!domain_error_.empty()) return;
  if (motion.dt == 0) {
    observed_surfaces_ = surfaces_;
    observed_s_ = motion.s;
    fill_gap();
    if (!domain_error_.empty()) return;
    linearised_ = false;
    evaluate_monolithic(want_tangent, response);
    interface_wrench_ << response.W_B_A, response.Q;
  } else if (is_monolithic_step_) {
    evaluate_monolithic(want_tangent, response);
    interface_wrench_ << response.W_B_A, response.Q;
  } else {
    evaluate_partitioned(response);
  }
  // A prediction of a step that exchanges forces has no film yet.
  if (domain_error_.empty() && (motion.dt == 0 || is_monolithic_step_ || exchanges_ > 0))
    response.summed = summed_forces();
}

// Of the pressures, and of those that the flows would build up which balance in a film without any.
double FilmForce::summed_forces() const {
  const film::FilmModel& film = model();
  const double slope = film.R / clearance(film), area = 2 * std::numbers::pi * film.R * film.L;
  const double sliding = std::abs(surfaces_.u_shell + surfaces_.u_journal) / film.R;
  return reynolds_.normal_forces().value.lpNorm<1>() + 6 * film.lubricant.mu0 * sliding * slope * slope * area;
}

// The film's rows of (bearing.8): with them condensed the bodies' Newton iteration is that of both together
// (bearing.7).
void FilmForce::evaluate_monolithic(bool want_tangent, mbd::ForceResponse& response) {
  if (const film::FilmDomain domain = linearise_film(); !domain.is_inside()) return report(domain);
  internal_residual_ = reynolds_.relative_residual();
  parameters_linearised_ = parameters_;
  u_linearised_ = u_;
  ++iterations_;

  if (want_tangent) {
    condense_film(response);
  } else {
    increment_film(response);
  }
  linearised_ = want_tangent;
}

void FilmForce::evaluate_partitioned(mbd::ForceResponse& response) {
  // The first surfaces of a step are a prediction, no answer to any wrench yet.
  if (has_interface_response_) {
    film::FilmSolveOptions without_fallback = options_.film;
    without_fallback.allows_fallback = false;
    const film::FilmSolveSummary summary = film::solve_film(reynolds_, surfaces_, history_, without_fallback, u_);
    iterations_ += summary.iterations;
    ++exchanges_;
    if (!summary.domain.is_inside()) return report(summary.domain);
    if (!summary.solved()) {
      domain_error_ = summary.message;
      return;
    }
    // One more Newton increment: the exchange would otherwise see the film's tolerance as a change of the wrench.
    if (const film::FilmDomain at = reynolds_.linearise(surfaces_, history_, u_); !at.is_inside()) return report(at);
    increment_film(response);
    u_ += du_;
    // Moments over the radius, so that all entries are forces of comparable size.
    Eigen::VectorXd size = Eigen::VectorXd::Ones(interface_wrench_.size()), answer(interface_wrench_.size());
    size.head<3>().setConstant(model().R);
    answer << response.W_B_A, response.Q;
    const Eigen::VectorXd x = interface_wrench_.cwiseQuotient(size), image = answer.cwiseQuotient(size);
    const double largest = std::max(x.norm(), image.norm());
    internal_residual_ = largest > 0 ? (image - x).norm() / largest : 0;
    interface_wrench_ = interface_.next(x, image).cwiseProduct(size);
  } else {
    internal_residual_ = 1;
  }
  has_interface_response_ = true;
  response.W_B_A = interface_wrench_.head<6>();
  response.Q = interface_wrench_.tail(deforming_->amplitudes());
}

bool FilmForce::is_step_consistent() {
  exchange_has_ended_ = true;
  if (!started_) return true;
  settle();
  if (oil_.redistributed_overfill <= kLargestRedistributedOverfill || history_.by_gap) return true;
  history_.by_gap = true;
  Eigen::VectorXd film = u_;
  const film::FilmSolveSummary summary = film::solve_film(reynolds_, surfaces_, history_, options_.film, film);
  if (summary.solved()) u_ = film;
  iterations_ += summary.iterations;
  return false;
}

// Takes the linearisation of the film for it.
void FilmForce::settle() {
  reynolds_.settle(surfaces_, history_, u_, oil_);
  settled_ = true;
  linearised_ = false;
}

// What is shown, settled and warmed is the film that was solved: where a step holds its supply line, held there.
void FilmForce::accept_step(const mbd::RelativeMotion& end) {
  mbd::RelativeMotion solved = end;
  solved.dt = started_ ? history_.dt : 0;
  place(solved);
  observed_surfaces_ = surfaces_;
  observed_s_ = end.s;
  observed_history_ = history_;
  observed_iterations_ = iterations_;
  observed_exchanges_ = exchanges_;
  if (started_) gap_->end_step(end);
  close_step();
  linearised_ = false;
  u_start_ = u_;
  interface_wrench_start_ = interface_wrench_;
  interface_.begin_step();
  exchanges_ = 0;
  monolithic_steps_left_ = std::max(monolithic_steps_left_ - 1, 0);
}

// The next step starts from the oil there is, which is what was there before and what has come in since.
void FilmForce::close_step() {
  const bool is_step = started_;
  if (is_step) {
    if (!settled_) settle();
  } else {
    reynolds_.initialise_oil_balance(surfaces_, history_, u_, oil_);
    oil_of_run_ = {};
    started_ = true;
  }
  // Temperatures follow the film by a step, so that its derivatives are those of what is solved.
  if (heat_) {
    heat_->advance(surfaces_, history_, u_);
    history_start_.viscosity = heat_->viscosity();
  }
  growth_->accept_step(growth_by_temperature(), history_.dt);
  thermal_shape_->accept_step(history_.dt);
  journal_shape_->accept_step(history_.dt);
  const film::FilmFields fields = film::film_fields(model(), surfaces_, u_);
  history_start_.w = fields.w;
  history_start_.density = fields.density;
  history_start_.theta = oil_.content.cwiseQuotient(fields.density);
  history_start_.gap = oil_.gap;
  history_start_.phi_journal = surfaces_.phi_journal;
  if (is_step) {
    const double dt = history_.dt, in = oil_.flow_supply, out = oil_.flow_out();
    oil_of_run_.step_error = oil_.volume - oil_of_run_.volume - dt * (in - out);
    oil_of_run_.unexplained += oil_of_run_.step_error;
    oil_of_run_.through_flow += dt * std::max(std::abs(in), std::abs(out));
  }
  oil_of_run_.volume = oil_.volume;
}

const film::WallExchange& FilmForce::mean_exchange() {
  HERSEY_REQUIRE(heat_.has_value(), "a film with temperatures");
  return heat_->mean_exchange();
}

void FilmForce::settle_walls(const Eigen::VectorXd& T_nodes) {
  walls_ = heat_->settle_walls(T_nodes);
  growth_->settle(growth_by_temperature());
  thermal_shape_->settle(heat_->shell_opening_in_time());
  journal_shape_->settle(journal_shape_by_temperature());
}

void FilmForce::move_walls(const Eigen::VectorXd& T) {
  HERSEY_REQUIRE(heat_.has_value(), "a film with temperatures");
  heat_->move_walls(T);
  history_start_.viscosity = heat_->viscosity();
  growth_->change_target(growth_by_temperature());
}

std::string FilmForce::thermal_trouble(double closed) const {
  if (!heat_) return {};
  const film::HeatObservables& seen = heat_->observables();
  const auto celsius = [](double T) { return T - film::zero_celsius; };
  const HotClearance hot =
      hot_clearance(model(), growth_->target(), heat_->shell_opening_in_time(), journal_shape_by_temperature());
  if (hot.smallest <= closed * clearance(model())) return seizure_text(model(), hot, seen, gap_->position_text());
  if (seen.T_max < hottest_trial) return {};
  return fmt::format("a thermal runaway: the hottest oil has {:.0f} degC, at {:.0f} deg, z = {:.3g} mm",
                     celsius(seen.T_max), seen.T_max_phi * 180 / std::numbers::pi, 1e3 * seen.T_max_z);
}

std::string FilmForce::name_of_internal_residual() const {
  if (!is_monolithic_step_) {
    return "wrench exchanged between film and bodies";
  }
  const int node = reynolds_.worst_node(), n_z = model().grid.n_z;
  return fmt::format("film node ({}, {})", node / n_z, node % n_z);
}

BearingObservation FilmForce::observe(const mbd::RelativeMotion& motion) const {
  BearingObservation seen{.position = gap_->position(motion)};
  const GapPosition& at = seen.position;
  seen.film = heat_ ? heat_->film(observed_surfaces_, at.e, u_start_, at.tilt)
                    : film::observe_film(model(), observed_surfaces_, observed_history_, at.e, u_start_, at.tilt);
  show_oil(seen.film);
  if (heat_) seen.heat = heat_->observables();
  seen.walls = walls_;
  seen.oil = oil_of_run_;
  seen.wrench_on_shell = seen.film.wrench_on_shell;
  seen.power_into_bodies = -seen.wrench_on_shell.dot(motion.V_AB_A);
  if (deforming_->deform())
    seen.power_into_bodies += (deforming_->openings().transpose() * seen.film.normal_forces).dot(motion.s_rate);
  // Walls that grow apart are pushed on as shapes that open the gap everywhere are (thermal.44).
  seen.power_of_growth = growth_->rate() * seen.film.normal_forces.sum();
  if (thermal_shape_->moves()) seen.power_of_growth += thermal_shape_->rate().dot(seen.film.normal_forces);
  if (journal_shape_->moves()) seen.power_of_growth -= journal_shape_->rate().dot(seen.film.normal_forces);
  if (thermal_shape_->now().size() > 0) seen.bore_growth = thermal_shape_->now().mean();
  if (journal_shape_->now().size() > 0) seen.journal_growth = journal_shape_->now().mean();
  seen.clearance_of_bodies = clearance(model(), growth_->now()) + seen.bore_growth - seen.journal_growth;
  seen.power_into_bodies += seen.power_of_growth;
  seen.clearance = clearance(model(), growth_->now());
  seen.film_iterations = observed_iterations_;
  seen.exchanges = observed_exchanges_;
  return seen;
}

// Flows of the step as a whole, in place of those at its end.
void FilmForce::show_oil(film::FilmObservables& film) const {
  film.oil_volume = oil_of_run_.volume;
  if (oil_.flow_features.size() != film.flow_features.size() || observed_history_.dt == 0) return;
  // A film that bears tension has no past: its flows are those of the pressure that acts, at the end.
  if (film::cavitation_law(model()).has_tension()) return;
  film.flow_left = oil_.flow_left, film.flow_right = oil_.flow_right, film.flow_ends = oil_.flow_ends;
  film.flow_supply = oil_.flow_supply, film.flow_features = oil_.flow_features;
  film.storage_rate = oil_.flow_supply - oil_.flow_out() + oil_of_run_.step_error / observed_history_.dt;
  double scale =
      std::max({std::abs(oil_.flow_left), std::abs(oil_.flow_right), std::abs(oil_.flow_supply),
                std::abs(film.storage_rate), std::abs(observed_surfaces_.u_journal) * clearance(model()) * model().L});
  if (oil_.flow_features.size() > 0) scale = std::max(scale, oil_.flow_features.cwiseAbs().maxCoeff());
  film.mass_balance_error = scale > 0 ? std::abs(oil_of_run_.step_error) / (scale * observed_history_.dt) : 0;
}

film::FilmFields FilmForce::fields() const {
  film::FilmFields fields = film::film_fields(model(), observed_surfaces_, u_start_);
  if (film::cavitation_law(model()).has_fill() && history_start_.theta.size() == u_.size())
    fields.theta = history_start_.theta.cwiseMax(0.0).cwiseMin(1.0);
  fields.depth = film::mean_depth(model(), observed_surfaces_.phi_journal);
  if (heat_) heat_->fields().show_in(fields);
  if (options_.shell_surface) fields.d_shell = deforming_->shell_displacement(observed_s_);
  if (options_.journal_surface) fields.d_journal = deforming_->journal_displacement(observed_s_);
  return fields;
}

// What begin_step returns to, and the oil that the last step began with: where the method starts afresh, accelerations
// at the step's end follow from it (solver::solve_accelerations). What the step showed is not kept: it has been
// observed.
void FilmForce::persist(Archive& archive) {
  persist_history(archive, history_start_);
  {
    const Archive::Group group(archive, "last_step");
    persist_history(archive, history_);
    archive.io("is_one_system", is_monolithic_step_);
    archive.io("answered", has_interface_response_);
    archive.io("exchange_has_ended", exchange_has_ended_);
    gap_->persist(archive);
  }
  archive.io("oil_volume", oil_of_run_.volume);
  archive.io("oil_through_flow", oil_of_run_.through_flow);
  archive.io("oil_unexplained", oil_of_run_.unexplained);
  if (heat_) {
    const Archive::Group heat(archive, "heat");
    heat_->persist(archive);
    archive.io("wall_correction", walls_.largest), archive.io("wall_rise", walls_.rise);
    growth_->persist(archive);
    thermal_shape_->persist(archive);
    const Archive::Group journal(archive, "journal");
    journal_shape_->persist(archive);
  }
  archive.io("started", started_);
  archive.io("u", u_start_);
  archive.io("given_wrench", interface_wrench_start_);
  archive.io("steps_as_one_left", monolithic_steps_left_);
  {
    const Archive::Group group(archive, "exchange");
    interface_.persist(archive);
  }
  if (archive.restores()) u_ = u_start_, interface_wrench_ = interface_wrench_start_;
  const Archive::Group group(archive, "film");
  reynolds_.persist(archive);
}

}  // namespace hersey::bearing
