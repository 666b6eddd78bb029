#include "hersey/film/film_heat.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "balance/flow_balance.h"
#include "heat/heat_equations.h"
#include "heat/layer_flows.h"
#include "heat/layer_profile.h"
#include "heat/layer_shear.h"
#include "heat/layering.h"
#include "heat/walls_over_cycles.h"
#include "hersey/core/contract.h"
#include "observe/film_wrench.h"
#include "observe/observe_evaluated.h"

namespace hersey::film {
namespace {

void check(const FilmModel& model, const ThermalModel& thermal) {
  HERSEY_REQUIRE(1 <= thermal.layers && thermal.layers <= most_layers, "1 to 64 layers");
  HERSEY_REQUIRE(0 <= thermal.carry_over && thermal.carry_over <= 1, "carry_over lies between 0 and 1");
  HERSEY_REQUIRE(model.lubricant.specific_heat > 0 && model.lubricant.conductivity >= 0, "an oil that holds heat");
  HERSEY_REQUIRE(thermal.T_features.empty() || thermal.T_features.size() == model.features.size(),
                 "a temperature for each feature or none");
  HERSEY_REQUIRE(thermal.oil.features.empty() || thermal.oil.features.size() == model.features.size(),
                 "a node for each feature or none");
  HERSEY_REQUIRE(thermal.source.size() == 0 || thermal.source.size() == model.grid.size() * thermal.layers,
                 "heat made in each layer of each node or none");
  for (const SurfaceMaterial& surface : {thermal.shell_surface, thermal.journal_surface})
    HERSEY_REQUIRE(surface.conductivity > 0 && surface.heat_capacity > 0, "surfaces that conduct and hold heat");
  const bool is_cylinder = std::holds_alternative<Cylinder>(model.surface);
  HERSEY_REQUIRE(is_cylinder || !std::holds_alternative<BodyWall>(thermal.shell), "a body around the film");
  HERSEY_REQUIRE(is_cylinder || !std::holds_alternative<BodyJournal>(thermal.journal), "a body inside the film");
  if (const auto* ring = std::get_if<RingWall>(&thermal.shell)) {
    HERSEY_REQUIRE(ring->outer_radius > model.R && ring->conductivity > 0 && ring->heat_capacity > 0,
                   "a ring around the film that conducts and holds heat");
  }
  if (const auto* body = std::get_if<BodyWall>(&thermal.shell)) {
    HERSEY_REQUIRE(body->conduction != nullptr && model.grid.closes(), "a body that conducts, around a full bore");
    const WallConduction& wall = *body->conduction;
    const Eigen::Index n = model.grid.n_phi;
    HERSEY_REQUIRE(wall.T0.size() == n && wall.rise.rows() == n && wall.rise.cols() == n, "conduction at these angles");
    HERSEY_REQUIRE(!wall.deforms() || wall.shape0.size() == model.grid.size(), "a shape at the nodes of this grid");
  }
  if (const auto* body = std::get_if<BodyJournal>(&thermal.journal)) {
    HERSEY_REQUIRE(body->conduction != nullptr && body->conduction->rise >= 0, "a journal in a body that conducts");
    const JournalConduction& journal = *body->conduction;
    HERSEY_REQUIRE(!journal.deforms() || journal.shape0.size() == model.grid.n_z,
                   "a shape along the axis of this grid");
  }
  if (const auto* shell = std::get_if<WallAtTemperature>(&thermal.shell)) {
    HERSEY_REQUIRE(shell->around.size() == 0 || shell->around.size() == model.grid.n_phi,
                   "temperatures of shape (n_phi) or none");
  }
}

double mean_across(const Eigen::Ref<const Eigen::VectorXd>& layers, const Layering& across) {
  double mean = 0;
  for (std::size_t l = 0; l < across.size(); ++l) mean += across.width(l) * layers[static_cast<Eigen::Index>(l)];
  return mean;
}

// Pads that are alike are equally hot but for what iterations leave of their range of temperatures.
constexpr double equally_hot = 1e-7;

// Returns the first of the hottest nodes.
Eigen::Index first_of_hottest(const Eigen::VectorXd& T) {
  const double highest = T.maxCoeff(), enough = highest - equally_hot * (highest - T.minCoeff());
  Eigen::Index node = 0;
  while (T[node] < enough) ++node;
  return node;
}

}  // namespace

HeatState first_guess(const FilmModel& model, const ThermalModel& thermal, double T_oil, HeatState image) {
  const double T = thermal.T_supply;
  const TemperatureLaw& law = model.lubricant.temperature_law;
  const double beta = -std::visit([T](const auto& l) { return l.log_viscosity(T).slope; }, law);
  if (!(beta > 0)) return image;
  const double thicker = viscosity_at(law, T) / viscosity_at(law, T_oil);
  const auto thinned = [&](double hot) {
    const double rise = hot - T;
    return T + (rise > 0 ? std::log1p(beta * thicker * rise) / beta : rise);
  };
  image.film = image.film.unaryExpr(thinned);
  // The journal's heat is reduced likewise; at the heat of `image` the journal would fill its bore.
  if (const JournalConduction* body = conduction_of(thermal.journal); body != nullptr && body->rise > 0) {
    image.journal = thinned(image.journal);
    image.journal_heat = (image.journal - body->T0) / body->rise;
  }
  return image;
}

struct FilmHeat::Impl {
  Impl(const FilmModel& film, const ThermalModel& given)
      : thermal((check(film, given), given)),
        flow(film),
        wrench(film),
        flows(flow.model(), given.layers),
        equations(film, given) {}

