#include <algorithm>
#include <cmath>

#include "balance/flow_balance.h"
#include "hersey/core/two_pi.h"

// Rows of the residual in which supply line and features have a part (film.21, film.22).
namespace hersey::film {
namespace {

// A node whose own balance has a smaller weight than this in its row lies on line or feature.
constexpr double kNoWay = 1e-6;

}  // namespace

const FlowBalance::PrescribedNode* FlowBalance::prescribed_at(int node) const {
  const int index = prescribed_index_[node];
  return index < 0 ? nullptr : &prescribed_[index];
}

const FlowBalance::PrescribedNode* FlowBalance::supplied_at(int node) const {
  if (const PrescribedNode* prescribed = prescribed_at(node); prescribed != nullptr) return prescribed;
  const int index = edge_index_[node];
  return index < 0 ? nullptr : &supplied_edge_nodes_[index];
}

double FlowBalance::supplied_fraction(int node) const {
  const PrescribedNode* supplied = supplied_at(node);
  return supplied == nullptr ? 0 : supplied->mixed_fraction;
}

int FlowBalance::supplied_by(int node) const {
  const PrescribedNode* supplied = supplied_at(node);
  return supplied == nullptr ? -1 : supplied->feature;
}

double FlowBalance::balance_weight(int node) const {
  const PrescribedNode* prescribed = prescribed_at(node);
  return prescribed == nullptr ? 1 : 1 - prescribed->chi;
}

double FlowBalance::supply_unknown(int node) const {
  const PrescribedNode* prescribed = prescribed_at(node);
  if (prescribed == nullptr) return 0;
  return cavitation_.has_tension() ? prescribed->u : std::max(prescribed->u, 0.0);
}

double FlowBalance::supply_conductance(int node) const {
  const PrescribedNode* prescribed = prescribed_at(node);
  return prescribed == nullptr ? 0 : tie(*prescribed).k;
}

double FlowBalance::draws(int node) const {
  const PrescribedNode* prescribed = prescribed_at(node);
  return prescribed == nullptr || cavitation_.has_tension() ? 1 : prescribed->draws;
}

// Between the supply and the next node only pressure drives oil. On the supply itself the gap is full in any case, or,
// behind a restrictor that yields too little, as full as it is there.
ValueAndSlope FlowBalance::excess(const PrescribedNode& prescribed) const {
  const double u = u_[prescribed.node], fraction = u < 0 ? draws(prescribed.node) : 1;
  if (u > 0 && only_fills(prescribed.node)) return {0, 0};
  return {fraction * u - (prescribed.u < 0 ? draws(prescribed.node) : 1) * prescribed.u, fraction};
}

// On an edge in air u > 0 is an outflow; a feature beside the edge does not take it.
bool FlowBalance::only_fills(int node) const {
  const PrescribedNode* prescribed = prescribed_at(node);
  return prescribed != nullptr && prescribed->feature >= 0 && prescribed->chi < 1 && is_on_open_edge(node);
}

double FlowBalance::supply_dissipation(int node) const {
  const PrescribedNode* prescribed = prescribed_at(node);
  // On the supply itself there is no distance left: the round-off of its pressure would be divided by next to nothing.
  if (prescribed == nullptr || 1 - prescribed->chi < kNoWay) return 0;
  const double given = supply_unknown(node);
  const double drop = nodes_[node].p - given, acting = nodes_[node].wall - model_.p_cav - given;
  return tie(*prescribed).k / (nodes_[node].density * (1 - prescribed->chi)) * drop * acting;
}

// The pressure falls evenly along the way to the line; the node's control volume ends half a flow tube from it.
FlowBalance::DissipationSplit FlowBalance::split_of_dissipation(int node) const {
  const PrescribedNode* prescribed = prescribed_at(node);
  if (prescribed == nullptr || prescribed->other < 0) return {node, 0};
  return {prescribed->other, prescribed->distance > 0.5 ? 1 - 0.5 / prescribed->distance : 0};
}

int FlowBalance::feature_at(int node) const {
  if (const PrescribedNode* prescribed = prescribed_at(node); prescribed != nullptr) return prescribed->feature;
  const Land* land = land_at(node);
  return land == nullptr ? -1 : land->feature;
}

// The conductance is that of the film, which fills the distance between node and line, or node and edge of the feature.
FlowBalance::Tie FlowBalance::tie(const PrescribedNode& prescribed) const {
  if (prescribed.other >= 0) return tie_to_line(prescribed);
  const Node& node = nodes_[prescribed.node];
  const double cube = node.h * node.h * node.h, by_h = 3 / node.h;
  const RoughGap& rough = rough_[prescribed.node];
  const Fluidity &around = node.flow[0], &along = node.flow[1];
  // Oil that thins by sliding has another fluidity along the axis: the mean of both directions counts, with
  // derivatives.
  const double smooth = unit_conductance_ / 12 * node.density * cube;
  const auto by_fluidity = [&](double change_around, double change_along) {
    return 0.5 * smooth * (rough.pressure[0] * change_around + rough.pressure[1] * change_along);
  };
  const double k = by_fluidity(around.value, along.value);
  const double by_node = 0.5 * smooth * (rough.pressure_h[0] * around.value + rough.pressure_h[1] * along.value) +
                         by_fluidity(around.h, along.h) + k * by_h;
  const double by_laws = by_fluidity(around.u, along.u) + k * node.density_u / node.density, scale = prescribed.chi;
  return {.k = scale * k,
          .k_u = scale * (by_node * node.h_u + by_laws),
          .k_g = scale * by_node * node.h_g,
          .k_journal = prescribed.chi_journal * k,
          .k_rate = scale * by_fluidity(around.rate, along.rate),
          .k_rotation = scale * by_fluidity(around.rotation, along.rotation)};
}

// Oil, roughness and gap are those half-way to the line: with the line on the next node, those of a face.
FlowBalance::Tie FlowBalance::tie_to_line(const PrescribedNode& prescribed) const {
  const Node &node = nodes_[prescribed.node], &other = nodes_[prescribed.other];
  const RoughGap &rough = rough_[prescribed.node], &rough_other = rough_[prescribed.other];
  const double bend = bends_[static_cast<Eigen::Index>(line_face(prescribed))];
  const ByGap cube = gap_towards_line(prescribed, thickness_towards_line(prescribed)).cube;
  const auto between = [&prescribed](double near, double far) { return prescribed.near * near + prescribed.far * far; };
  const double fluidity = between(node.flow[0].value, other.flow[0].value),
               density = between(node.density, other.density),
               factor = between(rough.pressure[0], rough_other.pressure[0]);
  const double k = prescribed.conductance * cube.value * fluidity * density * factor, by_gap = k * cube.h / cube.value;
  const auto by_h = [&](double weight, const Node& at, const RoughGap& gap) {
    return weight * (by_gap + k * at.flow[0].h / fluidity + k * gap.pressure_h[0] / factor);
  };
  const auto by_laws = [&](double weight, const Node& at) {
    return weight * k * (at.flow[0].u / fluidity + at.density_u / density);
  };
  const double near = by_h(prescribed.near, node, rough), far = by_h(prescribed.far, other, rough_other);
  const double by_near = by_gap * (node.h - other.h) + k * (node.flow[0].value - other.flow[0].value) / fluidity +
                         k * (node.density - other.density) / density +
                         k * (rough.pressure[0] - rough_other.pressure[0]) / factor;
  return {.k = k,
          .k_u = near * node.h_u + by_laws(prescribed.near, node),
          .k_g = near * node.h_g,
          .k_u_other = far * other.h_u + by_laws(prescribed.far, other),
          .k_g_other = far * other.h_g,
          .k_bend = by_gap * prescribed.bend,
          .k_line = prescribed.near_line * by_near + by_gap * prescribed.bend_line * bend,
          .k_journal = k * cube.journal / cube.value,
          .k_rate = k * between(node.flow[0].rate, other.flow[0].rate) / fluidity,
          .k_rotation = k * between(node.flow[0].rotation, other.flow[0].rotation) / fluidity};
}

// Of two supplies that prescribe a node wholly the one with more pressure counts, and of equal pressures the one whose
// middle is nearer, so that the order in the file has no effect. A line on a node prescribes it wholly only to
// rounding: a feature has precedence.
bool FlowBalance::yields_to(const PrescribedNode& prescribed, const PrescribedNode& to) {
  if (prescribed.is_main != to.is_main) return to.is_main;
  constexpr double as_much = 1e-9;  // relative round-off of a position
  if (std::abs(prescribed.chi - to.chi) > as_much) return prescribed.chi < to.chi;
  if ((prescribed.feature < 0) != (to.feature < 0)) return prescribed.feature < 0;
  return prescribed.u != to.u ? prescribed.u < to.u : prescribed.centrality < to.centrality;
}

// Edges have precedence over a line or a feature, except for the oil, which is the supply's. An edge in air is filled
// there, but its pressure cannot rise.
void FlowBalance::prescribe(const PrescribedNode& prescribed, bool only_oil) {
  only_oil = only_oil || is_on_prescribed_edge(prescribed.node);
  std::vector<PrescribedNode>& nodes = only_oil ? supplied_edge_nodes_ : prescribed_;
  int& index = (only_oil ? edge_index_ : prescribed_index_)[prescribed.node];
  if (index >= 0 && !yields_to(nodes[index], prescribed)) return;
  if (index < 0) {
    index = static_cast<int>(nodes.size());
    nodes.emplace_back();
  }
  nodes[index] = prescribed;
  if (!is_on_open_edge(prescribed.node)) return;
  if (nodes[index].u > 0) nodes[index].by_supply = 0;
  nodes[index].u = nodes[index].by_port != 0 ? 0 : std::min(nodes[index].u, 0.0);
  nodes[index].by_port = 0;
}

// The line cuts the flow tubes between two columns of nodes. Each side is connected to it by the part of the flow tube
// on its side, K/t at a fraction t of the distance. The row is multiplied by t, so that a line on a node prescribes the
// pressure there.
void FlowBalance::prescribe_line(double phi) {
  const Grid& grid = model_.grid;
  const auto line = geometry_.locate(phi);
  const int i = line.node;
  const double t = line.fraction;
  const int next = grid.next(i);
  line_ = {true, i, t, model_.R / geometry_.dx[i]};
  const double u = model_.supply.pressure - model_.p_cav;
  const auto side = [&](int here, int there, int j, double distance, double by_phi) {
    prescribe({.node = grid.index(here, j),
               .chi = 1 - distance,
               .chi_line = -by_phi,
               .mixed_fraction = 1 - distance,
               .draws = (1 - distance) * (1 - distance),
               .draws_line = -2 * (1 - distance) * by_phi,
               .u = u,
               .other = grid.index(there, j),
               .near = 1 - 0.5 * distance,
               .far = 0.5 * distance,
               .bend = distance * (2 - distance),
               .near_line = -0.5 * by_phi,
               .bend_line = 2 * (1 - distance) * by_phi,
               .conductance = geometry_.width_z[j] / (12 * geometry_.step(i, j)),
               .distance = distance,
               .distance_line = by_phi});
  };
  for (int j = 0; j < grid.n_z; ++j) {
    side(i, next, j, t, line_.by_phi);
    side(next, i, j, 1 - t, -line_.by_phi);
  }
}

void FlowBalance::find_supply(const SurfaceMotion& motion) {
  for (const PrescribedNode& prescribed : prescribed_) prescribed_index_[prescribed.node] = -1;
  for (const PrescribedNode& prescribed : supplied_edge_nodes_) edge_index_[prescribed.node] = -1;
  prescribed_.clear(), supplied_edge_nodes_.clear(), restricted_.clear(), clear_lands();
  feature_u_.assign(model_.features.size(), 0.0);
  line_ = {};
  if (model_.supply.kind != SupplyKind::none) prescribe_line(motion.phi_supply);
  for (std::size_t f = 0; f < model_.features.size(); ++f) {
    const SurfaceFeature& feature = model_.features[f];
    if (!feature.is_fed) continue;
    const auto index = static_cast<Eigen::Index>(f);
    const double pressure = motion.feature_pressure.size() == 0 ? feature.pressure : motion.feature_pressure[index];
    double u = std::max(lowest_supply(static_cast<int>(f)), pressure - model_.p_cav);
    covered_.clear();
    cover(model_, geometry_, feature, motion.phi_journal, covered_);
    const int main = feature.restrictor ? main_node(covered_) : -1;
    const bool has_pressure = main < 0 || u_[main] >= 0 || cavitation_.has_tension();
    if (main >= 0) {
      u = has_pressure || cavitation_.has_fill() ? u_[main] : 0;
      const double supply = pressure - model_.p_cav;
      const bool is_without = feature.may_lack_oil && supply < 0;
      restricted_.push_back({.feature = static_cast<int>(f),
                             .node = main,
                             .u = u,
                             .supply = is_without ? 0 : supply,
                             .has_pressure = has_pressure,
                             .by_supply = is_without ? 0.0 : 1.0});
    }
    feature_u_[f] = u;
    for (const CoveredNode& node : covered_) {
      const int j = node.node % model_.grid.n_z;
      if (is_on_prescribed_edge(node.node) && !edges_[node.node].of_patch &&
          std::abs(geometry_.z[j] - feature.z) > (0.5 + as_written) * feature.length)
        continue;
      const bool is_main = node.node == main;
      prescribe({.node = node.node,
                 .chi = is_main ? 1 : node.fraction,
                 .chi_journal = is_main ? 0 : node.fraction_journal,
                 .mixed_fraction = node.mixed_fraction,
                 .draws = is_main ? 1 : node.draws,
                 .draws_journal = is_main ? 0 : node.draws_journal,
                 .feature = static_cast<int>(f),
                 .u = u,
                 .by_port = main >= 0 && (has_pressure || cavitation_.has_fill()) ? 1.0 : 0.0,
                 .by_supply = !feature.restrictor && u > lowest_supply(static_cast<int>(f)) ? 1.0 : 0.0,
                 .is_main = is_main,
                 .centrality = node.centrality});
    }
    const bool travels = feature.surface == Surface::journal;
    find_strips(static_cast<int>(f), feature.phi + (travels ? motion.phi_journal : 0.0),
                cavitation_.has_tension() ? u : std::max(u, 0.0));
  }
  merge_land_intervals();
  keep_restricted_ports();
}

bool FlowBalance::is_cut(std::size_t f) const {
  return line_.cuts && !axial(f) && static_cast<int>(f) / model_.grid.n_z == line_.column;
}

std::size_t FlowBalance::line_face(const PrescribedNode& prescribed) const {
  return face_after(line_.column, prescribed.node % model_.grid.n_z);
}

bool FlowBalance::has_line_row(int node) const {
  const PrescribedNode* prescribed = prescribed_at(node);
  return prescribed != nullptr && prescribed->other >= 0;
}

bool FlowBalance::is_beside_line(int node) const {
  return has_line_row(node) && has_line_row(prescribed_at(node)->other);
}

// If one node took all of it, temperatures would jump as the line passes over a node.
double FlowBalance::line_flow_through_face(std::size_t f) const {
  const Face& face = faces_[f];
  if (!is_cut(f) || !is_beside_line(face.a)) return 0;
  return supply(face.a) - supply_of_row(face.a);
}

/// Returns the film thickness half-way to the line [m].
double FlowBalance::thickness_towards_line(const PrescribedNode& prescribed) const {
  return prescribed.near * nodes_[prescribed.node].h + prescribed.far * nodes_[prescribed.other].h +
         prescribed.bend * bends_[static_cast<Eigen::Index>(line_face(prescribed))];
}

// A pocket that the line crosses is as deep beside it as in the flow tube that the line cuts.
FlowTubeGap FlowBalance::gap_towards_line(const PrescribedNode& prescribed, double h) const {
  const int flow_tube = flow_tube_of_[line_face(prescribed)];
  if (flow_tube < 0) return {.cube = {h * h * h, 3 * h * h, 0}, .carry = {h, 1, 0}, .excess = {}};
  return relief_.gap(relief_.flow_tubes()[static_cast<std::size_t>(flow_tube)], h);
}

/// Returns the additional flow that the surfaces carry in pockets there, per width [m^2/s].
ByGap FlowBalance::carried_in_pockets(const PrescribedNode& prescribed) const {
  const std::size_t f = line_face(prescribed);
  if (flow_tube_of_[f] < 0) return {};
  const double past =
      entrainment(f) - pocket_edge_speed(f, relief_.flow_tubes()[static_cast<std::size_t>(flow_tube_of_[f])]);
  const double h = thickness_towards_line(prescribed);
  const ByGap carry = gap_towards_line(prescribed, h).carry;
  return {past * (carry.value - h), past * (carry.h - 1), past * carry.journal};
}

// A control volume ends in the middle of the way to the line. The entrained flow there leaves it, or comes from the
// line, which fills the gap; the volume squeezed between there and the face goes to the line.
FlowBalance::TowardsLine FlowBalance::towards_line(int node) const {
  if (!has_line_row(node)) return {};
  const PrescribedNode& prescribed = *prescribed_at(node);
  const std::size_t f = line_face(prescribed);
  const Face& face = faces_[f];
  const auto at = [&](int k) { return entrainment(f) * rough_[k].mean + half_slip(f) * rough_[k].drag[0]; };
  const double sign = node == face.a ? 1 : -1, density = flows_[f].density;
  TowardsLine t;
  t.counts = true;
  t.full =
      sign * density * face.width *
      (prescribed.near * at(node) + prescribed.far * at(prescribed.other) +
       prescribed.bend * entrainment(f) * bends_[static_cast<Eigen::Index>(f)] + carried_in_pockets(prescribed).value);
  if (flow_tube_of_[f] >= 0)
    t.full += sign * density * relief_.flow_tubes()[static_cast<std::size_t>(flow_tube_of_[f])].swept;
  t.from_node = t.full >= 0;
  t.strip = density * strip_area(prescribed) * g_rate_[node];
  return t;
}

double FlowBalance::strip_area(const PrescribedNode& prescribed) const {
  const Face& face = faces_[line_face(prescribed)];
  return 0.5 * (1 - prescribed.distance) * face.length * face.width;
}

/// Returns the balance of a node as its row counts it: beside the line up to half the distance to it.
double FlowBalance::line_balance(int node) const {
  const TowardsLine t = towards_line(node);
  if (!t.counts) return balance_[node];
  const std::size_t f = line_face(*prescribed_at(node));
  const double carried = flows_[f].carried(upstream(f).theta).value;
  const double conserved = node == faces_[f].a ? carried : -carried;
  return balance_[node] - conserved + t.full * fraction_towards_line(node, t).value - t.strip;
}

/// Returns the fraction of a full gap's entrained flow from a node to the line; 1 where the flow comes from the line.
FlowBalance::CutFaceFraction FlowBalance::fraction_towards_line(int node, const TowardsLine& t) const {
  if (!t.from_node) return {};
  const std::size_t f = line_face(*prescribed_at(node));
  if (node == (flows_[f].couette >= 0 ? faces_[f].a : faces_[f].b))
    return line_fractions_[f % static_cast<std::size_t>(model_.grid.n_z)];
  return {.value = nodes_[node].theta, .theta = 1};
}

void FlowBalance::add_line_by_u(const PrescribedNode& prescribed) {
  const std::size_t f = line_face(prescribed);
  const Face& face = faces_[f];
  const TowardsLine t = towards_line(prescribed.node);
  const Node &node = nodes_[prescribed.node], &other = nodes_[prescribed.other];
  const double sign = prescribed.node == face.a ? 1 : -1, density = flows_[f].density;
  const CutFaceFraction fraction = fraction_towards_line(prescribed.node, t);
  const bool is_a = prescribed.node == face.a;
  const double scale = sign * fraction.value * density * face.width;
  const double deeper = carried_in_pockets(prescribed).h;
  const auto by_h = [&](int k) {
    return entrainment(f) * rough_[k].mean_h + half_slip(f) * rough_[k].drag_h[0] + deeper;
  };
  const double by_density = 0.5 * (fraction.value * t.full - t.strip) / density;
  values_[diagonal_slot_[prescribed.node]] +=
      scale * prescribed.near * by_h(prescribed.node) * node.h_u + by_density * node.density_u +
      t.full * (fraction.theta * node.theta_u + (is_a ? fraction.h_a : fraction.h_b) * node.h_u);
  values_[slot_to_other(prescribed)] += scale * prescribed.far * by_h(prescribed.other) * other.h_u +
                                        by_density * other.density_u +
                                        t.full * (is_a ? fraction.h_b : fraction.h_a) * other.h_u;
}

/// Returns the change of fraction_towards_line() with the surfaces.
double FlowBalance::line_fraction_along(const PrescribedNode& prescribed, const CutFaceFraction& fraction,
                                        const MotionDirection& direction, const GapChangeBesideLine& gap) const {
  if (fraction.theta == 0) return 0;
  const std::size_t f = line_face(prescribed);
  const Face& face = faces_[f];
  const FaceFlow& flow = flows_[f];
  const Speeds speeds = speeds_along(f, direction);
  double change = fraction.journal * direction.phi_journal;
  // Of surfaces at rest nothing is carried, of which a fraction could change.
  if (flow.couette != 0 && (speeds.mean != 0 || speeds.half_slip != 0)) {
    const auto [full, little] = carried_by_speeds(f);
    const EntrainedFlow carried = flow.carried(upstream(f).theta);
    change += flow.density *
              ((carried.full - fraction.value) * full.dot(speeds) + carried.little * little.dot(speeds)) / flow.couette;
  }
  const bool is_a = prescribed.node == face.a;
  return change + fraction.h_a * nodes_[face.a].h_g * (is_a ? gap.g : gap.g_other) +
         fraction.h_b * nodes_[face.b].h_g * (is_a ? gap.g_other : gap.g) + fraction.bend * gap.bend +
         fraction.excess * gap.excess;
}

/// Returns the change of the terms of towards_line() with the surfaces.
double FlowBalance::line_row_along(const PrescribedNode& prescribed, const MotionDirection& direction,
                                   const GapChangeBesideLine& gap) const {
  const std::size_t f = line_face(prescribed);
  const Face& face = faces_[f];
  const auto bend = static_cast<Eigen::Index>(f);
  const TowardsLine t = towards_line(prescribed.node);
  const double sign = prescribed.node == face.a ? 1 : -1, density = flows_[f].density;
  const CutFaceFraction fraction = fraction_towards_line(prescribed.node, t);
  const double scale = sign * density * face.width * fraction.value;
  const auto [speed, half_slip_change, journal] = speeds_along(f, direction);
  const auto carried = [&](int k, double mean, double half) {
    return mean * rough_[k].mean + half * rough_[k].drag[0];
  };
  const ByGap deeper = carried_in_pockets(prescribed);
  const auto by_h = [&](int k) {
    return entrainment(f) * rough_[k].mean_h + half_slip(f) * rough_[k].drag_h[0] + deeper.h;
  };
  double q = prescribed.near * carried(prescribed.node, speed, half_slip_change) +
             prescribed.far * carried(prescribed.other, speed, half_slip_change) +
             prescribed.bend * speed * bends_[bend];
  q += prescribed.near * by_h(prescribed.node) * nodes_[prescribed.node].h_g * gap.g +
       prescribed.far * by_h(prescribed.other) * nodes_[prescribed.other].h_g * gap.g_other +
       prescribed.bend * (entrainment(f) + deeper.h) * gap.bend;
  const double rotation = direction.phi_supply;
  q += rotation * (prescribed.near_line * (carried(prescribed.node, entrainment(f), half_slip(f)) -
                                           carried(prescribed.other, entrainment(f), half_slip(f)) +
                                           deeper.h * (nodes_[prescribed.node].h - nodes_[prescribed.other].h)) +
                   prescribed.bend_line * (entrainment(f) + deeper.h) * bends_[bend]);
  if (flow_tube_of_[f] >= 0) {
    const PocketFlowTube& flow_tube = relief_.flow_tubes()[static_cast<std::size_t>(flow_tube_of_[f])];
    q += (flow_tube.swept_journal * direction.phi_journal + flow_tube.swept_speed * journal) / face.width;
    const double h = thickness_towards_line(prescribed), step = edge_speed_of(flow_tube, speed, journal);
    q += (speed - step) * (gap_towards_line(prescribed, h).carry.value - h) + deeper.journal * direction.phi_journal;
  }
  const double row = scale * q + t.full * line_fraction_along(prescribed, fraction, direction, gap) -
                     density * strip_area(prescribed) * gap.g_rate;
  return row +
         0.5 * prescribed.distance_line * rotation * density * face.length * face.width * g_rate_[prescribed.node];
}

GapChangeBesideLine FlowBalance::gap_change_at(const PrescribedNode& prescribed,
                                               const MotionDirection& direction) const {
  GapChangeBesideLine change;
  if (direction.g_rate.size() != 0) change.g_rate = direction.g_rate[prescribed.node];
  if (direction.g.size() == 0) return change;
  change.g = direction.g[prescribed.node];
  if (prescribed.other < 0) return change;
  const std::size_t f = line_face(prescribed);
  change.g_other = direction.g[prescribed.other];
  change.bend = direction_bends_[static_cast<Eigen::Index>(f)];
  change.excess = direction_excesses_[flows_[f].couette >= 0 ? faces_[f].a : faces_[f].b];
  return change;
}

double FlowBalance::prescribed_along(const PrescribedNode& prescribed, const MotionDirection& direction,
                                     const GapChangeBesideLine& gap) const {
  const int i = prescribed.node;
  const Tie t = tie(prescribed);
  const SlidingChange& sliding = sliding_along(i);
  const double chi = prescribed.chi_line * direction.phi_supply + prescribed.chi_journal * direction.phi_journal;
  double change = chi == 0 ? 0 : -chi * (line_balance(i) + slack(i));
  if (prescribed.other >= 0) change += (1 - prescribed.chi) * line_row_along(prescribed, direction, gap);
  const double k = t.k_line * direction.phi_supply + t.k_journal * direction.phi_journal + t.k_rate * sliding.rate +
                   t.k_rotation * sliding.rotation + t.k_g * gap.g + t.k_g_other * gap.g_other + t.k_bend * gap.bend;
  return change + k * excess(prescribed).value +
         t.k * (draws_along(prescribed, direction) - supply_along(prescribed, direction));
}

/// Returns the change of excess() as line and journal move [Pa].
double FlowBalance::draws_along(const PrescribedNode& prescribed, const MotionDirection& direction) const {
  const double u = std::min(u_[prescribed.node], 0.0) - std::min(prescribed.u, 0.0);
  if (u == 0 || cavitation_.has_tension()) return 0;
  return (prescribed.draws_line * direction.phi_supply + prescribed.draws_journal * direction.phi_journal) * u;
}

// A circuit that has too little oil fills the feature in part (film.22); other supplies are full. Behind a restrictor
// the recess has a fill of its own.
double FlowBalance::lowest_supply(int feature) const {
  const SurfaceFeature& of = model_.features[static_cast<std::size_t>(feature)];
  return of.may_lack_oil && !of.restrictor && cavitation_.has_fill() ? -fill_scale(model_) : 0;
}

// At p_cav a supply has no pressure to lose; on an edge in air its pressure cannot rise. Behind a restrictor the
// supply's pressure acts on the balance of the port only.
double FlowBalance::port_along(int feature, double u, const MotionDirection& direction) const {
  if (feature >= 0 && model_.features[static_cast<std::size_t>(feature)].restrictor) return 0;
  return feature < 0 || direction.port_pressure.size() == 0 || u <= 0 ? 0 : direction.port_pressure[feature];
}

// As excess().
double FlowBalance::supply_along(const PrescribedNode& prescribed, const MotionDirection& direction) const {
  if (prescribed.by_supply == 0 || direction.port_pressure.size() == 0) return 0;
  if (u_[prescribed.node] > 0 && only_fills(prescribed.node)) return 0;
  const double fraction = prescribed.u < 0 ? draws(prescribed.node) : 1;
  return fraction * prescribed.by_supply * direction.port_pressure[prescribed.feature];
}

int FlowBalance::slot_to_other(const PrescribedNode& prescribed) const {
  const Face& face = faces_[line_face(prescribed)];
  return prescribed.node == face.a ? face.slots[1] : face.slots[2];
}

}  // namespace hersey::film
