#include "flow_balance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hersey/core/contract.h"

namespace hersey::film {
namespace {

// Beside the supply line its condition is tied to the film by this many conductance scales: enough to fill the gap at
// any speed, while the line's way from node to node stays smooth (film.13).
constexpr double supply_stiffness = 1000;

void check(const FilmModel& m) {
  HERSEY_REQUIRE(m.R > 0 && m.L > 0 && m.c > 0, "a bearing has radius, width and clearance");
  HERSEY_REQUIRE(m.lubricant.mu0 > 0, "viscosity is positive");
  HERSEY_REQUIRE(m.compliance >= 0, "compliance is not negative");
  HERSEY_REQUIRE(m.p_edge_left >= m.p_cav && m.p_edge_right >= m.p_cav, "edges lie at or above p_cav");
  const auto is_share = [](double x) { return 0 <= x && x <= 1; };
  HERSEY_REQUIRE(is_share(m.ambient_fill_left) && is_share(m.ambient_fill_right), "fill lies between 0 and 1");
  HERSEY_REQUIRE(m.supply.kind == SupplyKind::none || m.supply.pressure >= m.p_cav, "supply lies at or above p_cav");
  HERSEY_REQUIRE(m.asperities.model == AsperityModel::none || m.asperities.sigma > 0, "roughness is positive");
}

}  // namespace

FlowBalance::FlowBalance(const FilmModel& model) : model_(model), law_(model_), geometry_(model_) {
  check(model_);
  const Grid& grid = model_.grid;
  unit_conductance_ = unit_conductance(geometry_);
  D0_ = model_.c * model_.c * model_.c / (12 * model_.lubricant.mu0) * unit_conductance_;
  area_.resize(grid.size());
  for (int k = 0; k < grid.size(); ++k) area_[k] = geometry_.area(k / grid.n_z, k % grid.n_z);
  lay_faces();
  lay_pattern();
  const int n = grid.size();
  const auto ambient_unknown_at = [&](int j) {
    const double fill = ambient_fill(model_, j);
    return fill > 0 ? (fill - 1) * fill_scale(model_) : -std::numeric_limits<double>::infinity();
  };
  ambient_left_ = ambient_unknown_at(0), ambient_right_ = ambient_unknown_at(grid.n_z - 1);
  nodes_.resize(n);
  if (model_.roughness.counts()) {
    rough_law_.emplace(model_.roughness);
    rough_.resize(n);
    mean_start_.resize(n);
  }
  flows_.resize(faces_.size());
  for (auto* field : {&residual_, &balance_, &throughput_, &g_rate_, &w_start_, &u_}) field->setZero(n);
  content_start_.setOnes(n);
  held_index_.assign(n, -1);
}

void FlowBalance::lay_faces() {
  const Grid& grid = model_.grid;
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      const int next = grid.index((i + 1) % grid.n_phi, j);
      faces_.push_back({grid.index(i, j), next, geometry_.width_z[j], geometry_.dx[i], {}});
    }
  }
  first_axial_face_ = faces_.size();
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j + 1 < grid.n_z; ++j) {
      faces_.push_back({grid.index(i, j), grid.index(i, j + 1), geometry_.width_phi[i], geometry_.dz[j], {}});
    }
  }
}

void FlowBalance::lay_pattern() {
  const Grid& grid = model_.grid;
  const int n = size(), n_z = grid.n_z;
  const auto balanced = [&](int node) { return !edge_row(node % n_z); };
  column_start_.reserve(static_cast<std::size_t>(n) + 1);
  row_index_.reserve(5 * static_cast<std::size_t>(n));
  column_start_.assign(1, 0);
  for (int column = 0; column < n; ++column) {
    const int i = column / n_z, j = column % n_z;
    std::array<int, 5> rows{grid.index((i + grid.n_phi - 1) % grid.n_phi, j), j > 0 ? column - 1 : column, column,
                            j + 1 < n_z ? column + 1 : column, grid.index((i + 1) % grid.n_phi, j)};
    std::sort(rows.begin(), rows.end());
    const auto end = std::unique(rows.begin(), rows.end());
    for (auto row = rows.begin(); row != end; ++row) {
      if (*row == column || balanced(*row)) row_index_.push_back(*row);
    }
    column_start_.push_back(static_cast<int>(row_index_.size()));
  }
  const int nowhere = static_cast<int>(row_index_.size());
  const auto find = [&](int row, int column) {
    const auto begin = row_index_.begin() + column_start_[column];
    return static_cast<int>(std::find(begin, row_index_.end(), row) - row_index_.begin());
  };
  const auto slot = [&](int row, int column) { return balanced(row) ? find(row, column) : nowhere; };
  for (Face& f : faces_) f.slots = {slot(f.a, f.a), slot(f.a, f.b), slot(f.b, f.a), slot(f.b, f.b)};
  diagonal_slot_.reserve(static_cast<std::size_t>(n));
  for (int node = 0; node < n; ++node) diagonal_slot_.push_back(find(node, node));
  row_slots_.resize(static_cast<std::size_t>(n));
  for (int row = 0; row < n; ++row) {
    if (!balanced(row)) continue;
    const int i = row / n_z, j = row % n_z;
    row_slots_[row] = {find(row, grid.index((i + grid.n_phi - 1) % grid.n_phi, j)),
                       j > 0 ? find(row, row - 1) : nowhere, diagonal_slot_[row],
                       j + 1 < n_z ? find(row, row + 1) : nowhere, find(row, grid.index((i + 1) % grid.n_phi, j))};
  }
  values_.resize(row_index_.size() + 1);
}

