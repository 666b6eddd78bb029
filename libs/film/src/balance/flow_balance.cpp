#include "balance/flow_balance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hersey/core/contract.h"

namespace hersey::film {
namespace {

void check(const FilmModel& m) {
  HERSEY_REQUIRE(m.R > 0 && m.L > 0 && m.c > 0, "a bearing has radius, width and clearance");
  HERSEY_REQUIRE(m.lubricant.mu0 > 0, "viscosity is positive");
  HERSEY_REQUIRE(m.compliance >= 0, "compliance is not negative");
  std::vector<Edge> edges{m.edge_left, m.edge_right};
  for (const PatchEnds& ends : m.ends) edges.insert(edges.end(), {ends.first, ends.last});
  for (const Edge& edge : edges) {
    HERSEY_REQUIRE(edge.kind == EdgeKind::closed || edge.pressure >= m.p_cav, "edges lie at or above p_cav");
    HERSEY_REQUIRE(0 <= edge.ambient_fill && edge.ambient_fill <= 1, "fill lies between 0 and 1");
    HERSEY_REQUIRE(edge.kind != EdgeKind::leaking || edge.leakage > 0, "a seal that leaks has a leakage");
    HERSEY_REQUIRE(edge.flow.value_or(0) >= 0, "oil that reaches an edge does not leave it");
    HERSEY_REQUIRE(edge.layer.value_or(0) >= 0, "a layer of oil has a thickness");
  }
  HERSEY_REQUIRE(m.supply.kind == SupplyKind::none || m.supply.pressure >= m.p_cav, "supply lies at or above p_cav");
  HERSEY_REQUIRE(m.supply.kind == SupplyKind::none || m.grid.closes(), "a supply line has film on both sides");
  HERSEY_REQUIRE(m.asperities.model == AsperityModel::none || m.asperities.sigma > 0, "roughness is positive");
  const Turbulence& t = m.turbulence;
  HERSEY_REQUIRE(!t.counts() || (0 < t.onset && t.onset < t.full && t.prandtl > 0), "a band of transition");
  HERSEY_REQUIRE(!t.counts() || (!m.roughness.counts() && m.lubricant.shear_thinning.is_newtonian()),
                 "turbulence of a Newtonian oil between smooth surfaces");
}

}  // namespace

FlowBalance::FlowBalance(const FilmModel& model)
    : model_(model),
      cavitation_(cavitation_law(model_)),
      scales_(cavitation_scales(model_)),
      law_(model_),
      rough_law_(model_.roughness),
      geometry_(model_),
      interpolation_(model_.grid, geometry_),
      relief_(model_, geometry_) {
  check(model_);
  const Grid& grid = model_.grid;
  unit_conductance_ = unit_conductance(geometry_);
  D0_ = model_.c * model_.c * model_.c / (12 * model_.lubricant.mu0) * unit_conductance_;
  area_.resize(grid.size());
  for (int k = 0; k < grid.size(); ++k) area_[k] = geometry_.area(k / grid.n_z, k % grid.n_z);
  lay_edges();
  lay_faces();
  lay_pattern();
  const int n = grid.size();
  nodes_.resize(n);
  rough_.resize(n);
  flows_.resize(faces_.size());
  for (auto* field : {&residual_, &balance_, &throughput_, &g_rate_, &w_start_, &u_}) field->setZero(n);
  content_start_.setOnes(n);
  cells_.resize(static_cast<std::size_t>(n));
  flow_tube_of_.assign(faces_.size(), -1);
  line_fractions_.resize(static_cast<std::size_t>(grid.n_z));
  prescribed_index_.assign(n, -1);
  edge_index_.assign(n, -1);
  land_index_.assign(n, -1);
}

void FlowBalance::lay_edges() {
  const Grid& grid = model_.grid;
  edges_.resize(static_cast<std::size_t>(grid.size()));
  for (int node = 0; node < grid.size(); ++node) {
    const Edge* edge = edge_of_node(model_, node);
    if (edge == nullptr) continue;
    const int i = node / grid.n_z, j = node % grid.n_z;
    EdgeNode& at = edges_[node];
    at.of_patch = edge != edge_of_row(model_, j);
    if (at.of_patch)
      at.inside = grid.index(grid.before(i) < 0 ? grid.next(i) : grid.before(i), j);
    else
      at.inside = j == 0 ? node + 1 : node - 1;
    const double fill = ambient_fill(model_, node);
    at.ambient = fill > 0 ? (fill - 1) * fill_scale(model_) : -std::numeric_limits<double>::infinity();
    at.kind = EdgeNode::Kind::wall;
    if (edge->kind == EdgeKind::closed) continue;
    if (edge->kind == EdgeKind::leaking) {
      at.kind = EdgeNode::Kind::leaking;
      at.u = edge->pressure - model_.p_cav;
      at.seal = edge->leakage * std::pow(model_.c, 3) / (6 * model_.L) * geometry_.width_phi[i] * geometry_.stretch[j];
      leaking_edge_nodes_.push_back(node);
      continue;
    }
    at.kind = open_edge(model_, node) ? EdgeNode::Kind::open : EdgeNode::Kind::prescribed;
    at.u = edge->pressure - model_.p_cav;
    if (!grid.closes() && !at.of_patch && grid.is_end(i)) {
      const PatchEnds& ends = model_.ends[static_cast<std::size_t>(grid.patch_of(i))];
      at.is_corner = (grid.begins_patch(i) ? ends.first : ends.last).kind == EdgeKind::pressure;
    }
    if (at.kind == EdgeNode::Kind::prescribed) prescribed_edge_nodes_.push_back(node);
    at.has_layer = at.kind == EdgeNode::Kind::open && !at.of_patch && edge->layer;
    if (at.has_layer) at.layer = *edge->layer * geometry_.width_phi[i] * geometry_.stretch[j];
  }
  if (!grid.closes()) spread_given_flows();
}

void FlowBalance::lay_faces() {
  const Grid& grid = model_.grid;
  faces_.reserve(2 * static_cast<std::size_t>(size()));
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      const int node = grid.index(i, j), next = grid.next(i);
      if (next < 0)
        faces_.push_back({node, node, 0, geometry_.mean_dx, geometry_.stretch[j], {}});
      else
        faces_.push_back(
            {node, grid.index(next, j), geometry_.width_z[j], geometry_.step(i, j), geometry_.stretch[j], {}});
    }
  }
  first_axial_face_ = faces_.size();
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j + 1 < grid.n_z; ++j) {
      faces_.push_back({grid.index(i, j),
                        grid.index(i, j + 1),
                        geometry_.width_phi[i] * geometry_.stretch_between[j],
                        geometry_.dz[j],
                        1,
                        {}});
    }
  }
  lay_face_runs();
}

