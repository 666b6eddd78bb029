#include "hersey/bearing/film_force.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "force/film_element.h"
#include "force/thermal_surfaces.h"
#include "force/wearing_surfaces.h"
#include "force/wrench_exchange.h"
#include "gap/deforming_surfaces.h"
#include "gap/hot_clearance.h"
#include "gap/oil_temperatures.h"
#include "heat/film_temperatures.h"
#include "hersey/bearing/clearance.h"
#include "hersey/core/contract.h"
#include "hersey/film/grid_transfer.h"

namespace hersey::bearing {
namespace {

// Parameters that are the same after a whole revolution.
std::vector<Eigen::Index> angles_of(const GapKinematics& gap) {
  std::vector<Eigen::Index> angles;
  for (Eigen::Index k = 0; k < gap.parameters().size(); ++k)
    if (gap.is_angle(k)) angles.push_back(k);
  return angles;
}

// What a circuit feeds may lack oil.
film::FilmModel with_circuit_ports(film::FilmModel model, const std::vector<std::size_t>& ports) {
  for (const std::size_t feature : ports) model.features[feature].may_lack_oil = true;
  return model;
}

bool same_field(const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return a.size() == b.size() && a == b; }

// True if a film between surfaces that move like the one is that between those that move like the other, bit by bit.
bool same_film(const film::SurfaceMotion& a, const film::SurfaceMotion& b) {
  const bool fields =
      same_field(a.g, b.g) && same_field(a.g_rate, b.g_rate) && same_field(a.shell_opening, b.shell_opening) &&
      same_field(a.feature_pressure, b.feature_pressure) && same_field(a.roughness_ratio, b.roughness_ratio);
  return fields && a.u_shell == b.u_shell && a.u_journal == b.u_journal && a.w_shell == b.w_shell &&
         a.w_journal == b.w_journal && a.phi_supply == b.phi_supply && a.phi_journal == b.phi_journal;
}

// The journal takes the negative of the wrench that the shell takes.
void respond_without_derivatives(const FilmElement::Forces& forces, mbd::ForceResponse& response) {
  response.W_B_A = -forces.wrench_on_shell;
  response.Q = forces.Q;
}

// Adds a shape to a film's list. @returns the shape
template <class Shape>
Shape* add_shape(std::unique_ptr<Shape> shape, std::vector<std::unique_ptr<SurfaceShape>>& shapes) {
  Shape* const added = shape.get();
  shapes.push_back(std::move(shape));
  return added;
}

}  // namespace

FilmForce::FilmForce(std::string name, const film::FilmModel& model, std::unique_ptr<GapKinematics> gap,
                     const BearingOptions& options)
    : name_(std::move(name)),
      options_(options),
      gap_(std::move(gap)),
      film_(std::make_unique<FilmElement>(with_circuit_ports(model, options.circuit_ports),
                                          FilmElement::Options{.solve = options.film,
                                                               .initial_dt = options.initial_dt,
                                                               .initial_fill = options.initial_fill,
                                                               .thermal = options.thermal,
                                                               .angles = angles_of(*gap_)})),
      thermal_(add_shape(std::make_unique<ThermalSurfaces>(film_->model(), film_->heat(), options.growth), shapes_)),
      deforming_(add_shape(std::make_unique<DeformingSurfaces>(model, options.shell_surface, options.journal_surface),
                           shapes_)),
      exchange_(std::make_unique<WrenchExchange>(options.acceleration, options.relaxation, deforming_->amplitudes(),
                                                 model.R)),
      gap_parameter_count_(gap_->parameters().size()),
      parameters_(Eigen::VectorXd::Zero(gap_parameter_count_ + 2 * deforming_->amplitudes() + port_count())),
      directions_(static_cast<std::size_t>(gap_parameter_count_ + port_count())),
      port_pressures_(Eigen::VectorXd::Constant(port_count(), model.p_cav)),
      accepted_s_(Eigen::VectorXd::Zero(deforming_->amplitudes())) {
  if (options.wear)
    wearing_ = add_shape(std::make_unique<WearingSurfaces>(film_->model(), *options.wear, options.common), shapes_);
  HERSEY_REQUIRE(port_count() == 0 || options.coupling == Coupling::monolithic, "a circuit in one Newton system");
  for (Eigen::Index k = 0; k < port_count(); ++k)
    directions_[directions_.size() - static_cast<std::size_t>(port_count() - k)].port_pressure =
        Eigen::VectorXd::Unit(static_cast<Eigen::Index>(model.features.size()),
                              static_cast<Eigen::Index>(options_.circuit_ports[static_cast<std::size_t>(k)]));
}

FilmForce::~FilmForce() = default;

const film::FilmModel& FilmForce::model() const { return film_->model(); }

film::FilmWork FilmForce::work() const { return film_->reynolds().work(); }

const film::FilmHeat* FilmForce::heat() const { return film_->heat(); }

void FilmForce::evaluate_surfaces(const mbd::RelativeMotion& motion) {
  thermal_->set_clearance_change(*gap_);
  domain_error_ = gap_->evaluate(motion, surfaces_);
  if (!domain_error_.empty()) return;
  HERSEY_REQUIRE(motion.s.size() == deforming_->amplitudes(), "the amplitudes of both surfaces' bodies");
  parameters_.head(gap_parameter_count_) = gap_->parameters();
  parameters_.segment(gap_parameter_count_, motion.s.size()) = motion.s;
  parameters_.segment(gap_parameter_count_ + motion.s.size(), motion.s.size()) = motion.s_rate;
  const GapKinematics::Turning turning = gap_->turning();
  for (const auto& shape : shapes_) shape->add_to(motion, turning, surfaces_);
  set_supply_pressures(motion.t);
  // A liner may be pushed beyond its undeformed surface; surfaces without one may not meet.
  const double gap = smallest_gap();
  if (!std::isfinite(gap) || (model().compliance == 0 && gap <= 0)) report_contact();
}

void FilmForce::set_supply_pressures(double t) {
  const auto& pressures = options_.feature_pressures;
  surfaces_.feature_pressure.resize(static_cast<Eigen::Index>(pressures.size()));
  for (std::size_t f = 0; f < pressures.size(); ++f) {
    surfaces_.feature_pressure[static_cast<Eigen::Index>(f)] = pressures[f]->value({&t, 1});
  }
  set_port_pressures(port_pressures_);
}

void FilmForce::follow(const mbd::RelativeMotion& motion) {
  evaluate_surfaces(motion);
  has_followed_ = true;
}

Eigen::VectorXd FilmForce::change_of_parameters(const Eigen::VectorXd& from) const {
  Eigen::VectorXd change = surface_parameters() - from;
  for (Eigen::Index k = 0; k < gap_parameter_count_; ++k)
    if (gap_->is_angle(k)) change[k] = std::remainder(change[k], 2 * std::numbers::pi);
  return change;
}

void FilmForce::set_port_pressures(const Eigen::VectorXd& p) {
  port_pressures_ = p;
  parameters_.tail(port_count()) = p;
  for (Eigen::Index k = 0; k < port_count(); ++k)
    surfaces_.feature_pressure[static_cast<Eigen::Index>(options_.circuit_ports[static_cast<std::size_t>(k)])] = p[k];
}

// Smallest gap between the surfaces as their bodies deform, without the liner.
double FilmForce::smallest_gap() const {
  const auto changes_gap = [](const auto& shape) { return shape->changes_gap(); };
  return std::ranges::any_of(shapes_, changes_gap) ? surfaces_.g.minCoeff() : gap_->smallest_gap();
}

void FilmForce::report_contact() {
  Eigen::Index node = 0;
  surfaces_.g.minCoeff(&node);
  domain_error_ =
      fmt::format("{} (smallest undeformed gap {:.4g} um at {}; {})", gap_->contact_text(), 1e6 * smallest_gap(),
                  film::position_of_node(model(), static_cast<int>(node)), gap_->position_text());
  const HotClearance hot = hot_clearance(model(), thermal_->growth(), thermal_->shell(), thermal_->journal());
  if (hot.has_shape || thermal_->growth() != 0)
    domain_error_ += fmt::format("; its clearance of {:.4g} um is {:.4g} um at the temperatures of its walls",
                                 1e6 * clearance(model()), 1e6 * hot.smallest);
  if (smallest_gap() < -clearance(model())) {
    domain_error_ +=
        "; the joints place the surfaces through each other: do lengths, frames and the bearing's place agree?";
    return;
  }
  if (model().asperities.model != film::AsperityModel::none) return;
  domain_error_ += model().compliance > 0 ? "; where no film pressure parts them, as at the edges, only `asperities` do"
                                          : "; smooth surfaces have nothing but the film between them: `asperities` "
                                            "let them touch";
}

// A film that closes where the undeformed surfaces overlap is a journal that touches.
void FilmForce::report(const film::FilmDomain& domain) {
  if (domain.violation == film::FilmDomain::Violation::closed && smallest_gap() <= 0) return report_contact();
  domain_error_ = film::text(model(), domain);
}

void FilmForce::start_film() {
  const film::FilmSolveSummary summary =
      options_.starts_steady ? film_->solve_steady(surfaces_) : film_->start(surfaces_);
  if (!summary.domain.is_inside()) return report(summary.domain);
  if (!summary.solved())
    domain_error_ = (options_.starts_steady ? "no steady film: " : "no film at the start: ") + summary.message;
}

void FilmForce::begin_step(const mbd::RelativeMotion& start, double dt) {
  gap_->begin_step(start);
  exchange_->begin_step();
  is_monolithic_step_ = options_.coupling == Coupling::monolithic || exchange_->is_suspended();
  for (const auto& shape : shapes_) shape->begin_step(dt);
  film_->begin_step(dt);
}

void FilmForce::evaluate(const mbd::RelativeMotion& motion, bool want_tangent, mbd::ForceResponse& response) {
  response.set_zero(deforming_->amplitudes());
  film_->discard_oil_balance();
  if (!has_followed_) evaluate_surfaces(motion);
  has_followed_ = false;
  if (!domain_error_.empty()) return;
  const bool is_start = motion.dt == 0;
  if (is_start) {
    accepted_surfaces_ = surfaces_;
    accepted_s_ = motion.s;
    start_film();
    if (!domain_error_.empty()) return;
    film_->reset_linearisation();
  }
  const bool is_monolithic = is_start || is_monolithic_step_;
  if (is_monolithic) {
    evaluate_monolithic(want_tangent, response);
    exchange_->set(response);
  } else {
    evaluate_partitioned(response);
  }
  // The film's forces above are those of the present motion; inertia adds to them and has no unknowns.
  if (domain_error_.empty() && options_.inertia) options_.inertia->add(motion, want_tangent, response);
  // A prediction of a step that exchanges forces has no film yet.
  if (domain_error_.empty() && (is_monolithic || exchange_->exchanges() > 0)) {
    response.summed = summed_forces();
    response.arm = std::min(model().R, model().L);
  }
}

// Sum of the pressure forces, and of those that the flows would build up which balance in a film without pressure.
double FilmForce::summed_forces() const {
  const film::FilmModel& film = model();
  const double slope = film.R / clearance(film), area = 2 * std::numbers::pi * film.R * film.L;
  const double sliding = std::abs(surfaces_.u_shell + surfaces_.u_journal) / film.R;
  return film_->reynolds().forces().normal.value.lpNorm<1>() + 6 * film.lubricant.mu0 * sliding * slope * slope * area;
}

// The film's rows of (bearing.8): with them condensed the bodies' Newton iteration is that of both together
// (bearing.7).
void FilmForce::evaluate_monolithic(bool want_tangent, mbd::ForceResponse& response) {
  if (!want_tangent && port_count() == 0) {
    FilmElement::Forces forces;
    const film::FilmDomain domain = film_->follow_on_chord(surfaces_, parameters_, deforming_->shapes(), forces);
    if (!domain.is_inside()) return report(domain);
    internal_residual_ = film_->reynolds().residual().relative;
    return respond_without_derivatives(forces, response);
  }
  if (const film::FilmDomain domain = film_->linearise(surfaces_, parameters_, deforming_->shapes());
      !domain.is_inside())
    return report(domain);
  internal_residual_ = film_->reynolds().residual().relative;
  condense_film(response);
}

void FilmForce::condense_film(mbd::ForceResponse& response) {
  for (Eigen::Index k = 0; k < gap_parameter_count_; ++k) directions_[static_cast<std::size_t>(k)] = gap_->direction(k);
  for (const auto& shape : shapes_) shape->add_turning(gap_->turning(), directions_);
  condensed_ = &film_->condense(directions_, deforming_->shapes(),
                                port_count() > 0 ? film::PortFlows::included : film::PortFlows::left_out);
  if (port_count() == 0) respond(response);
}

// Flows through features that a circuit does not feed are of no concern to it. A film without a fill fraction draws
// full oil, of which a circuit that lacks some gives its fill (circuit.19).
FilmForce::PortAnswer FilmForce::port_answer() const {
  const Eigen::Index ports = port_count(), others = parameters_.size() - ports;
  PortAnswer answer{Eigen::VectorXd(ports), Eigen::MatrixXd(ports, others), Eigen::MatrixXd(ports, ports)};
  for (Eigen::Index k = 0; k < ports; ++k) {
    const auto feature = static_cast<Eigen::Index>(options_.circuit_ports[static_cast<std::size_t>(k)]);
    answer.flow[k] = condensed_->port_flow[feature];
    answer.by_parameters.row(k) = condensed_->port_flow_by_s.row(feature).head(others);
    answer.by_pressure.row(k) = condensed_->port_flow_by_s.row(feature).tail(ports);
    const double u = port_pressures_[k] - model().p_cav;
    if (film::cavitation_law(model()).has_fill() || u >= 0 || answer.flow[k] <= 0) continue;
    const double fill = 1 + u / film::fill_scale(model());
    answer.by_parameters.row(k) *= fill;
    answer.by_pressure.row(k) *= fill;
    answer.by_pressure(k, k) += answer.flow[k] / film::fill_scale(model());
    answer.flow[k] *= fill;
  }
  return answer;
}

// (circuit.10)
void FilmForce::complete(const Eigen::VectorXd& dp, const Eigen::MatrixXd& dp_by_parameters,
                         mbd::ForceResponse& response) {
  const Eigen::Index ports = port_count(), others = parameters_.size() - ports;
  film::CondensedFilm& film = *condensed_;
  film.wrench += film.wrench_by_s.rightCols(ports) * dp;
  film.wrench_by_s.leftCols(others) += film.wrench_by_s.rightCols(ports) * dp_by_parameters;
  film.Q += film.Q_by_s.rightCols(ports) * dp;
  film.Q_by_s.leftCols(others) += film.Q_by_s.rightCols(ports) * dp_by_parameters;
  respond(response);
}

// The journal takes the negative of the wrench that the shell takes.
void FilmForce::respond(mbd::ForceResponse& response) {
  const Eigen::Index m = deforming_->amplitudes();
  film::CondensedFilm& film = *condensed_;
  response.W_B_A = -film.wrench;
  const auto by_journal = film.wrench_by_s.leftCols(gap_parameter_count_);
  response.dW_dX.noalias() = -by_journal * gap_->d_dX();
  response.dW_dV.noalias() = -by_journal * gap_->d_dV();
  if (m == 0) return;
  deforming_->add_turning_forces(gap_->turning(), film_->reynolds().forces().normal.value, film.Q_by_s);
  response.Q = film.Q;
  response.dW_ds = -film.wrench_by_s.middleCols(gap_parameter_count_, m);
  response.dW_dr = -film.wrench_by_s.middleCols(gap_parameter_count_ + m, m);
  response.dQ_dX.noalias() = film.Q_by_s.leftCols(gap_parameter_count_) * gap_->d_dX();
  response.dQ_dV.noalias() = film.Q_by_s.leftCols(gap_parameter_count_) * gap_->d_dV();
  response.dQ_ds = film.Q_by_s.middleCols(gap_parameter_count_, m);
  response.dQ_dr = film.Q_by_s.middleCols(gap_parameter_count_ + m, m);
}

void FilmForce::evaluate_partitioned(mbd::ForceResponse& response) {
  internal_residual_ = 1;
  if (exchange_->has_response()) {
    exchange_->begin_exchange();
    const film::FilmSolveSummary summary = film_->solve(surfaces_);
    if (!summary.domain.is_inside()) return report(summary.domain);
    if (!summary.solved()) {
      domain_error_ = summary.message;
      return;
    }
    // One more Newton increment: the exchange would otherwise see the film's tolerance as a change of the wrench.
    if (const film::FilmDomain domain = film_->linearise(surfaces_); !domain.is_inside()) return report(domain);
    respond_without_derivatives(film_->increment(deforming_->shapes().openings), response);
    film_->take_increment();
    internal_residual_ = exchange_->correct(response);
  }
  exchange_->give(response);
}

bool FilmForce::is_step_consistent() {
  exchange_->end_exchange();
  return film_->is_step_consistent(surfaces_);
}

// The film that was solved is reported and warmed: where a step fixes its supply line, with the line there.
void FilmForce::accept_step(const mbd::RelativeMotion& end) {
  const bool is_step = film_->has_started();
  mbd::RelativeMotion solved = end;
  solved.dt = is_step ? film_->dt() : 0;
  accepted_surfaces_ = surfaces_;
  evaluate_surfaces(solved);
  const bool is_evaluated = same_film(surfaces_, accepted_surfaces_);
  accepted_surfaces_ = surfaces_;
  accepted_s_ = end.s;
  accepted_iterations_ = film_->iterations();
  accepted_exchanges_ = exchange_->exchanges();
  if (is_step) gap_->end_step(end);
  film_->accept_step(surfaces_, is_evaluated);
  for (const auto& shape : shapes_) shape->accept_step(film_->dt());
  if (wearing_ != nullptr)
    wearing_->wear_off(film_->fields(accepted_surfaces_).p_asperity, accepted_surfaces_, is_step ? film_->dt() : 0);
  exchange_->accept_step();
}

const film::WallHeatFlow& FilmForce::mean_heat_flow() {
  HERSEY_REQUIRE(film_->heat() != nullptr, "a film with temperatures");
  return film_->heat()->mean_heat_flow();
}

void FilmForce::settle_walls(const Eigen::VectorXd& T_nodes) {
  walls_ = film_->heat()->settle_walls(T_nodes);
  thermal_->settle();
}

void FilmForce::move_walls(const Eigen::VectorXd& T) {
  HERSEY_REQUIRE(film_->heat() != nullptr, "a film with temperatures");
  film_->heat()->move_walls(T);
  film_->update_viscosity();
  thermal_->change_target();
}

Eigen::VectorXd FilmForce::temperatures() const {
  HERSEY_REQUIRE(heat() != nullptr, "a film with temperatures");
  Eigen::VectorXd x = film_temperatures(*heat());
  if (const double scale = heat_of_growth(); scale > 0) {
    x.conservativeResize(x.size() + 1);
    x[x.size() - 1] = scale * thermal_->growth_target();
  }
  return x;
}

// A growth of the clearance as the temperature that makes it [K/m]; 0: walls keep their size.
double FilmForce::heat_of_growth() const {
  const auto& walls = heat()->thermal().expansion;
  const double largest = walls ? std::max(std::abs(walls->shell), std::abs(walls->journal)) : 0;
  return largest > 0 ? 1 / (model().R * largest) : 0;
}

void FilmForce::set_temperatures(const Eigen::VectorXd& x) {
  HERSEY_REQUIRE(film_->heat() != nullptr, "a film with temperatures");
  const double scale = heat_of_growth();
  if (scale > 0) thermal_->set_growth(x[x.size() - 1] / scale);
  set_film_temperatures(x.head(x.size() - (scale > 0 ? 1 : 0)), *film_->heat());
}

void FilmForce::guess_temperatures() {
  HERSEY_REQUIRE(film_->heat() != nullptr, "a film with temperatures");
  film::FilmHeat& heat = *film_->heat();
  heat.set_state(film::first_guess(model(), heat.thermal(), heat.thermal().T_supply, heat.state()));
}

void FilmForce::set_ends(std::vector<film::EndOil> ends) {
  HERSEY_REQUIRE(film_->heat() != nullptr, "a film with temperatures");
  film_->heat()->set_ends(std::move(ends));
}

// Ratios of sheared viscosities are found anew as the film starts.
FilmAtStart FilmForce::on_grid(const film::Grid& grid) const {
  const film::GridTransfer transfer = film::GridTransfer::by_position(model().grid, grid);
  FilmAtStart start{.fill = transfer(fields().theta).cwiseMax(0.0).cwiseMin(1.0), .growth = thermal_->growth()};
  if (heat() == nullptr) return start;
  start.heat = heat()->state();
  start.heat->film = transfer(start.heat->film, heat()->thermal().layers);
  for (Eigen::VectorXd* around : {&start.heat->shell, &start.heat->wall_heat})
    if (around->size() > 0) *around = transfer.around(*around);
  return start;
}

void FilmForce::begin_from(const FilmAtStart& start) {
  film_->begin_from(start.fill, start.heat ? &*start.heat : nullptr);
  if (start.heat) thermal_->set_growth(start.growth);
}

std::string FilmForce::thermal_failure(double closed) const {
  if (heat() == nullptr) return {};
  const film::HeatObservables& observed = heat()->observables();
  const HotClearance hot =
      hot_clearance(model(), thermal_->growth_target(), thermal_->shell_target(), thermal_->journal_target());
  if (hot.smallest <= closed * clearance(model())) return seizure_text(model(), hot, observed, gap_->position_text());
  if (observed.T_max < hottest_trial) return {};
  return fmt::format("a thermal runaway: the hottest oil has {:.0f} degC, at {:.0f} deg, z = {:.3g} mm",
                     observed.T_max - film::zero_celsius, observed.T_max_phi * 180 / std::numbers::pi,
                     1e3 * observed.T_max_z);
}

std::string FilmForce::wear_failure() const { return wearing_ != nullptr ? wearing_->failure() : std::string(); }

std::string FilmForce::name_of_internal_residual() const {
  if (!is_monolithic_step_) return "wrench exchanged between film and bodies";
  const int node = film_->reynolds().residual().worst_node, n_z = model().grid.n_z;
  return fmt::format("film node ({}, {})", node / n_z, node % n_z);
}

void FilmForce::place_surfaces(const mbd::RelativeMotion& motion) {
  evaluate_surfaces(motion);
  accepted_surfaces_ = surfaces_;
}

BearingObservation FilmForce::observe(const mbd::RelativeMotion& motion) const {
  BearingObservation shown{.position = gap_->position(motion)};
  shown.film = film_->observe(accepted_surfaces_, axis_offset(shown.position.e), shown.position.tilt);
  if (heat() != nullptr) shown.heat = heat()->observables();
  shown.walls = walls_;
  shown.oil = film_->oil().of_run();
  shown.wrench_on_shell = shown.film.wrench_on_shell;
  shown.power_into_bodies = -shown.wrench_on_shell.dot(motion.V_AB_A);
  if (options_.inertia) shown.wrench_on_shell -= options_.inertia->wrench(motion);
  if (deforming_->deform())
    shown.power_into_bodies +=
        (deforming_->shapes().openings.transpose() * shown.film.normal_forces).dot(motion.s_rate);
  for (const auto& shape : shapes_) shown.power_of_growth += shape->power(shown.film.normal_forces);
  shown.power_into_bodies += shown.power_of_growth;
  shown.clearance = clearance(model(), thermal_->growth());
  if (thermal_->shell().size() > 0) shown.bore_growth = thermal_->shell().mean();
  if (thermal_->journal().size() > 0) shown.journal_growth = thermal_->journal().mean();
  shown.clearance_of_bodies = shown.clearance + shown.bore_growth - shown.journal_growth;
  if (wearing_ != nullptr) shown.wear = wearing_->observe();
  shown.film_iterations = accepted_iterations_;
  shown.exchanges = accepted_exchanges_;
  return shown;
}

film::FilmFields FilmForce::fields() const {
  film::FilmFields fields = film_->fields(accepted_surfaces_);
  if (options_.shell_surface) fields.d_shell = deforming_->shell_displacement(accepted_s_);
  if (options_.journal_surface) fields.d_journal = deforming_->journal_displacement(accepted_s_);
  if (wearing_ != nullptr) fields.worn_fixed = wearing_->fixed(), fields.worn_moving = wearing_->moving();
  if (wearing_ != nullptr && options_.wear->running_in)
    fields.roughness = model().asperities.sigma * wearing_->roughness_ratio();
  return fields;
}

// Saves the state to which begin_step returns, and the last step: where the integrator starts afresh, accelerations at
// the step's end follow from it. Observations of the step are not saved; they have been recorded.
void FilmForce::persist(Archive& archive) {
  film_->persist(archive);
  {
    const Archive::Group group(archive, "last_step");
    film_->persist_step(archive);
    archive.io("is_monolithic", is_monolithic_step_);
    exchange_->persist_step(archive);
    gap_->persist(archive);
  }
  if (heat() != nullptr) {
    const Archive::Group group(archive, "walls");
    archive.io("correction", walls_.largest), archive.io("rise", walls_.rise);
  }
  for (const auto& shape : shapes_) shape->persist(archive);
  exchange_->persist(archive);
  const Archive::Group group(archive, "film");
  film_->persist_reynolds(archive);
}

}  // namespace hersey::bearing