  [[nodiscard]] HeatState start() const;
  [[nodiscard]] bool shears_layers() const;
  [[nodiscard]] const Eigen::VectorXd& viscosities_at_rest();
  [[nodiscard]] Eigen::VectorXd viscosities();
  void thin();
  [[nodiscard]] bool has_fixed_walls() const { return thermal.walls == WallMotion::fixed; }
  void show_rest();
  /// Computes the observation of the last solution. It is computed on demand, because iterations of film and heat do
  /// not need it.
  void observe();
  [[nodiscard]] const HeatObservables& look();
  void show_surfaces(const CarryingFilm& film);
  void find_hottest();
  void average(const CarryingFilm& film);
  void average_walls();
  [[nodiscard]] CarryingFilm carrying() const { return {flow, wrench, flows, dt}; }
  void find_heat_flow();

  ThermalModel thermal;
  FlowBalance flow;
  FilmWrench wrench;
  LayerFlows flows;
  HeatEquations equations;
  HeatState state;
  WallsOverCycles fixed_walls{thermal};
  HeatState start_of_step, end_of_step;
  bool is_observed = true;
  double dt = 0;                   // of the last step [s]
  HeatState by_shell, by_journal;  // changes of the state with temperatures of nodes, per kelvin
  std::vector<HeatState> by_outside;
  WallHeatFlow heat_flow;
  HeatObservables observed;
  TemperatureFields shown;
  Eigen::VectorXd mu_at_rest, T_of_mu;  ///< viscosities_at_rest() and the temperatures that have them
};

HeatState FilmHeat::Impl::start() const {
  const Grid& grid = flow.model().grid;
  const double T = thermal.T_supply;
  HeatState first;
  first.film.setConstant(grid.size() * thermal.layers, T);
  first.journal = T;
  if (const auto* journal = std::get_if<WallAtTemperature>(&thermal.journal)) first.journal = journal->T;
  if (const auto* journal = std::get_if<FreeJournal>(&thermal.journal)) first.journal = journal->T_start.value_or(T);
  if (const auto* journal = std::get_if<BodyJournal>(&thermal.journal)) first.journal = journal->T_start.value_or(T);
  if (conducts(thermal.shell)) first.shell.setConstant(grid.n_phi, T);
  if (const auto* ring = std::get_if<RingWall>(&thermal.shell)) first.shell.setConstant(ring->T_start.value_or(T));
  if (const auto* shell = std::get_if<WallAtTemperature>(&thermal.shell)) {
    first.shell.setConstant(grid.n_phi, shell->T);
    if (shell->around.size() != 0) first.shell = shell->around;
  }
  if (const auto* body = std::get_if<BodyWall>(&thermal.shell)) {
    first.shell.setConstant(grid.n_phi, body->T_start.value_or(T));
    first.wall_heat.setZero(grid.n_phi);
  }
  if (const auto* journal = std::get_if<NodeWall>(&thermal.journal)) first.journal = journal->T;
  if (const auto* shell = std::get_if<NodeWall>(&thermal.shell)) first.shell.setConstant(grid.n_phi, shell->T);
  first.outside = outside_at_start(thermal);
  first.supplies.resize(equations.supplies());
  first.ends.resize(2 * grid.patches.size());
  for (int k = 0; k < equations.supplies(); ++k) first.supplies[k] = equations.fresh(k, first.outside);
  if (shears_layers()) first.thinning.setOnes(first.film.size() + 2 * grid.size());
  return first;
}

/// Viscosities of the layers at the cavitation pressure [Pa s]. Film and heat need them alternately; they are computed
/// once.
const Eigen::VectorXd& FilmHeat::Impl::viscosities_at_rest() {
  if (T_of_mu.size() == state.film.size() && T_of_mu == state.film) return mu_at_rest;
  const TemperatureLaw& law = flow.model().lubricant.temperature_law;
  T_of_mu = state.film;
  mu_at_rest = T_of_mu.unaryExpr([&](double T) { return viscosity_at(law, T); });
  return mu_at_rest;
}

bool FilmHeat::Impl::shears_layers() const {
  return thermal.layers > 1 && !flow.model().lubricant.shear_thinning.is_newtonian();
}

Eigen::VectorXd FilmHeat::Impl::viscosities() {
  Eigen::VectorXd mu = viscosities_at_rest();
  if (shears_layers()) mu.array() *= state.thinning.head(mu.size()).array();
  return mu;
}

/// Viscosities at the shear in the film last evaluated.
void FilmHeat::Impl::thin() {
  const auto layers = static_cast<std::size_t>(thermal.layers);
  const Lubricant& oil = flow.model().lubricant;
  Eigen::VectorXd mu = viscosities_at_rest();
  LayerShear shear(oil.shear_thinning, thermal.layers);
  for (int node = 0; node < flow.size(); ++node) {
    const Eigen::Index first = node * thermal.layers;
    const std::span<double> at{mu.data() + first, layers}, left{state.thinning.data() + first, layers};
    const Node& film = flow.nodes()[node];
    const double at_rest = 1 / profile_of(at, WithinLayers::constant).shear_fluidity;
    const double by_pressure = std::exp(log_viscosity_ratio(oil, film.p, at_rest).value);
    for (double& one : at) one *= by_pressure;
    shear.thin(at, {flow.slip(node % flow.model().grid.n_z) / film.h, film.h * one_sided_gradient(flow, node)}, left);
    state.thinning.segment<2>(mu.size() + 2 * node) = shear.flow_factors();
  }
}

void FilmHeat::Impl::show_rest() {
  const Eigen::VectorXd everywhere = Eigen::VectorXd::Constant(flow.size(), thermal.T_supply);
  shown = {everywhere, everywhere, everywhere, everywhere};
  if (conducts(thermal.journal)) shown.journal.setConstant(state.journal);
  for (int node = 0; conducts(thermal.shell) && node < flow.size(); ++node)
    shown.shell[node] = state.shell[node / flow.model().grid.n_z];
  observed = {};
  observed.T_supplies = state.supplies;
  observed.T_film_mean = observed.T_side = thermal.T_supply;
  observed.T_shell_mean = shown.shell.mean();
  observed.T_journal = shown.journal.mean();
  find_hottest();
  average_walls();
}

// A ring's angles count by their length; its temperature is the mean over its thickness.
void FilmHeat::Impl::average_walls() {
  observed.T_shell_wall = observed.T_shell_mean, observed.T_journal_wall = observed.T_journal;
  if (conducts(thermal.journal)) observed.T_journal_wall = state.journal;
  if (!conducts(thermal.shell)) return;
  double around = 0, sum = 0;
  for (int i = 0; i < flow.model().grid.n_phi; ++i)
    around += flow.geometry().width_phi[i], sum += flow.geometry().width_phi[i] * state.shell[i];
  observed.T_shell_wall = sum / around;
}

FilmHeat::FilmHeat(const FilmModel& model, const ThermalModel& thermal)
    : impl_(std::make_unique<Impl>(model, thermal)) {
  impl_->state = impl_->start();
  impl_->show_rest();
}
FilmHeat::~FilmHeat() = default;
FilmHeat::FilmHeat(FilmHeat&&) noexcept = default;
FilmHeat& FilmHeat::operator=(FilmHeat&&) noexcept = default;

const ThermalModel& FilmHeat::thermal() const { return impl_->thermal; }
const HeatState& FilmHeat::state() const { return impl_->state; }

void FilmHeat::set_state(const HeatState& state) {
  const HeatState& now = impl_->state;
  HERSEY_REQUIRE(state.film.size() == now.film.size() && state.shell.size() == now.shell.size() &&
                     state.wall_heat.size() == now.wall_heat.size() && state.supplies.size() == now.supplies.size() &&
                     state.outside.size() == now.outside.size() && state.thinning.size() == now.thinning.size() &&
                     state.ends.size() == now.ends.size(),
                 "temperatures of this film");
  impl_->state = state;
  impl_->average_walls();
  // Means over a cycle begin here: what a film has become by being set has come from no wall.
  if (impl_->has_fixed_walls()) impl_->equations.mean().clear();
}

Eigen::VectorXd FilmHeat::shell_opening() const {
  const WallConduction* wall = conduction_of(impl_->thermal.shell);
  return wall == nullptr || !wall->deforms() ? Eigen::VectorXd() : wall->shape(impl_->state.wall_heat);
}

// Before it has settled all of the body has one temperature (thermal.39).
Eigen::VectorXd FilmHeat::shell_opening_in_time() const {
  const WallConduction* wall = conduction_of(impl_->thermal.shell);
  if (wall == nullptr || !wall->deforms() || impl_->fixed_walls.have_settled()) return shell_opening();
  return wall->shape_by_rise * (impl_->state.shell.mean() - wall->T_reference);
}

Eigen::VectorXd FilmHeat::journal_growth() const {
  const JournalConduction* journal = conduction_of(impl_->thermal.journal);
  return journal == nullptr || !journal->deforms() ? Eigen::VectorXd() : journal->shape(impl_->state.journal_heat);
}

// The same holds for the journal (thermal.62).
Eigen::VectorXd FilmHeat::journal_growth_in_time() const {
  const JournalConduction* journal = conduction_of(impl_->thermal.journal);
  if (journal == nullptr || !journal->deforms() || impl_->fixed_walls.have_settled()) return journal_growth();
  return journal->shape_by_rise * (impl_->state.journal - journal->T_reference);
}

Eigen::VectorXd FilmHeat::journal_body_temperatures() const {
  const JournalConduction* journal = conduction_of(impl_->thermal.journal);
  return journal == nullptr ? Eigen::VectorXd() : journal->body(impl_->state.journal_heat);
}

Eigen::VectorXd FilmHeat::body_temperatures() const {
  const WallConduction* wall = conduction_of(impl_->thermal.shell);
  return wall == nullptr || wall->T_body0.size() == 0 ? Eigen::VectorXd() : wall->body(impl_->state.wall_heat);
}

LayeredViscosity FilmHeat::viscosity() const {
  const FilmModel& model = impl_->flow.model();
  const int layers = impl_->thermal.layers;
  const WithinLayers within = within_layers(model.lubricant);
  const auto profile_in = [layers, within](const Eigen::VectorXd& mu, int node) {
    return profile_of({mu.data() + static_cast<Eigen::Index>(node) * layers, static_cast<std::size_t>(layers)}, within);
  };
  LayeredViscosity viscosity;
  for (auto* field : {&viscosity.fluidity, &viscosity.shear_fluidity, &viscosity.skew})
    field->resize(model.grid.size());
  const Eigen::VectorXd mu = impl_->viscosities();
  for (int node = 0; node < model.grid.size(); ++node) {
    const LayerProfile profile = profile_in(mu, node);
    viscosity.fluidity[node] = profile.fluidity;
    viscosity.shear_fluidity[node] = profile.shear_fluidity;
    viscosity.skew[node] = profile.skew;
  }
  if (!impl_->shears_layers()) return viscosity;
  const Eigen::VectorXd at_rest = impl_->viscosities_at_rest();
  viscosity.at_rest.resize(model.grid.size()), viscosity.axial_fluidity.resize(model.grid.size());
  for (int node = 0; node < model.grid.size(); ++node) {
    viscosity.at_rest[node] = 1 / profile_in(at_rest, node).shear_fluidity;
    const auto factors = impl_->state.thinning.segment<2>(mu.size() + 2 * node);
    viscosity.axial_fluidity[node] = factors.y() * viscosity.fluidity[node];
    viscosity.fluidity[node] *= factors.x();
  }
  return viscosity;
}

void FilmHeat::advance(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u) {
  Impl& m = *impl_;
  const FilmDomain domain = m.flow.evaluate(motion, history, u);
  HERSEY_REQUIRE(domain.is_inside(), text(m.flow.model(), domain));
  m.wrench.evaluate(m.flow, motion, false);
  m.flows.evaluate(m.flow, m.wrench, motion, m.viscosities());
  m.dt = history.dt;
  m.start_of_step = m.state;
  m.state = m.equations.solve(m.carrying(), m.start_of_step);
  if (m.shears_layers()) m.thin();
  m.end_of_step = m.state;
  m.is_observed = false;
  if (m.thermal.has_grooves) m.state.ends = m.equations.mixed_in_grooves(m.carrying(), m.state);
  if (terminals_of(m.thermal).has_any() && !(m.has_fixed_walls() && m.dt > 0)) m.find_heat_flow();
}

// Computes the heat into walls that are nodes, and its derivatives for a film that follows them (thermal.46).
void FilmHeat::Impl::find_heat_flow() {
  const CarryingFilm film = carrying();
  const Eigen::Index outside = state.outside.size(), n = 2 + outside;
  heat_flow.T = at_terminals(state);
  heat_flow.heat.setZero(n), heat_flow.by_T.setZero(n, n);
  heat_flow.heat.tail(outside) = equations.into_outside(film, state);
  const auto into_walls = [&](const HeatState& change) {
    Eigen::Vector2d walls = Eigen::Vector2d::Zero();
    for (int node = 0; node < flow.size(); ++node)
      walls += Eigen::Vector2d(equations.into_shell(film, change, node), equations.into_journal(film, change, node));
    Eigen::VectorXd heat(n);
    heat << walls, equations.into_outside(film, change);
    return heat;
  };
  by_outside.clear();
  for (Eigen::Index terminal = 0; terminal < outside; ++terminal) {
    by_outside.push_back(equations.response_to_outside(terminal));
    heat_flow.by_T.col(2 + terminal) = into_walls(by_outside.back());
  }
  const bool is_shell = std::holds_alternative<NodeWall>(thermal.shell);
  const bool is_journal = std::holds_alternative<NodeWall>(thermal.journal);
  if (is_shell) {
    by_shell = equations.response_to_shell();
    heat_flow.by_T.col(0) = into_walls(by_shell);
    heat_flow.heat[0] = look().balance.to_shell;
  }
  if (is_journal) {
    by_journal = equations.response_to_journal();
    heat_flow.by_T.col(1) = into_walls(by_journal);
    heat_flow.heat[1] = look().balance.to_journal;
  }
  if (!is_shell) heat_flow.by_T.row(0).setZero();
  if (!is_journal) heat_flow.by_T.row(1).setZero();
}

const WallHeatFlow& FilmHeat::heat_flow() const { return impl_->heat_flow; }

void FilmHeat::move_walls(const Eigen::VectorXd& T) {
  Impl& m = *impl_;
  const Eigen::VectorXd by = T - m.heat_flow.T;
  const auto move = [&m](const HeatState& change, double dT) {
    m.state.film += dT * change.film;
    if (change.shell.size() > 0) m.state.shell += dT * change.shell;
    m.state.journal += dT * change.journal;
    m.state.supplies += dT * change.supplies;
    m.state.outside += dT * change.outside;
  };
  for (std::size_t terminal = 0; terminal < m.by_outside.size(); ++terminal)
    move(m.by_outside[terminal], by[2 + static_cast<Eigen::Index>(terminal)]);
  if (std::holds_alternative<NodeWall>(m.thermal.shell)) move(m.by_shell, by[0]);
  if (std::holds_alternative<NodeWall>(m.thermal.journal)) move(m.by_journal, by[1]);
  m.heat_flow.heat += m.heat_flow.by_T * by;
  m.heat_flow.T = T;
  m.end_of_step = m.state;
  if (m.thermal.has_grooves) m.state.ends = m.equations.mixed_in_grooves(m.carrying(), m.state);
  m.is_observed = false;
}

std::vector<EndFlow> FilmHeat::end_flows() const {
  return impl_->equations.end_flows(impl_->carrying(), impl_->end_of_step);
}

double FilmHeat::edge_temperature() const { return impl_->equations.at_edges(impl_->state.outside); }

void FilmHeat::set_ends(std::vector<EndOil> ends) {
  HERSEY_REQUIRE(ends.size() == impl_->state.ends.size(), "oil at each end of each patch");
  impl_->state.ends = std::move(ends);
}

double FilmHeat::thin(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u) {
  Impl& m = *impl_;
  if (!m.shears_layers()) return 0;
  (void)m.look();  // observation of the previous film
  const FilmDomain domain = m.flow.evaluate(motion, history, u);
  HERSEY_REQUIRE(domain.is_inside(), text(m.flow.model(), domain));
  const Eigen::VectorXd before = m.state.thinning;
  m.thin();
  return (m.state.thinning.array() / before.array()).log().abs().maxCoeff();
}

const WallHeatFlow& FilmHeat::mean_heat_flow() {
  Impl& m = *impl_;
  HERSEY_REQUIRE(m.has_fixed_walls() && m.equations.mean().has_steps(), "a mean over steps with fixed walls");
  return m.fixed_walls.end_cycle(m.equations.mean(), m.state);
}

WallCorrection FilmHeat::settle_walls(const Eigen::VectorXd& T_nodes) {
  Impl& m = *impl_;
  (void)m.look();  // observation of the previous step
  const WallCorrection correction = m.fixed_walls.settle(T_nodes, m.state);
  m.average_walls();
  return correction;
}

const HeatObservables& FilmHeat::Impl::look() {
  if (!is_observed) observe();
  return observed;
}

void FilmHeat::Impl::observe() {
  const CarryingFilm film = carrying();
  is_observed = true;
  observed = {};
  observed.balance = equations.balance(film, start_of_step, end_of_step);
  observed.T_supplies = end_of_step.supplies;
  if (const WallConduction* wall = conduction_of(thermal.shell); wall != nullptr && wall->T_body0.size() > 0)
    observed.T_body_max = dt > 0 && !fixed_walls.have_settled() ? end_of_step.shell.maxCoeff()
                                                                : wall->body(end_of_step.wall_heat).maxCoeff();
  if (const JournalConduction* body = conduction_of(thermal.journal); body != nullptr && body->T_body0.size() > 0)
    observed.T_journal_body_max =
        dt > 0 && !fixed_walls.have_settled() ? end_of_step.journal : body->body(end_of_step.journal_heat).maxCoeff();
  show_surfaces(film);
  find_hottest();
  average(film);
  average_walls();
}

// On a wall without heat the temperature has no slope and follows from a parabola through the two layers beside it.
// Elsewhere heat passes half a layer.
void FilmHeat::Impl::show_surfaces(const CarryingFilm& film) {
  const Grid& grid = flow.model().grid;
  const int n = thermal.layers;
  const Layering& across = layering_of(static_cast<std::size_t>(n));
  for (auto* field : {&shown.middle, &shown.shell, &shown.journal, &shown.hottest}) field->resize(grid.size());
  for (int node = 0; node < grid.size(); ++node) {
    const auto column = end_of_step.film.segment(node * n, n);
    const auto without_slope = [&](int beside, int next) {
      const double a = 0.5 * across.width(static_cast<std::size_t>(beside)),
                   b = a + std::abs(across.middle(static_cast<std::size_t>(next)) -
                                    across.middle(static_cast<std::size_t>(beside)));
      return column[beside] + (column[beside] - column[next]) * a * a / (b * b - a * a);
    };
    shown.middle[node] = mean_across(column, across);
    shown.hottest[node] = column.maxCoeff();
    shown.shell[node] = n > 1 ? without_slope(0, 1) : column[0];
    shown.journal[node] = n > 1 ? without_slope(n - 1, n - 2) : column[0];
    if (conducts(thermal.journal)) shown.journal[node] = end_of_step.journal;
    if (!conducts(thermal.shell)) continue;
    const double per_area = equations.into_shell(film, end_of_step, node) / flow.area(node);
    shown.shell[node] = end_of_step.shell[node / grid.n_z] + per_area * equations.ring().inside;
  }
}

void FilmHeat::Impl::find_hottest() {
  const GridGeometry& at = flow.geometry();
  const int n_z = flow.model().grid.n_z;
  observed.T_max = shown.hottest.maxCoeff(), observed.T_shell_max = shown.shell.maxCoeff();
  const Eigen::Index hottest = first_of_hottest(shown.hottest), hottest_in_shell = first_of_hottest(shown.shell);
  observed.T_max_phi = at.phi[hottest / n_z], observed.T_max_z = at.z[hottest % n_z];
  observed.T_shell_max_phi = at.phi[hottest_in_shell / n_z];
}

void FilmHeat::Impl::average(const CarryingFilm& film) {
  double area = 0, oil = 0, out = 0;
  for (int node = 0; node < flow.size(); ++node) {
    const double a = flow.area(node), volume = a * std::max(flow.nodes()[node].content, 0.0) * flow.oil_gap(node);
    area += a, oil += volume;
    observed.T_shell_mean += a * shown.shell[node];
    observed.T_journal += a * shown.journal[node];
    observed.T_film_mean += volume * shown.middle[node];
    const double leaves = std::max(flow.outflow(node), 0.0);
    out += leaves;
    for (int l = 0; l < thermal.layers; ++l)
      observed.T_side += leaves * film.flows.leaving_fraction(node, l) * end_of_step.film[node * thermal.layers + l];
  }
  observed.T_shell_mean /= area, observed.T_journal /= area;
  observed.T_film_mean = oil > 0 ? observed.T_film_mean / oil : std::numeric_limits<double>::quiet_NaN();
  observed.leaving = out;
  observed.T_side = out > 0 ? observed.T_side / out : std::numeric_limits<double>::quiet_NaN();
}

TemperatureFields FilmHeat::fields() const {
  (void)impl_->look();
  return impl_->shown;
}
const HeatObservables& FilmHeat::observables() const { return impl_->look(); }

FilmObservables FilmHeat::film(const SurfaceMotion& motion, const Eigen::Vector2d& e, const Eigen::VectorXd& u,
                               const Eigen::Vector2d& tilt) const {
  return observe_evaluated(impl_->flow, impl_->wrench, motion, e, u, tilt);
}

void FilmHeat::persist(Archive& archive) {
  archive.io("T_film", impl_->state.film);
  archive.io("T_shell", impl_->state.shell);
  archive.io("T_journal", impl_->state.journal);
  archive.io("wall_heat", impl_->state.wall_heat);
  if (conduction_of(impl_->thermal.journal) != nullptr) archive.io("journal_heat", impl_->state.journal_heat);
  archive.io("T_supplies", impl_->state.supplies);
  if (impl_->state.outside.size() > 0) archive.io("T_outside", impl_->state.outside);
  if (impl_->shears_layers()) archive.io("thinning", impl_->state.thinning);
  for (std::size_t k = 0; k < impl_->state.ends.size(); ++k) {
    EndOil& end = impl_->state.ends[k];
    const Archive::Group group(archive, "end_" + std::to_string(k));
    archive.io("rise", end.rise), archive.io("carried", end.carried), archive.io("drawn_again", end.drawn_again);
  }
  if (!impl_->has_fixed_walls()) return;
  impl_->equations.mean().persist(archive);
  impl_->fixed_walls.persist(archive);
}

}  // namespace hersey::film