// Around the bearing as many lines as follow one another in the numbering make one run.
void FlowBalance::lay_face_runs() {
  const Grid& grid = model_.grid;
  const int n_z = grid.n_z;
  for (int i = 0; i < grid.n_phi; ++i) {
    const int first = grid.index(i, 0), next = grid.next(i);
    axial_runs_.push_back({static_cast<int>(face_above(i, 0)), first, first + 1, n_z - 1});
    if (next < 0) continue;
    const bool goes_on = !around_runs_.empty() && next == i + 1 &&
                         around_runs_.back().a + around_runs_.back().count == first &&
                         around_runs_.back().b + around_runs_.back().count == grid.index(next, 0);
    if (goes_on)
      around_runs_.back().count += n_z;
    else
      around_runs_.push_back({first, first, grid.index(next, 0), n_z});
  }
}

std::array<int, 4> FlowBalance::faces_around(int node) const {
  const Grid& grid = model_.grid;
  const int i = node / grid.n_z, j = node % grid.n_z, before = grid.before(i);
  const auto face = [](bool is_there, std::size_t f) { return is_there ? static_cast<int>(f) : -1; };
  return {face(before >= 0, face_after(std::max(before, 0), j)), face(grid.next(i) >= 0, face_after(i, j)),
          face(j > 0, face_above(i, j - 1)), face(j + 1 < grid.n_z, face_above(i, j))};
}