bool FlowBalance::edge_row(int j) const {
  return model_.edges == EdgeKind::pressure && (j == 0 || j == model_.grid.n_z - 1) && !open_row(j);
}

double FlowBalance::edge_unknown(int j) const {
  return (j == 0 ? model_.p_edge_left : model_.p_edge_right) - model_.p_cav;
}

const FlowBalance::HeldNode* FlowBalance::held_at(int node) const {
  const int index = held_index_[node];
  return index < 0 ? nullptr : &held_[index];
}

double FlowBalance::supply_share(int node) const {
  const HeldNode* held = held_at(node);
  return held == nullptr ? 0 : held->chi;
}

double FlowBalance::supply_unknown(int node) const {
  const HeldNode* held = held_at(node);
  return held == nullptr ? 0 : held->u;
}

double FlowBalance::supply_conductance(int node) const {
  const HeldNode* held = held_at(node);
  return held == nullptr ? 0 : tie(*held).k;
}

int FlowBalance::feature_at(int node) const {
  const HeldNode* held = held_at(node);
  return held == nullptr ? -1 : held->feature;
}

// The line's is a constant, a feature's the film's own conductance: what lies between node and edge is film (film.25).
FlowBalance::Tie FlowBalance::tie(const HeldNode& held) const {
  if (held.feature < 0) return {supply_stiffness * D0_, 0, 0};
  const Node& node = nodes_[held.node];
  double k = unit_conductance_ * node.density * node.h * node.h * node.h * node.fluidity / 12, by_h = 3 * k / node.h;
  if (!rough_.empty()) {
    const RoughGap& rough = rough_[held.node];
    const double factor = 0.5 * (rough.pressure[0] + rough.pressure[1]);
    by_h = by_h * factor + 0.5 * k * (rough.pressure_h[0] + rough.pressure_h[1]);
    k *= factor;
  }
  return {k, by_h * node.h_u + k * (node.fluidity_u / node.fluidity + node.density_u / node.density), by_h * node.h_g};
}

// Edges win where they meet a line or a feature. One in air is filled there, but its pressure cannot rise.
void FlowBalance::hold(const HeldNode& held) {
  const int j = held.node % model_.grid.n_z;
  if (held.chi == 0 || edge_row(j)) return;
  int& index = held_index_[held.node];
  if (index >= 0 && held_[index].chi >= held.chi) return;
  if (index < 0) {
    index = static_cast<int>(held_.size());
    held_.emplace_back();
  }
  held_[index] = held;
  if (open_row(j)) held_[index].u = 0;
}

void FlowBalance::hold_line(double phi) {
  const int n_phi = model_.grid.n_phi;
  const auto [i, t] = geometry_.place_of(phi);
  const double to_next = geometry_.dx[i] / model_.R, u = model_.supply.pressure - model_.p_cav;
  // Fourth power of the hat function: each node lets go of the line over a good part of a cell.
  const auto column = [&](int index, double hat, double hat_phi) {
    for (int j = 0; j < model_.grid.n_z; ++j) {
      hold({.node = model_.grid.index(index, j),
            .chi = std::pow(hat, 4),
            .chi_line = 4 * std::pow(hat, 3) * hat_phi,
            .u = u});
    }
  };
  column(i, 1 - t, -1 / to_next);
  column((i + 1) % n_phi, t, 1 / to_next);
}

