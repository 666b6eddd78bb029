#include <algorithm>
#include <cmath>

#include "balance/flow_balance.h"

// Borders of cavities that cut control volumes of a film without a fill fraction. If volumes counted as full or
// cavitated as their nodes are, the shear of the film would be of first order.
namespace hersey::film {
namespace {

// Tension and missing oil below these fractions of what sliding at the film's speed causes do not cavitate a film: a
// journal at the centre has no cavity, and the torque of one near the centre does not jump.
constexpr double kLeastTension = 5e-4, kLeastSlack = 1e-3;

/// Nodes before and after along phi, then along z; -1: none.
std::array<int, 4> nodes_beside(const Grid& grid, int i, int j) {
  const int k = grid.index(i, j), before = grid.before(i), after = grid.next(i);
  return {before < 0 ? -1 : grid.index(before, j), after < 0 ? -1 : grid.index(after, j), j > 0 ? k - 1 : -1,
          j + 1 < grid.n_z ? k + 1 : -1};
}

/// Differences of a field over a control volume: sum of weight[k] * (field at beside[k]) + own * (field at its node).
struct Fall {
  double own = 0;
  std::array<double, 2> weight{};
};

// Half a volume lies towards each neighbour; without a neighbour there is none on that side.
Fall fall_over_volume(int before, int after) {
  return {(before >= 0 ? 0.5 : 0) - (after >= 0 ? 0.5 : 0), {before >= 0 ? -0.5 : 0, after >= 0 ? 0.5 : 0}};
}

/// Oil that pressure drives into a volume, with derivatives [m^3/s].
struct PressedIn {
  double value = 0, h = 0;        ///< with film thickness
  double rate = 0, rotation = 0;  ///< with the two members of SlidingChange