void FlowBalance::lay_pattern() {
  const Grid& grid = model_.grid;
  const int n = size(), n_z = grid.n_z;
  const auto balanced = [&](int node) { return !is_on_prescribed_edge(node); };
  const auto around = [&](int line, int j, int none) { return line < 0 ? none : grid.index(line, j); };
  column_start_.reserve(static_cast<std::size_t>(n) + 1);
  row_index_.reserve(5 * static_cast<std::size_t>(n));
  column_start_.assign(1, 0);
  for (int column = 0; column < n; ++column) {
    const int i = column / n_z, j = column % n_z;
    std::array<int, 5> rows{around(grid.before(i), j, column), j > 0 ? column - 1 : column, column,
                            j + 1 < n_z ? column + 1 : column, around(grid.next(i), j, column)};
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
    const auto slot_of = [&](int line) { return line < 0 ? nowhere : find(row, grid.index(line, j)); };
    row_slots_[row] = {slot_of(grid.before(i)), j > 0 ? find(row, row - 1) : nowhere, diagonal_slot_[row],
                       j + 1 < n_z ? find(row, row + 1) : nowhere, slot_of(grid.next(i))};
  }
  values_.resize(row_index_.size() + 1);
}

void FlowBalance::take_history(const FilmHistory& history) {
  HERSEY_REQUIRE(history.dt >= 0, "time runs forwards");
  dt_ = history.dt;
  phi_start_ = history.phi_journal;
  viscosity_ = history.viscosity;
  HERSEY_REQUIRE(viscosity_.fluidity.size() == 0 || viscosity_.fluidity.size() == size(),
                 "viscosities of shape (grid.size()) or empty");
  has_start_gap_ = false;
  if (dt_ == 0) return;
  freezes_deformation_ = history.w.size() == 0;
  HERSEY_REQUIRE(history.theta.size() == size() && (freezes_deformation_ || history.w.size() == size()),
                 "history of shape (grid.size())");
  content_start_.setOnes();
  if (cavitation_.has_fill()) content_start_ = history.theta;
  if (history.density.size() != 0) {
    HERSEY_REQUIRE(history.density.size() == size(), "density at the start of shape (grid.size()) or empty");
    content_start_.array() *= history.density.array();
  }
  if (!freezes_deformation_) w_start_ = history.w;
  HERSEY_REQUIRE(history.gap.size() == 0 || history.gap.size() == size(),
                 "gap at the start of shape (grid.size()) or empty");
  gap_start_ = history.gap;
  has_start_gap_ = gap_start_.size() != 0;
  uses_gap_difference_ = history.by_gap && has_start_gap_;
}

void FlowBalance::take_motion(const SurfaceMotion& motion) {
  const int n = size();
  HERSEY_REQUIRE(motion.g.size() == n && motion.g_rate.size() == n, "gap and rate of shape (grid.size())");
  HERSEY_REQUIRE(motion.roughness_ratio.size() == 0 || motion.roughness_ratio.size() == n,
                 "a roughness for each node or none");
  const auto features = static_cast<Eigen::Index>(model_.features.size());
  HERSEY_REQUIRE(motion.feature_pressure.size() == 0 || motion.feature_pressure.size() == features,
                 "a pressure for each feature or none");
  g_rate_ = motion.g_rate;
  interpolation_.bends(motion.g, bends_);
  interpolation_.excesses(motion.g, excesses_);
  interpolation_.excesses(motion.g_rate, rate_excesses_);
  speed_phi_ = 0.5 * (motion.u_shell + motion.u_journal);
  speed_z_ = 0.5 * (motion.w_shell + motion.w_journal);
  half_slip_phi_ = 0.5 * (motion.u_shell - motion.u_journal);
  half_slip_z_ = 0.5 * (motion.w_shell - motion.w_journal);
  speeds_.u_shell = motion.u_shell, speeds_.u_journal = motion.u_journal;
  speeds_.w_shell = motion.w_shell, speeds_.w_journal = motion.w_journal;
  sliding_.clear();
  for (int j = 0; j < model_.grid.n_z; ++j) sliding_.push_back(sliding_of(slip(j).x(), slip(j).y()));
  if (relief_.is_empty()) return;
  relief_.set_rotation(motion.phi_journal, phi_start_, dt_, motion.u_journal);
  std::fill(flow_tube_of_.begin(), flow_tube_of_.end(), -1);
  pocket_flows_.resize(relief_.flow_tubes().size());
  for (std::size_t t = 0; t < relief_.flow_tubes().size(); ++t)
    flow_tube_of_[relief_.flow_tubes()[t].face] = static_cast<int>(t);
}