void FlowBalance::find_supply(const SurfaceMotion& motion) {
  for (const HeldNode& held : held_) held_index_[held.node] = -1;
  held_.clear();
  if (model_.supply.kind != SupplyKind::none) hold_line(motion.phi_supply);
  for (std::size_t f = 0; f < model_.features.size(); ++f) {
    const SurfaceFeature& feature = model_.features[f];
    if (!feature.is_fed) continue;
    const auto index = static_cast<Eigen::Index>(f);
    const double pressure = motion.feature_pressure.size() == 0 ? feature.pressure : motion.feature_pressure[index];
    covered_.clear();
    cover(model_, geometry_, feature, motion.phi_journal, covered_);
    for (const CoveredNode& node : covered_) {
      hold({.node = node.node,
            .chi = node.share,
            .chi_journal = node.share_phi,
            .feature = static_cast<int>(f),
            .u = std::max(0.0, pressure - model_.p_cav)});
    }
  }
}

void FlowBalance::take_history(const FilmHistory& history) {
  HERSEY_REQUIRE(history.dt >= 0, "time runs forwards");
  dt_ = history.dt;
  if (dt_ == 0) return;
  liner_rests_ = history.w.size() == 0;
  HERSEY_REQUIRE(history.theta.size() == size() && (liner_rests_ || history.w.size() == size()),
                 "history of shape (grid.size())");
  content_start_.setOnes();
  if (model_.cavitation == Cavitation::mass_conserving) content_start_ = history.theta;
  if (history.density.size() != 0) {
    HERSEY_REQUIRE(history.density.size() == size(), "density at the start of shape (grid.size()) or empty");
    content_start_.array() *= history.density.array();
  }
  if (!liner_rests_) w_start_ = history.w;
}

FilmDomain FlowBalance::evaluate(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u) {
  const int n = size();
  HERSEY_REQUIRE(motion.g.size() == n && motion.g_rate.size() == n, "gap and rate of shape (grid.size())");
  HERSEY_REQUIRE(u.size() == n, "u of shape (grid.size())");
  take_history(history);
  const auto features = static_cast<Eigen::Index>(model_.features.size());
  HERSEY_REQUIRE(motion.feature_pressure.size() == 0 || motion.feature_pressure.size() == features,
                 "a pressure for each feature or none");
  find_supply(motion);
  g_rate_ = motion.g_rate;
  u_ = u;
  speed_phi_ = 0.5 * (motion.u_shell + motion.u_journal);
  speed_z_ = 0.5 * (motion.w_shell + motion.w_journal);
  half_slip_phi_ = 0.5 * (motion.u_shell - motion.u_journal);
  half_slip_z_ = 0.5 * (motion.w_shell - motion.w_journal);
  if (const FilmDomain domain = evaluate_nodes(motion, u); !domain.is_inside()) return domain;
  for (int i = 0; i < n; ++i) {
    balance_[i] = storage(i);
    throughput_[i] = std::max(std::abs(balance_[i]), std::abs(storage_g_rate(i) * g_rate_[i]));
  }
  for (std::size_t f = 0; f < faces_.size(); ++f) add_face(f);
  replace_boundary_rows();
  // A film without oil has no throughput to measure by: a thousandth of what its surfaces would carry in a full gap.
  const double carried =
      model_.c * std::max(std::abs(speed_phi_) * geometry_.mean_dz, std::abs(speed_z_) * geometry_.mean_dx);
  largest_throughput_ = std::max(throughput_.maxCoeff(), 1e-3 * carried);
  return {};
}

FilmDomain FlowBalance::evaluate_nodes(const SurfaceMotion& motion, const Eigen::VectorXd& u) {
  if (const FilmDomain domain = judge_unknowns(model_, u); !domain.is_inside()) return domain;
  for (int i = 0; i < size(); ++i) {
    nodes_[i] = law_.state(motion.g[i], u[i], i % model_.grid.n_z);
    if (!std::isfinite(nodes_[i].h) || !std::isfinite(motion.g_rate[i])) return {FilmDomain::Trouble::not_finite, i};
    if (nodes_[i].h <= 0) return {FilmDomain::Trouble::closed, i};
    if (liner_rests_) w_start_[i] = nodes_[i].w;
    if (!rough_law_) continue;
    rough_[i] = rough_law_->state(nodes_[i].h);
    if (dt_ > 0) mean_start_[i] = rough_law_->mean(motion.g[i] - dt_ * motion.g_rate[i] + w_start_[i]);
  }
  return {};
}

