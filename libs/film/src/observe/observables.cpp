#include "hersey/film/observables.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "balance/cavity.h"
#include "balance/flow_balance.h"
#include "gap/thinnest_film.h"
#include "hersey/core/contract.h"
#include "hersey/core/two_pi.h"
#include "observe/film_power.h"
#include "observe/film_wrench.h"
#include "observe/observe_evaluated.h"

namespace hersey::film {
namespace {

/// A peak of a field on the grid [field's unit, rad, m].
struct Peak {
  double value = 0, phi = 0, z = 0;
};

/// Vertex of the parabola through values at -before, 0 and after: its position, and its height above the middle value.
/// It is limited to half-way to the neighbours.
struct Vertex {
  double offset = 0, rise = 0;
};

Vertex vertex(double left, double middle, double right, double before, double after) {
  const double down = (middle - left) / before, up = (right - middle) / after;
  const double curvature = (up - down) / (0.5 * (before + after));
  if (curvature == 0) return {};
  const double slope = (down * after + up * before) / (before + after);
  const double offset = std::clamp(-slope / curvature, -0.5 * before, 0.5 * after);
  return {offset, offset * (slope + 0.5 * offset * curvature)};
}

/// Peaks of fields between the nodes of one grid.
class PeakFinder {
 public:
  PeakFinder(const FilmModel& model, const GridGeometry& geometry) : grid_(model.grid), at_(geometry) {}

  /// Returns the field's largest value, by parabolas where it is smooth from the node to all its neighbours; else the
  /// node's own. @param is_smooth true if the field has no kink between two nodes
  template <class IsSmooth>
  [[nodiscard]] Peak largest(const Eigen::VectorXd& field, IsSmooth&& is_smooth) const {
    int node = 0;
    field.maxCoeff(&node);
    const int i = node / grid_.n_z, j = node % grid_.n_z;
    bool smooth = true;
    for (const int line : {grid_.next(i), grid_.before(i)})
      smooth = smooth && (line < 0 || is_smooth(node, grid_.index(line, j)));
    if (j > 0) smooth = smooth && is_smooth(node, node - 1);
    if (j + 1 < grid_.n_z) smooth = smooth && is_smooth(node, node + 1);
    return smooth ? refine(field, i, j) : Peak{field[node], at_.phi[i], at_.z[j]};
  }

 private:
  template <class Value>
  [[nodiscard]] Vertex around(int i, Value&& value) const {
    const int before = grid_.before(i), after = grid_.next(i);
    if (before < 0 || after < 0) return {};
    return vertex(value(before), value(i), value(after), at_.dx[before], at_.dx[i]);
  }

  /// Returns the maximum next to node (i, j) by parabolas, along phi always and along z inside the width. Edges count:
  /// there only phi is interpolated.
  [[nodiscard]] Peak refine(const Eigen::VectorXd& field, int i, int j) const {
    const auto at = [&](int a, int b) { return field[grid_.index(a, b)]; };
    const Vertex along = around(i, [&](int k) { return at(k, j); });
    const bool inside = j > 0 && j < grid_.n_z - 1;
    const Vertex across = inside ? vertex(at(i, j - 1), at(i, j), at(i, j + 1), at_.dz[j - 1], at_.dz[j]) : Vertex{};
    const double phi = at_.reported_angle(at_.phi[i] + along.offset / at_.R);
    return {at(i, j) + along.rise + across.rise, phi, at_.z[j] + across.offset};
  }