Eigen::Vector2d FlowBalance::slip(int j) const {
  return {geometry_.stretch[j] * (speeds_.u_journal - speeds_.u_shell), speeds_.w_journal - speeds_.w_shell};
}

SlidingChange FlowBalance::change_of_sliding(const MotionDirection& direction, int j) const {
  if (!has_sliding_viscosity()) return {};
  return film::change_of_sliding(slip(j), {geometry_.stretch[j] * (direction.u_journal - direction.u_shell),
                                           direction.w_journal - direction.w_shell});
}

FilmDomain FlowBalance::evaluate(const SurfaceMotion& motion, const FilmHistory& history, const Eigen::VectorXd& u) {
  const int n = size();
  HERSEY_REQUIRE(u.size() == n, "u of shape (grid.size())");
  take_history(history);
  take_motion(motion);
  take_unknowns(u);
  by_surfaces_.is_found = false;
  find_supply(motion);
  if (const FilmDomain domain = evaluate_nodes(motion, u_); !domain.is_inside()) return domain;
  add_faces();
  for (const int node : leaking_edge_nodes_) {
    const double leaves = seal_flow(node).value;
    balance_[node] += leaves;
    throughput_[node] = std::max(throughput_[node], std::abs(leaves));
  }
  find_borders();
  replace_boundary_rows();
  // Scale of the throughput of a film without oil: a thousandth of the flow that its surfaces would carry in a full
  // gap.
  const double carried =
      model_.c * std::max(std::abs(speed_phi_) * geometry_.mean_dz, std::abs(speed_z_) * geometry_.mean_dx);
  largest_throughput_ = std::max(throughput_.maxCoeff(), 1e-3 * carried);
  return {};
}

// Between parallel surfaces u is nothing but round-off, whose sign would decide which nodes are full; all are.
void FlowBalance::take_unknowns(const Eigen::VectorXd& u) {
  const double round_off = 1e-12 * fill_scale(model_);
  u_ = u;
  for (double& value : u_)
    if (std::abs(value) < round_off) value = 0;
}

// Where the oil is thinner at one of the surfaces, sliding carries more of it along with the other, as between rough
// surfaces (thermal.6).
void FlowBalance::skew(double skew, double h, RoughGap& gap) {
  for (const int k : {0, 1}) {
    gap.drag[k] += skew * h;
    gap.drag_h[k] += skew;
  }
}

FilmDomain FlowBalance::evaluate_nodes(const SurfaceMotion& motion, const Eigen::VectorXd& u) {
  if (const FilmDomain domain = check_unknowns(model_, u); !domain.is_inside()) return domain;
  for (int i = 0; i < size(); ++i) {
    const Sliding& sliding = sliding_[static_cast<std::size_t>(i % model_.grid.n_z)];
    const double roughness = motion.roughness_at(i);
    if (is_layered())
      law_.evaluate(motion.g[i], u[i], i, sliding, roughness, node_viscosity(viscosity_, i), nodes_[i]);
    else
      law_.evaluate(motion.g[i], u[i], i, sliding, roughness, nodes_[i]);
    if (!std::isfinite(nodes_[i].h) || !std::isfinite(motion.g_rate[i])) return {FilmDomain::Violation::not_finite, i};
    if (nodes_[i].h <= 0) return {FilmDomain::Violation::closed, i};
    if (freezes_deformation_) w_start_[i] = nodes_[i].w;
    rough_[i] = rough_law_.state(nodes_[i].h, roughness);
    if (is_layered()) skew(viscosity_.skew[i], nodes_[i].h, rough_[i]);
    evaluate_cell(i, motion);
    balance_[i] = storage(i);
    throughput_[i] = std::max(std::abs(balance_[i]), std::abs(storage_g_rate(i) * g_rate_[i]));
  }
  return {};
}