void FlowBalance::add_face(std::size_t f) {
  if (!rough_.empty()) return add_rough_face(f);
  const Face& face = faces_[f];
  const Node &a = nodes_[face.a], &b = nodes_[face.b];
  const double speed = entrainment(f);

  // Flow (film.9): q = K (p_a - p_b) + rho U h theta_upwind, with K = rho h^3/(12 mu) width/length.
  const double h = 0.5 * (a.h + b.h), fluidity = 0.5 * (a.fluidity + b.fluidity);
  const double theta = speed >= 0 ? a.theta : b.theta;
  const double unit = h * h * face.width / (12 * face.length), drop = a.p - b.p;
  const double density = 0.5 * (a.density + b.density);
  FaceFlow& flow = flows_[f];
  flow.density = density;
  flow.K = density * unit * h * fluidity;
  flow.couette = density * speed * h * face.width;
  flow.q_h_a = flow.q_h_b = 0.5 * density * (3 * unit * fluidity * drop + speed * face.width * theta);
  flow.q_fluidity = density * unit * h * drop;
  flow.q_density = unit * h * fluidity * drop + speed * h * face.width * theta;

  add_flow(f, theta);
}

double FlowBalance::carrying_area(std::size_t f, double speed, double half_slip) const {
  const Face& face = faces_[f];
  const Node &a = nodes_[face.a], &b = nodes_[face.b];
  if (rough_.empty()) return 0.5 * (a.h + b.h) * speed * face.width;
  const RoughGap &rough_a = rough_[face.a], &rough_b = rough_[face.b];
  const int k = axial(f) ? 1 : 0;
  return 0.5 * ((rough_a.mean + rough_b.mean) * speed + (rough_a.drag[k] + rough_b.drag[k]) * half_slip) * face.width;
}

// Between rough surfaces (film.32): factors are means of those at both nodes.
void FlowBalance::add_rough_face(std::size_t f) {
  const Face& face = faces_[f];
  const Node &a = nodes_[face.a], &b = nodes_[face.b];
  const RoughGap &rough_a = rough_[face.a], &rough_b = rough_[face.b];
  const int k = axial(f) ? 1 : 0;
  const double speed = entrainment(f), half_slip = axial(f) ? half_slip_z_ : half_slip_phi_;
  const double h = 0.5 * (a.h + b.h), fluidity = 0.5 * (a.fluidity + b.fluidity);
  const double density = 0.5 * (a.density + b.density), drop = a.p - b.p;
  const double cube = h * h * h * face.width / (12 * face.length);
  const double factor = 0.5 * (rough_a.pressure[k] + rough_b.pressure[k]);
  const double carried = carrying_area(f, speed, half_slip), theta = carried >= 0 ? a.theta : b.theta;
  FaceFlow& flow = flows_[f];
  flow.density = density;
  flow.K = density * factor * cube * fluidity;
  flow.couette = density * carried;
  flow.q_fluidity = density * factor * cube * drop;
  flow.q_density = factor * cube * fluidity * drop + carried * theta;
  const auto by_h = [&](const RoughGap& rough) {
    const double pressure_flow = (3 * factor / h + rough.pressure_h[k]) * cube * fluidity * drop;
    return 0.5 * density * (pressure_flow + (rough.mean_h * speed + rough.drag_h[k] * half_slip) * face.width * theta);
  };
  flow.q_h_a = by_h(rough_a), flow.q_h_b = by_h(rough_b);
  add_flow(f, theta);
}

void FlowBalance::add_flow(std::size_t f, double theta) {
  const Face& face = faces_[f];
  const FaceFlow& flow = flows_[f];
  const double poiseuille = flow.K * (nodes_[face.a].p - nodes_[face.b].p), entrained = flow.couette * theta;
  balance_[face.a] += poiseuille + entrained;
  balance_[face.b] -= poiseuille + entrained;
  const double passing = 0.5 * (std::abs(poiseuille) + std::abs(entrained));
  throughput_[face.a] += passing;
  throughput_[face.b] += passing;
}

// Storage (film.8): m_n g_rate + ((m - m_n) h + m_n (w - w_n))/dt per area with the content m = rho theta; in a steady
// film m g_rate. Between rough surfaces the mean gap h_T takes the place of h (film.33): (m h_T - m_n h_T*)/dt, h_T* at
// the gap from which the rate leads to the present one.
double FlowBalance::storage(int i) const {
  const Node& node = nodes_[i];
  const double a = area_[i];
  if (dt_ == 0) return node.content * storage_by_content(i);
  const double m_n = content_start_[i];
  if (!rough_.empty()) return a * (node.content * rough_[i].mean - m_n * mean_start_[i].value) / dt_;
  return a * (m_n * g_rate_[i] + ((node.content - m_n) * node.h + m_n * (node.w - w_start_[i])) / dt_);
}

