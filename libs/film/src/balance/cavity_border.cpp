#include <algorithm>
#include <cmath>

#include "balance/flow_balance.h"

// Where the border of a cavity cuts control volumes of a film without a fill fraction: counted as full or cavitated as
// their nodes are, the shear of the film would be of the first order.
namespace hersey::film {
namespace {

// Tension and missing oil below these shares of their scales do not break a film: a journal at the centre has no
// cavity, and one near it no torque that jumps.
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

// Half a volume lies towards each neighbour; without one there is none on that side.
Fall fall_over_volume(int before, int after) {
  return {(before >= 0 ? 0.5 : 0) - (after >= 0 ? 0.5 : 0), {before >= 0 ? -0.5 : 0, after >= 0 ? 0.5 : 0}};
}

}  // namespace

// Of a film that bears tension u is a pressure on both sides of the border (film.60).
CavityBorder FlowBalance::cut_by_tension(int i, int j) const {
  const Grid& grid = model_.grid;
  const int k = grid.index(i, j);
  CavityBorder border{.node = k, .of = k};
  border.beside = nodes_beside(grid, i, j);
  const double least = kLeastTension * fill_scale(model_);
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
  const double share = 0.5 + middle / range;
  border.share = std::clamp(share, 0.0, 1.0);
  if (share <= 0 || share >= 1) return border;
  const auto slope = [&](double of_middle, double of_range) { return (of_middle - middle / range * of_range) / range; };
  border.by_u = slope(middle_own, range_own);
  for (std::size_t side = 0; side < 4; ++side) border.by_beside[side] = slope(middle_by[side], range_by[side]);
  return border;
}

// In a cavitated volume -D0 u is missing; what pressure presses in fills its share of what would be missing without
// (film.61).
CavityBorder FlowBalance::filled_by_pressure(int i, int j) const {
  const Grid& grid = model_.grid;
  const int k = grid.index(i, j);
  const bool is_full = u_[k] >= -round_off_of_u();
  CavityBorder border{.node = k, .of = k, .share = is_full ? 1.0 : 0.0};
  if (is_full || is_held(k) || is_given(k)) return border;
  border.beside = nodes_beside(grid, i, j);
  const std::array<int, 4> faces = faces_around(k);
  const Node& node = nodes_[k];
  const double cube = node.h * node.h * node.h;
  double in = 0, in_by_h = 0, in_by_rate = 0, in_by_turn = 0;
  std::array<double, 4> in_by{};
  for (std::size_t side = 0; side < 4; ++side) {
    const int other = border.beside[side];
    if (other < 0 || u_[other] <= 0) continue;
    const Face& face = faces_[faces[side]];  // which no line cuts: it would hold the node
    const Fluidity& flow = node.flow[side < 2 ? 0 : 1];
    const double unit = face.width / (12 * face.length), pressed = unit * u_[other];
    in_by[side] = unit * cube * flow.value;
    in += in_by[side] * u_[other];
    in_by_h += pressed * (3 * node.h * node.h * flow.value + cube * flow.h);
    in_by_rate += pressed * cube * flow.rate, in_by_turn += pressed * cube * flow.turn;
  }
  const double missing = -D0_ * u_[k], least = kLeastSlack * D0_ * scales_.slack;
  if (missing < least) in += least - missing;
  border.share = in / (in + missing);
  if (in == 0) return border;
  const double whole = in + missing, by_in = missing / (whole * whole), by_missing = -in / (whole * whole);
  border.by_u = -D0_ * (by_missing - (missing < least ? by_in : 0)), border.by_h = by_in * in_by_h;
  border.by_rate = by_in * in_by_rate, border.by_turn = by_in * in_by_turn;
  for (std::size_t side = 0; side < 4; ++side) border.by_beside[side] = by_in * in_by[side];
  return border;
}

void FlowBalance::show_border(const CavityBorder& border) {
  Node& node = nodes_[border.node];
  (model_.cavitated_shear == CavitatedShear::full ? node.other_share : node.share) = border.share;
  if (border.share > 0 && border.share < 1) borders_.push_back(border);
}

// An edge at p_cav has u = 0 whether the film beside it is full or cavitated: it is what the next node is.
void FlowBalance::take_borders_to_edges() {
  const std::size_t count = borders_.size();  // in the order of their nodes
  for (const int edge : prescribed_edge_nodes_) {
    const int next = phase_node(edge);
    if (next == edge) continue;
    nodes_[edge].share = nodes_[next].share, nodes_[edge].other_share = nodes_[next].other_share;
    const auto end = borders_.begin() + static_cast<std::ptrdiff_t>(count);
    const auto found = std::lower_bound(borders_.begin(), end, next,
                                        [](const CavityBorder& border, int node) { return border.node < node; });
    if (found == end || found->node != next) continue;
    CavityBorder same = *found;
    same.node = edge;
    borders_.push_back(same);
  }
}

// Where oil is conserved, what pressure presses in fills a share of what would be missing without it.
double FlowBalance::cavitated_share(int node) const {
  const Node& at = nodes_[node];
  if (!cavitation_.has_fill()) return 1 - (model_.cavitated_shear == CavitatedShear::full ? at.other_share : at.share);
  if (u_[node] >= -round_off_of_u()) return 0;
  double in = 0, carried = 0;  // by pressure; out of a full gap by the surfaces
  for (const int f : faces_around(node)) {
    if (f < 0) continue;
    const Face& face = faces_[f];
    in += flows_[f].K * nodes_[face.a == node ? face.b : face.a].p;
    carried += std::max(face.a == node ? flows_[f].couette : -flows_[f].couette, 0.0);
  }
  const double missing = (1 - at.theta) * carried;
  return missing > 0 ? missing / (in + missing) : 1;
}

void FlowBalance::find_borders() {
  borders_.clear();
  if (cavitation_.has_fill()) return;
  const Grid& grid = model_.grid;
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j)
      show_border(cavitation_.has_tension() ? cut_by_tension(i, j) : filled_by_pressure(i, j));
  }
  if (cavitation_.loses_oil()) take_borders_to_edges();
}

}  // namespace hersey::film