int FlowBalance::phase_node(int node) const {
  while (is_on_prescribed_edge(node) && edge_unknown(node) == 0) node = edges_[node].inside;
  return node;
}

// A row has a term beside its balance: the slack of p >= p_cav, or on an open edge the outflow or inflow. Of a given
// flow (film.64) or layer (film.65) what the film has no room for leaves at once.
double FlowBalance::slack(int node) const {
  if (!is_on_open_edge(node)) return D0_ * cavitation_.slack(u_[node]).value;
  return D0_ * (std::max(u_[node], 0.0) + std::min(u_[node] - ambient_unknown(node), 0.0)) - given_flow(node);
}

double FlowBalance::slack_u(int node) const {
  if (!is_on_open_edge(node)) return D0_ * cavitation_.slack(u_[node]).slope;
  return u_[node] >= 0 || u_[node] < ambient_unknown(node) ? D0_ : 0;
}

// A film that does not conserve oil lacks some wherever it is cavitated: the half volumes on an edge do not draw it in.
bool FlowBalance::blocks_inflow(int node) const {
  return cavitation_.loses_oil() && edge_unknown(node) == 0 && u_[edges_[node].inside] < round_off_of_u();
}

bool FlowBalance::returns_to_edge(int node) const {
  return is_on_supply(node) && is_on_open_edge(node) && -balance_[node] > slack(node);
}

// On an edge in air the oil that a supply beside it would take back leaves, too.
double FlowBalance::outflow_of_row(int node) const {
  if (is_on_leaking_edge(node)) return seal_flow(node).value;
  if (is_on_open_edge(node)) return returns_to_edge(node) ? -balance_[node] : slack(node);
  if (!is_on_prescribed_edge(node)) return 0;
  return blocks_inflow(node) ? 0 : -balance_[node];
}

double FlowBalance::outflow(int node) const { return outflow_of_row(node) + over_land(node); }

double FlowBalance::end_fraction(int node) const {
  if (edges_[node].of_patch) return 1;
  if (!edges_[node].is_corner) return 0;
  const double over_both = outflow(node);
  return over_both == 0 ? 0 : std::clamp(flow_along_side(node) / over_both, 0.0, 1.0);
}

double FlowBalance::acting_outflow(int node) const {
  if (cavitation_.bears_tension()) return outflow(node);
  if (is_on_leaking_edge(node)) return seal_flow_at(node, std::max(nodes_[node].p, 0.0)) + over_land(node);
  if (!cavitation_.has_tension() || !is_on_prescribed_edge(node)) return outflow(node);
  const int inside = edges_[node].inside;
  if (nodes_[inside].p >= -round_off_of_u()) return outflow(node);
  return over_land(node) - flows_[face_at_edge(node)].K * edge_unknown(node);
}

// The seal is a gap of its own with the oil of the film before it (damper.1).
double FlowBalance::seal_flow_at(int node, double p) const { return seal_conductance(node) * (p - edges_[node].u); }

FlowBalance::SealFlow FlowBalance::seal_flow(int node) const {
  const Node& at = nodes_[node];
  const Fluidity& flow = at.flow[1];
  const double seal = edges_[node].seal, drop = at.p - edges_[node].u, by_fluidity = seal * at.density * drop;
  return {.value = by_fluidity * flow.value,
          .u = seal * at.density * flow.value * at.p_u + by_fluidity * (flow.u + flow.h * at.h_u) +
               seal * flow.value * drop * at.density_u,
          .g = by_fluidity * flow.h * at.h_g,
          .rate = by_fluidity * flow.rate,
          .rotation = by_fluidity * flow.rotation};
}

double FlowBalance::flow_along_side(int node) const {
  const Grid& grid = model_.grid;
  const int i = node / grid.n_z, j = node % grid.n_z;
  const bool is_first = grid.begins_patch(i);
  const std::size_t f = face_after(is_first ? i : grid.before(i), j);
  const FaceFlow& flow = flows_[f];
  const double q = flow.K * (nodes_[faces_[f].a].p - nodes_[faces_[f].b].p) + flow.carried(upstream(f).theta).value;
  return is_first ? -q : q;
}