double FlowBalance::storage_by_content(int i) const {
  if (dt_ > 0) return area_[i] * oil_gap(i) / dt_;
  return area_[i] * g_rate_[i] * (rough_.empty() ? 1.0 : rough_[i].mean_h);
}

double FlowBalance::storage_u(int i) const {
  const Node& node = nodes_[i];
  return node.content_u * storage_by_content(i) + storage_h(i) * node.h_u;
}

// The start's part of what storage changes with the gap from which the step comes (film.8, film.33).
double FlowBalance::storage_by_start(int i) const {
  return area_[i] * content_start_[i] * (rough_.empty() ? 1.0 : mean_start_[i].slope);
}

// With the film thickness, at a given content; a liner at rest takes the gap of the start along.
double FlowBalance::storage_h(int i) const {
  const double by_h = rough_.empty() ? 1.0 : rough_[i].mean_h;
  if (dt_ > 0) {
    return (area_[i] * nodes_[i].content * by_h - (liner_rests_ ? storage_by_start(i) : 0)) / dt_;
  }
  return rough_.empty() ? 0 : area_[i] * nodes_[i].content * g_rate_[i] * rough_[i].mean_hh;
}

double FlowBalance::storage_g(int i) const {
  const double now = storage_h(i) * nodes_[i].h_g;
  return dt_ == 0 || liner_rests_ ? now : now - storage_by_start(i) / dt_;
}

double FlowBalance::storage_g_rate(int i) const {
  if (dt_ == 0) return area_[i] * nodes_[i].content * (rough_.empty() ? 1.0 : rough_[i].mean_h);
  return storage_by_start(i);
}

// What a row carries beside its balance: in reynolds the slack of p >= p_cav, on an open edge the outflow or
// inflow.
double FlowBalance::slack(int node) const {
  if (model_.cavitation == Cavitation::reynolds) return D0_ * std::min(u_[node], 0.0);
  const int j = node % model_.grid.n_z;
  return open_row(j) ? D0_ * (std::max(u_[node], 0.0) + std::min(u_[node] - ambient_unknown(j), 0.0)) : 0;
}

double FlowBalance::slack_u(int node) const {
  if (model_.cavitation == Cavitation::reynolds) return u_[node] < 0 ? D0_ : 0;
  const int j = node % model_.grid.n_z;
  return open_row(j) && (u_[node] >= 0 || u_[node] < ambient_unknown(j)) ? D0_ : 0;
}

double FlowBalance::outflow(int node) const {
  const int j = node % model_.grid.n_z;
  if (open_row(j)) return slack(node);
  if (!edge_row(j)) return 0;
  // A film that does not conserve oil lacks some wherever it is broken: the half volumes on an edge do not draw it in.
  const int inside = j == 0 ? node + 1 : node - 1;
  // A groove at p_cav holds u = 0 to round-off, of either sign.
  const double round_off = 1e-9 * fill_scale(model_);
  const bool broken = model_.cavitation == Cavitation::reynolds && edge_unknown(j) == 0 && u_[inside] < round_off;
  return broken ? 0 : -balance_[node];
}

double FlowBalance::supply(int node) const { return supply_share(node) > 0 ? balance_[node] + outflow(node) : 0; }

void FlowBalance::replace_boundary_rows() {
  const Grid& grid = model_.grid;
  for (int i = 0; i < size(); ++i) residual_[i] = balance_[i] + slack(i);
  for (const HeldNode& held : held_) {
    const int i = held.node;
    const double given = tie(held).k * (u_[i] - held.u);
    residual_[i] = (1 - held.chi) * residual_[i] + held.chi * given;
    throughput_[i] = std::max(throughput_[i], D0_ * std::abs(held.u));
  }
  for (int j = 0; j < grid.n_z; ++j) {
    if (!edge_row(j)) continue;
    for (int i = 0; i < grid.n_phi; ++i) {
      const int node = grid.index(i, j);
      residual_[node] = D0_ * (u_[node] - edge_unknown(j));
      throughput_[node] = std::max(throughput_[node], D0_ * std::abs(edge_unknown(j)));
    }
  }
}