  /// Adds the flow by a pressure over a flow tube, given their product with width/(12 length).
  void add(double pressed, double thickness, const Fluidity& flow) {
    const double cube = thickness * thickness * thickness;
    value += pressed * cube * flow.value;
    h += pressed * (3 * thickness * thickness * flow.value + cube * flow.h);
    rate += pressed * cube * flow.rate, rotation += pressed * cube * flow.rotation;
  }
};

}  // namespace

// P0 (film.6) is scaled by fill_speed, which may differ from the film's speed.
double FlowBalance::sliding_fraction(int j) const {
  return sliding_[static_cast<std::size_t>(j)].speed / (model_.R * model_.fill_speed);
}

// In a film that bears tension u is a pressure on both sides of the border (film.60).
CavityBorder FlowBalance::cut_by_tension(int i, int j) const {
  const Grid& grid = model_.grid;
  const int k = grid.index(i, j);
  CavityBorder border{.node = k, .of = k};
  border.beside = nodes_beside(grid, i, j);
  const double least = kLeastTension * sliding_fraction(j) * fill_scale(model_);
  double range = 2 * least, range_own = 0, middle = u_[k] + least, middle_own = 1;
  std::array<double, 4> range_by{}, middle_by{};
  for (const std::size_t pair : {0U, 2U}) {
    const Fall fall = fall_over_volume(border.beside[pair], border.beside[pair + 1]);
    double over = fall.own * u_[k];
    for (const std::size_t side : {0U, 1U}) {
      const int other = border.beside[pair + side];
      if (other < 0) continue;
      over += fall.weight[side] * u_[other];
      if (fall.own == 0) continue;
      // Half a volume on an edge has its middle a quarter of the way to the next node.
      middle += 0.25 * (u_[other] - u_[k]), middle_own -= 0.25, middle_by[pair + side] += 0.25;
    }
    const double sign = over < 0 ? -1 : 1;
    range += std::abs(over), range_own += sign * fall.own;
    for (const std::size_t side : {0U, 1U}) range_by[pair + side] += sign * fall.weight[side];
  }
  const double fraction = 0.5 + middle / range;
  border.fraction = std::clamp(fraction, 0.0, 1.0);
  if (fraction <= 0 || fraction >= 1) return border;
  const auto slope = [&](double of_middle, double of_range) { return (of_middle - middle / range * of_range) / range; };
  border.by_u = slope(middle_own, range_own);
  border.by_rate = least * slope(1, 2);
  for (std::size_t side = 0; side < 4; ++side) border.by_beside[side] = slope(middle_by[side], range_by[side]);
  return border;
}

// Oil is missing in a cavitated volume. The flow that pressure drives in fills the fraction that it has in the sum of
// itself and the missing oil (film.61). Beside a supply line the node's row includes both, and the line drives in what
// a node at its position would.
CavityBorder FlowBalance::filled_by_pressure(int i, int j) const {
  const int k = model_.grid.index(i, j);
  const bool is_full = u_[k] >= -round_off_of_u();
  const PrescribedNode* prescribed = prescribed_at(k);
  CavityBorder border{.node = k, .of = k, .fraction = is_full ? 1.0 : 0.0};
  if (is_full || is_on_prescribed_edge(k) || (prescribed != nullptr && prescribed->other < 0)) return border;
  const PrescribedNode line = prescribed == nullptr ? PrescribedNode{.draws = 0, .distance = 1} : *prescribed;
  border.beside = nodes_beside(model_.grid, i, j);
  const std::array<int, 4> faces = faces_around(k);
  const Node& node = nodes_[k];
  PressedIn by_nodes, per_pressure;
  for (std::size_t side = 0; side < 4; ++side) {
    const int other = border.beside[side], f = faces[side];
    if (other < 0 || u_[other] <= 0 || is_cut(static_cast<std::size_t>(f))) continue;
    const Face& face = faces_[f];
    const Fluidity& flow = node.flow[side < 2 ? 0 : 1];
    const double unit = face.width / (12 * face.length);
    border.by_beside[side] = line.distance * unit * node.h * node.h * node.h * flow.value;
    by_nodes.add(unit * u_[other], node.h, flow);
  }
  per_pressure.add(line.conductance, node.h, node.flow[0]);
  const double lack = -u_[k], of_line = std::max(line.u, 0.0), drawn = line.draws * lack;
  double in = line.distance * by_nodes.value + of_line * per_pressure.value;
  const double missing = line.distance * D0_ * lack + drawn * per_pressure.value,
               least = kLeastSlack * sliding_fraction(j) * D0_ * scales_.slack;
  const bool is_little = missing < least;
  if (is_little) in += least - missing;
  border.fraction = in / (in + missing);
  if (in == 0) return border;
  const double whole = in + missing, by_in = missing / (whole * whole),
               by_missing = -in / (whole * whole) - (is_little ? by_in : 0);
  const auto change = [&](double of_nodes, double of_tie) {
    return by_in * (line.distance * of_nodes + of_line * of_tie) + by_missing * drawn * of_tie;
  };
  border.by_u = -by_missing * (line.distance * D0_ + line.draws * per_pressure.value);
  border.by_h = change(by_nodes.h, per_pressure.h);
  border.by_rate = change(by_nodes.rate, per_pressure.rate) + (is_little ? by_in * least : 0);
  border.by_rotation = change(by_nodes.rotation, per_pressure.rotation);
  border.by_line = (by_in * by_nodes.value + by_missing * D0_ * lack) * line.distance_line +
                   by_missing * line.draws_line * lack * per_pressure.value;
  for (double& by_beside : border.by_beside) by_beside *= by_in;
  return border;
}

void FlowBalance::apply_border(const CavityBorder& border) {
  Node& node = nodes_[border.node];
  (model_.cavitated_shear == CavitatedShear::full ? node.other_sheared_fraction : node.sheared_fraction) =
      border.fraction;
  if (border.fraction > 0 && border.fraction < 1) borders_.push_back(border);
}

// An edge at p_cav has u = 0 whether the film beside it is full or cavitated: it takes the state of the next node.
void FlowBalance::extend_borders_to_edges() {
  const std::size_t count = borders_.size();  // in the order of their nodes
  for (const int edge : prescribed_edge_nodes_) {
    const int next = phase_node(edge);
    if (next == edge) continue;
    nodes_[edge].sheared_fraction = nodes_[next].sheared_fraction,
    nodes_[edge].other_sheared_fraction = nodes_[next].other_sheared_fraction;
    const auto end = borders_.begin() + static_cast<std::ptrdiff_t>(count);
    const auto found = std::lower_bound(borders_.begin(), end, next,
                                        [](const CavityBorder& border, int node) { return border.node < node; });
    if (found == end || found->node != next) continue;
    CavityBorder same = *found;
    same.node = edge;
    borders_.push_back(same);
  }
}

// Where oil is conserved, the flow that pressure drives in fills the fraction that it has in the sum of itself and the
// missing oil. Beside a supply line both are those of the node's row, and the line drives in what a node at its
// position would: a line on a node belongs to either of two cells, by round-off.
double FlowBalance::cavitated_fraction(int node) const {
  const Node& at = nodes_[node];
  if (!cavitation_.has_fill())
    return 1 - (model_.cavitated_shear == CavitatedShear::full ? at.other_sheared_fraction : at.sheared_fraction);
  if (u_[node] >= -round_off_of_u() || is_flooded(node)) return 0;
  const PrescribedNode* line = has_line_row(node) ? prescribed_at(node) : nullptr;
  double in = 0, carried = 0;  // by pressure; out of a full gap by the surfaces
  for (const int f : faces_around(node)) {
    if (f < 0) continue;
    const Face& face = faces_[f];
    carried += std::max(face.a == node ? flows_[f].couette : -flows_[f].couette, 0.0);
    if (line == nullptr || !is_cut(static_cast<std::size_t>(f)))
      in += flows_[f].K * nodes_[face.a == node ? face.b : face.a].p;
  }
  double missing = (1 - at.theta) * carried;
  if (line != nullptr) {
    const double k = tie(*line).k;
    in = line->distance * in + k * (std::max(line->u, 0.0) - line->draws * u_[node]);
    missing *= line->distance;
  }
  return missing > 0 ? missing / (in + missing) : 1;
}

void FlowBalance::find_borders() {
  borders_.clear();
  if (cavitation_.has_fill() || cavitation_.bears_tension()) return;
  const Grid& grid = model_.grid;
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j)
      apply_border(cavitation_.has_tension() ? cut_by_tension(i, j) : filled_by_pressure(i, j));
  }
  if (cavitation_.loses_oil()) extend_borders_to_edges();
}

}  // namespace hersey::film