  const Grid& grid_;
  const GridGeometry& at_;
};

/// True if the pressure has no kink between a node and another: neither an edge nor a supply line or feature prescribes
/// the pressure of one of them, and no border of a pocket lies between.
bool is_smooth(const FlowBalance& balance, int a, int b) {
  if (balance.is_on_prescribed_edge(a)) return false;
  if (balance.balance_weight(a) < 1 || balance.balance_weight(b) < 1) return false;
  const Eigen::VectorXd& depth = balance.relief().depth();
  return depth.size() == 0 || std::abs(depth[a] - depth[b]) <= 1e-9 * balance.model().c;
}

/// Returns the largest pressure. A supply line has its own pressure along its whole length, between nodes too.
Peak largest_pressure_of(const FlowBalance& balance, const Eigen::VectorXd& p, double phi_supply) {
  const FilmModel& model = balance.model();
  const Peak peak =
      PeakFinder(model, balance.geometry()).largest(p, [&](int a, int b) { return is_smooth(balance, a, b); });
  if (model.supply.kind == SupplyKind::none || model.supply.pressure <= peak.value) return peak;
  return {model.supply.pressure, phi_supply - two_pi * std::floor(phi_supply / two_pi), 0};
}

/// Pressures in the features that are fed, and before their restrictors.
void observe_features(const FlowBalance& balance, const SurfaceMotion& motion, FilmObservables& o) {
  const FilmModel& model = balance.model();
  const auto count = static_cast<Eigen::Index>(model.features.size());
  o.pressure_features.setConstant(count, std::numeric_limits<double>::quiet_NaN());
  o.pressure_supplies = o.pressure_features;
  for (Eigen::Index f = 0; f < count; ++f) {
    const SurfaceFeature& feature = model.features[static_cast<std::size_t>(f)];
    if (!feature.is_fed) continue;
    const double u = balance.feature_unknown(static_cast<int>(f));
    o.pressure_features[f] = model.p_cav + (cavitation_law(model).has_tension() ? u : std::max(u, 0.0));
    if (!feature.restrictor || feature.restrictor->has_supply_pressure())
      o.pressure_supplies[f] = motion.feature_pressure.size() == 0 ? feature.pressure : motion.feature_pressure[f];
    if (feature.may_lack_oil) o.pressure_supplies[f] = std::max(o.pressure_supplies[f], model.p_cav);
  }
}

/// Sums the flows over the boundaries, storage and volume (film.55).
void observe_oil(const FlowBalance& balance, const SurfaceMotion& motion, FilmObservables& o) {
  const FilmModel& model = balance.model();
  const Grid& grid = model.grid;
  double cavitated = 0, total = 0, outflow = 0, gross = 0;
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      const int k = grid.index(i, j);
      const Node& node = balance.nodes()[k];
      const double area = balance.area(k);
      o.storage_rate += balance.storage(k);
      o.oil_volume += area * node.content * balance.oil_gap(k);
      total += area;
      cavitated += area * balance.cavitated_fraction(k);
      balance.add_flow_over_edge(o, k, balance.acting_outflow(k));
      outflow += balance.outflow(k);
      gross += std::abs(balance.outflow(k)) + std::abs(balance.storage(k));
      o.flow_supply += balance.supply(k);
      if (const int feature = balance.feature_at(k); feature >= 0) o.flow_features[feature] += balance.supply(k);
    }
  }
  o.cavitated_share = cavitated / total;
  double scale = std::max({std::abs(o.flow_left), std::abs(o.flow_right), std::abs(o.flow_first), std::abs(o.flow_last),
                           std::abs(o.flow_supply), std::abs(o.storage_rate), sliding_flow(model, motion, model.c)});
  if (o.flow_features.size() > 0) scale = std::max(scale, o.flow_features.cwiseAbs().maxCoeff());
  // Where flows cancel, as in a pure squeeze, the inflows and outflows of the nodes set the scale of round-off.
  if (!cavitation_law(model).loses_oil()) scale = std::max(scale, gross);
  const double error = o.flow_supply - outflow - o.storage_rate;
  o.mass_balance_error = scale > 0 ? std::abs(error) / scale : 0;
}

/// What layers of oil on the journal leave empty and what they leave behind (film.66).
void observe_layers(const FlowBalance& balance, FilmObservables& o) {
  const Grid& grid = balance.model().grid;
  double total = 0;
  for (int k = 0; k < balance.size(); ++k) total += balance.area(k);
  for (int i = 0; i < grid.n_phi; ++i) {
    for (const int edge : {0, grid.n_z - 1}) {
      const int node = grid.index(i, edge), inwards = edge == 0 ? 1 : -1;
      if (!balance.brings_layer(node)) continue;
      o.flow_scraped += balance.layer_flow(node) + balance.outflow(node);
      for (int j = edge; j >= 0 && j < grid.n_z; j += inwards) {
        const double cavitated = balance.cavitated_fraction(grid.index(i, j));
        if (cavitated == 0) break;
        o.starved_share += balance.area(grid.index(i, j)) * cavitated / total;
      }
    }
  }
}