double FlowBalance::relative_residual() const {
  const double largest = residual_.cwiseAbs().maxCoeff();
  return largest == 0 ? 0 : largest / largest_throughput_;
}

int FlowBalance::worst_node() const {
  int worst = 0;
  residual_.cwiseAbs().maxCoeff(&worst);
  return worst;
}

void FlowBalance::assemble_jacobian() {
  const Grid& grid = model_.grid;
  std::fill(values_.begin(), values_.end(), 0.0);
  for (int i = 0; i < size(); ++i) values_[diagonal_slot_[i]] = storage_u(i) + slack_u(i);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const FaceFlow& flow = flows_[f];
    const Node &a = nodes_[face.a], &b = nodes_[face.b];
    const bool from_a = flow.couette >= 0;
    const auto by_laws = [&](const Node& node, double q_h) {
      return q_h * node.h_u + 0.5 * (flow.q_fluidity * node.fluidity_u + flow.q_density * node.density_u);
    };
    const double q_a = flow.K * a.p_u + by_laws(a, flow.q_h_a) + (from_a ? flow.couette * a.theta_u : 0);
    const double q_b = -flow.K * b.p_u + by_laws(b, flow.q_h_b) + (from_a ? 0 : flow.couette * b.theta_u);
    values_[face.slots[0]] += q_a;
    values_[face.slots[1]] += q_b;
    values_[face.slots[2]] -= q_a;
    values_[face.slots[3]] -= q_b;
  }
  for (const HeldNode& held : held_) {
    const int i = held.node;
    const Tie t = tie(held);
    for (int slot : row_slots_[i]) values_[slot] *= 1 - held.chi;
    values_[diagonal_slot_[i]] += held.chi * (t.k + t.k_u * (u_[i] - held.u));
  }
  for (int j = 0; j < grid.n_z; ++j) {
    if (!edge_row(j)) continue;
    for (int i = 0; i < grid.n_phi; ++i) values_[diagonal_slot_[grid.index(i, j)]] = D0_;
  }
}

void FlowBalance::derivative(const MotionDirection& direction, Eigen::VectorXd& dr) const {
  const Grid& grid = model_.grid;
  const int n = size();
  const bool gap = direction.g.size() != 0, rate = direction.g_rate.size() != 0;
  HERSEY_REQUIRE(!gap || direction.g.size() == n, "direction of shape (grid.size()) or empty");
  HERSEY_REQUIRE(!rate || direction.g_rate.size() == n, "direction of shape (grid.size()) or empty");
  dr.setZero(n);
  for (int i = 0; i < n; ++i) {
    if (gap) dr[i] += storage_g(i) * direction.g[i];
    if (rate) dr[i] += storage_g_rate(i) * direction.g_rate[i];
  }
  const double speed_phi = 0.5 * (direction.u_shell + direction.u_journal);
  const double speed_z = 0.5 * (direction.w_shell + direction.w_journal);
  const double half_slip_phi = 0.5 * (direction.u_shell - direction.u_journal);
  const double half_slip_z = 0.5 * (direction.w_shell - direction.w_journal);
  const bool flows_change = gap || speed_phi != 0 || speed_z != 0 || half_slip_phi != 0 || half_slip_z != 0;
  for (std::size_t f = 0; flows_change && f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const Node &a = nodes_[face.a], &b = nodes_[face.b];
    const FaceFlow& flow = flows_[f];
    const double theta = flow.couette >= 0 ? a.theta : b.theta;
    const double carried =
        axial(f) ? carrying_area(f, speed_z, half_slip_z) : carrying_area(f, speed_phi, half_slip_phi);
    double q = flow.density * carried * theta;
    if (gap) q += flow.q_h_a * a.h_g * direction.g[face.a] + flow.q_h_b * b.h_g * direction.g[face.b];
    dr[face.a] += q;
    dr[face.b] -= q;
  }
  for (const HeldNode& held : held_) {
    const int i = held.node;
    const Tie t = tie(held);
    const double excess = u_[i] - held.u;
    const double chi = held.chi_line * direction.phi_supply + held.chi_journal * direction.phi_journal;
    dr[i] = (1 - held.chi) * dr[i] + chi * (t.k * excess - balance_[i] - slack(i));
    if (gap) dr[i] += held.chi * t.k_g * direction.g[i] * excess;
  }
  for (int j = 0; j < grid.n_z; ++j) {
    if (!edge_row(j)) continue;
    for (int i = 0; i < grid.n_phi; ++i) dr[grid.index(i, j)] = 0;
  }
}

}  // namespace hersey::film