std::size_t FlowBalance::face_at_edge(int node) const {
  const int first = std::min(node, edges_[node].inside), i = first / model_.grid.n_z, j = first % model_.grid.n_z;
  return edges_[node].of_patch ? face_after(i, j) : face_above(i, j);
}

// Oil that is lost where the film is cavitated has no source, except for the fraction that the supply provides.
double FlowBalance::supply_of_row(int node) const {
  const double land = over_land(node);
  if (!is_on_supply(node)) return land;
  const double lost = is_on_open_edge(node) ? 0 : (1 - draws(node)) * slack(node);
  if (is_on_leaking_edge(node)) return balance_[node] + lost + land;  // the balance has what leaks
  return balance_[node] + lost + outflow_of_row(node) + land;
}

double FlowBalance::supply(int node) const {
  if (!is_beside_line(node)) return supply_of_row(node);
  const PrescribedNode& prescribed = *prescribed_at(node);
  return (1 - prescribed.distance) * (supply_of_row(node) + supply_of_row(prescribed.other));
}

void FlowBalance::replace_boundary_rows() {
  for (int i = 0; i < size(); ++i) residual_[i] = balance_[i] + slack(i);
  for (const PrescribedNode& prescribed : prescribed_) {
    const int i = prescribed.node;
    const double given = tie(prescribed).k * excess(prescribed).value;
    residual_[i] = (1 - prescribed.chi) * (line_balance(i) + slack(i)) + given;
    throughput_[i] = std::max(throughput_[i], D0_ * std::abs(prescribed.u));
  }
  for (const int node : prescribed_edge_nodes_) {
    residual_[node] = D0_ * (u_[node] - edge_unknown(node));
    throughput_[node] = std::max(throughput_[node], D0_ * std::abs(edge_unknown(node)));
  }
  replace_restricted_rows();
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
  std::fill(values_.begin(), values_.end(), 0.0);
  for (int i = 0; i < size(); ++i) values_[diagonal_slot_[i]] = storage_u(i) + slack_u(i);
  for (const int node : leaking_edge_nodes_) values_[diagonal_slot_[node]] += seal_flow(node).u;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const auto [q_a, q_b] = flow_by_u(f);
    const bool cut = is_cut(f);
    if (!cut || !has_line_row(face.a)) {
      values_[face.slots[0]] += q_a;
      values_[face.slots[1]] += q_b;
    }
    if (cut && has_line_row(face.b)) continue;
    values_[face.slots[2]] -= q_a;
    values_[face.slots[3]] -= q_b;
  }
  for (const PrescribedNode& prescribed : prescribed_) {
    const int i = prescribed.node;
    const Tie t = tie(prescribed);
    const auto [above, slope] = excess(prescribed);
    if (prescribed.other >= 0) add_line_by_u(prescribed);
    for (int slot : row_slots_[i]) values_[slot] *= 1 - prescribed.chi;
    values_[diagonal_slot_[i]] += t.k * slope + t.k_u * above;
    if (prescribed.other >= 0) values_[slot_to_other(prescribed)] += t.k_u_other * above;
  }
  for (const int node : prescribed_edge_nodes_) values_[diagonal_slot_[node]] = D0_;
}

void FlowBalance::derivative(const MotionDirection& direction, Eigen::VectorXd& dr, Eigen::VectorXd* port_flows) const {
  HERSEY_REQUIRE(direction.port_pressure.size() == 0 || direction.port_pressure.size() == port_count(),
                 "a change of pressure for each feature or none");
  balance_along(direction, dr);
  if (!restricted_.empty() || port_flows != nullptr) direction_balance_ = dr;
  for (const PrescribedNode& prescribed : prescribed_) {
    double& row = dr[prescribed.node];
    row = (1 - prescribed.chi) * row + prescribed_along(prescribed, direction, gap_change_at(prescribed, direction));
  }
  for (const int node : prescribed_edge_nodes_) dr[node] = 0;
  if (!restricted_.empty()) find_restricted_along(direction, direction_balance_, dr);
  if (port_flows != nullptr) find_port_flows_along(direction, direction_balance_, *port_flows);
}

}  // namespace hersey::film