/// Regimes of the flow by the numbers at the nodes, each with the area of its control volume (turbulence.15).
void observe_regimes(const FlowBalance& balance, FilmObservables& o) {
  const FilmModel& model = balance.model();
  const Turbulence& turbulence = model.turbulence;
  Turbulence by_taylor = turbulence;
  by_taylor.number = TransitionNumber::taylor;
  double total = 0;
  o.laminar_share = 0;
  for (int k = 0; k < balance.size(); ++k) {
    const Node& node = balance.nodes()[k];
    const double reynolds = reynolds_number(model, node, balance.slip(k % model.grid.n_z).norm());
    const double area = balance.area(k), number = transition_number(turbulence, reynolds, node.h, model.R);
    total += area;
    (number <= turbulence.onset ? o.laminar_share
     : number < turbulence.full ? o.transition_share
                                : o.turbulent_share) += area;
    o.reynolds_max = std::max(o.reynolds_max, reynolds);
    o.taylor_max = std::max(o.taylor_max, transition_number(by_taylor, reynolds, node.h, model.R));
  }
  o.laminar_share /= total, o.transition_share /= total, o.turbulent_share /= total;
  if (!std::holds_alternative<Cylinder>(model.surface)) o.taylor_max = std::numeric_limits<double>::quiet_NaN();
}

/// Between nodes as h_min and p_max of the whole film are.
void observe_patches(const FlowBalance& balance, const FilmFields& fields, double phi_journal, FilmObservables& o) {
  const Grid& grid = balance.model().grid;
  const PeakFinder peaks(balance.model(), balance.geometry());
  Eigen::VectorXd within;
  o.patches.resize(grid.patches.size());
  for (std::size_t p = 0; p < grid.patches.size(); ++p) {
    const int first = grid.index(grid.patches[p], 0), end = grid.index(end_of_patch(grid, p), 0);
    PatchObservables& patch = o.patches[p];
    const auto largest = [&](const Eigen::VectorXd& field) {
      within.setConstant(field.size(), -std::numeric_limits<double>::infinity());
      within.segment(first, end - first) = field.segment(first, end - first);
      return peaks.largest(within, [&](int a, int b) { return is_smooth(balance, a, b); }).value;
    };
    patch.h_min = thinnest_film(balance.model(), balance.geometry(), fields.h, phi_journal, static_cast<int>(p)).value;
    patch.p_max = largest(fields.p);
    for (int k = first; k < end; ++k) balance.add_flow_over_edge(patch, k, balance.acting_outflow(k));
  }
}

/// The journal is subject to the negative wrench on the shell. Its moment about its own axis through e along (t_x, t_y,
/// 1) is -M_z - t . M + (e x F)_z.
double torque_on_journal(const Vector6& on_shell, const Eigen::Vector2d& e, const Eigen::Vector2d& tilt) {
  return -on_shell[2] - tilt.dot(on_shell.head<2>()) + e.x() * on_shell[4] - e.y() * on_shell[3];
}

void observe_forces(const FlowBalance& balance, const FilmWrench& wrench, const Eigen::Vector2d& e,
                    const Eigen::Vector2d& tilt, FilmObservables& o) {
  o.force_pressure = wrench.pressure().tail<3>();
  o.force_shear = wrench.shear().tail<3>();
  o.force_asperity = wrench.asperity().tail<3>();
  const Vector6& on_shell = o.wrench_on_shell = wrench.total();
  o.torque_shell = on_shell[2];
  o.torque_journal = torque_on_journal(on_shell, e, tilt);
  o.torque_journal_other_shear = torque_on_journal(on_shell + wrench.more_of_other_shear(balance), e, tilt);
}

FilmFields fields_of_size(Eigen::Index n, bool is_turbulent) {
  FilmFields fields;
  for (auto* field : {&fields.p, &fields.theta, &fields.density, &fields.h, &fields.w, &fields.p_asperity})
    field->resize(n);
  if (is_turbulent) fields.reynolds.resize(n);
  return fields;
}

void show(const Node& node, Eigen::Index at, FilmFields& fields) {
  fields.p[at] = node.wall;
  fields.theta[at] = node.theta;
  fields.density[at] = node.density;
  fields.h[at] = node.h;
  fields.w[at] = node.w;
  fields.p_asperity[at] = node.asperity;
  if (fields.reynolds.size() != 0) fields.reynolds[at] = node.reynolds;
}

FilmFields fields_of(const std::vector<Node>& nodes, bool is_turbulent) {
  const auto n = static_cast<Eigen::Index>(nodes.size());
  FilmFields fields = fields_of_size(n, is_turbulent);
  for (Eigen::Index i = 0; i < n; ++i) show(nodes[i], i, fields);
  return fields;
}

}  // namespace

FilmFields film_fields(const FilmModel& model, const SurfaceMotion& motion, const Eigen::VectorXd& u,
                       const LayeredViscosity& viscosity) {
  const NodeLaw law(model);
  const Grid& grid = model.grid;
  const bool is_turbulent = model.turbulence.counts();
  FilmFields fields = fields_of_size(u.size(), is_turbulent);
  Node node;
  for (int i = 0; i < u.size(); ++i) {
    Sliding sliding;
    if (is_turbulent) {
      const double along = stretch(model.surface, model.R, model.L * grid.z_over_L(i % grid.n_z));
      sliding = sliding_of(along * (motion.u_journal - motion.u_shell), motion.w_journal - motion.w_shell);
    }
    if (is_turbulent && viscosity.fluidity.size() != 0)
      law.evaluate(motion.g[i], u[i], i, sliding, motion.roughness_at(i), node_viscosity(viscosity, i), node);
    else
      law.evaluate(motion.g[i], u[i], i, sliding, motion.roughness_at(i), node);
    show(node, i, fields);
  }
  return fields;
}

FilmFields fields_of(const FlowBalance& balance) {
  return fields_of(balance.nodes(), balance.model().turbulence.counts());
}

Eigen::VectorXd mean_depth(const FilmModel& model, double phi_journal) {
  const GridGeometry geometry(model);
  PocketRelief relief(model, geometry);
  relief.set_rotation(phi_journal, phi_journal, 0, 0);
  Eigen::VectorXd depth = Eigen::VectorXd::Zero(model.grid.size());
  for (const CoveredDepth& covered : relief.covered()) depth[covered.node] += covered.fraction * covered.depth;
  return depth;
}

FilmObservables observe_film(const FilmModel& model, const SurfaceMotion& motion, const FilmHistory& history,
                             const Eigen::Vector2d& e, const Eigen::VectorXd& u, const Eigen::Vector2d& tilt) {
  FlowBalance balance(model);
  const FilmDomain domain = balance.evaluate(motion, history, u);
  HERSEY_REQUIRE(domain.is_inside(), text(model, domain));
  FilmWrench wrench(with_torque(model));
  wrench.evaluate(balance, motion, false);
  return observe_evaluated(balance, wrench, motion, e, u, tilt);
}

FilmModel with_torque(FilmModel model) {
  if (model.shear_force == ShearForce::none) model.shear_force = ShearForce::torque_only;
  return model;
}

FilmObservables observe_evaluated(const FlowBalance& balance, const FilmWrench& wrench, const SurfaceMotion& motion,
                                  const Eigen::Vector2d& e, const Eigen::VectorXd& u, const Eigen::Vector2d& tilt) {
  const FilmModel& model = balance.model();
  const FilmFields fields = fields_of(balance.nodes(), false);

  FilmObservables o;
  observe_features(balance, motion, o);
  o.flow_features.setZero(static_cast<Eigen::Index>(model.features.size()));
  const Thinnest thinnest = thinnest_film(model, balance.geometry(), fields.h, motion.phi_journal);
  const Peak peak = largest_pressure_of(balance, fields.p, motion.phi_supply);
  o.h_min = thinnest.value, o.h_min_phi = thinnest.phi, o.h_min_z = thinnest.z;
  o.h_min_centre = thinnest.in_the_middle;
  o.h_min_features = thinnest.in_features;
  o.p_max = peak.value, o.p_max_phi = peak.phi, o.p_max_z = peak.z;
  o.p_max_node = fields.p.maxCoeff();
  observe_forces(balance, wrench, e, tilt, o);
  o.normal_forces = wrench.normal().value;
  observe_oil(balance, motion, o);
  observe_layers(balance, o);
  observe_regimes(balance, o);
  observe_patches(balance, fields, motion.phi_journal, o);
  const Cavity cavity = widest_cavity(balance, u, motion.u_shell + motion.u_journal < 0);
  o.rupture_angle = cavity.rupture, o.reformation_angle = cavity.reformation;
  o.sliding_speed = std::hypot(motion.u_journal - motion.u_shell, motion.w_journal - motion.w_shell);
  add_powers(balance, motion, wrench, o);
  return o;
}

double sliding_flow(const FilmModel& model, const SurfaceMotion& motion, double c) {
  const double around = std::max(std::abs(motion.u_journal), std::abs(motion.u_shell)) * model.L;
  const double length = model.R * mean_step(model.grid) * model.grid.n_phi;
  return c * std::max(around, std::max(std::abs(motion.w_journal), std::abs(motion.w_shell)) * length);
}

StepOilBalance oil_at_start(const FilmModel& model, const SurfaceMotion& motion, const FilmHistory& history,
                            const Eigen::VectorXd& u) {
  FlowBalance balance(model);
  const FilmDomain domain = balance.evaluate(motion, history, u);
  HERSEY_REQUIRE(domain.is_inside(), text(model, domain));
  StepOilBalance oil;
  balance.initialise_oil_balance(oil);
  return oil;
}

}  // namespace hersey::film
