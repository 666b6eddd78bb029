// Flow from a feature over the land to an edge within the same cell (film.22).
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "balance/flow_balance.h"
#include "hersey/core/two_pi.h"

namespace hersey::film {

// No pressure on an edge can represent the shorter way from the end of a feature within the last cell. The flow over
// that land follows from both pressures and is part of no row.
void FlowBalance::find_strips(int f, double phi, double u) {
  const SurfaceFeature& feature = model_.features[static_cast<std::size_t>(f)];
  if (!has_straight_ends(feature)) return;
  const Grid& grid = model_.grid;
  const double half = 0.5 * feature.length;
  for (const int j : {0, grid.n_z - 1}) {
    const int next = j == 0 ? 1 : j - 1;
    const double flow_tube = std::abs(geometry_.z[next] - geometry_.z[j]);
    const double land = std::abs(geometry_.z[j] - feature.z) - half;
    if (land <= as_written * feature.length || land >= flow_tube || std::abs(geometry_.z[next] - feature.z) > half)
      continue;
    const double R = model_.R * geometry_.stretch[j];
    for (int i = 0; i < grid.n_phi; ++i) {
      const int node = grid.index(i, j), before = grid.before(i);
      if (edges_[node].kind == EdgeNode::Kind::wall || is_on_leaking_edge(node) || edges_[node].of_patch) continue;
      const double back = before < 0 ? 0 : 0.5 * geometry_.step(before, j), ahead = 0.5 * geometry_.step(i, j);
      const double turns = feature.surface == Surface::journal ? R : 0;
      const double middle = R * geometry_.from_to(geometry_.phi[i], phi), reach = 0.5 * R * feature.arc;
      bool touches = false;
      for (const double image : {-two_pi * R, 0.0, two_pi * R}) {
        const double from = std::max(-back, middle + image - reach), to = std::min(ahead, middle + image + reach);
        if (from >= to) continue;
        strips_.push_back({.node = node,
                           .inside = grid.index(i, next),
                           .feature = f,
                           .from = from,
                           .to = to,
                           .from_journal = from > -back ? turns : 0,
                           .to_journal = to < ahead ? turns : 0,
                           .gain = 1 / land - 1 / flow_tube,
                           .u = u});
        touches = true;
      }
      if (touches) prescribe({.node = node, .feature = f, .u = u, .centrality = -land / half}, true);
    }
  }
}

// Where features overlap the oil takes the shortest land; their order has no effect.
void FlowBalance::merge_land_intervals() {
  std::stable_sort(strips_.begin(), strips_.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
  std::vector<std::pair<double, double>> borders;  // positions with their derivatives
  for (auto first = strips_.begin(); first != strips_.end();) {
    const auto last = std::find_if(first, strips_.end(), [&](const LandInterval& s) { return s.node != first->node; });
    const auto flow = [](const LandInterval& s) { return (s.to - s.from) * s.gain; };
    const auto main = std::max_element(first, last, [&](const auto& a, const auto& b) { return flow(a) < flow(b); });
    borders.clear();
    for (auto strip = first; strip != last; ++strip)
      borders.insert(borders.end(), {{strip->from, strip->from_journal}, {strip->to, strip->to_journal}});
    std::sort(borders.begin(), borders.end());
    double conductance = 0, by_journal = 0;
    for (std::size_t k = 1; k < borders.size(); ++k) {
      const auto [from, from_journal] = borders[k - 1];
      const auto [to, to_journal] = borders[k];
      const double middle = 0.5 * (from + to);
      double gain = 0;
      for (auto strip = first; strip != last; ++strip)
        if (strip->u == main->u && strip->from < middle && middle < strip->to) gain = std::max(gain, strip->gain);
      conductance += gain * (to - from);
      by_journal += gain * (to_journal - from_journal);
    }
    land_index_[main->node] = static_cast<int>(lands_.size());
    lands_.push_back({main->node, main->inside, main->feature, conductance, by_journal, main->u});
    first = last;
  }
}

void FlowBalance::clear_lands() {
  for (const Land& land : lands_) land_index_[land.node] = -1;
  lands_.clear(), strips_.clear();
}

const FlowBalance::Land* FlowBalance::land_at(int node) const {
  const int index = land_index_[node];
  return index < 0 ? nullptr : &lands_[index];
}

double FlowBalance::drop_over_land(int node) const {
  const Land* land = land_at(node);
  return land == nullptr ? 0 : land->u - (is_on_open_edge(node) ? 0 : edge_unknown(node));
}

double FlowBalance::over_land(int node) const {
  const Land* land = land_at(node);
  if (land == nullptr) return 0;
  return tie_over_land(*land).k * drop_over_land(node);
}

// Oil, roughness and gap are the means of both nodes.
FlowBalance::LandTie FlowBalance::tie_over_land(const Land& land) const {
  const std::array<int, 2> at{land.node, land.inside};
  const auto mean = [&](const auto& of) { return 0.5 * (of(at[0]) + of(at[1])); };
  const double h = mean([&](int k) { return nodes_[k].h; });
  const double fluidity = mean([&](int k) { return nodes_[k].flow[1].value; });
  const double rough = mean([&](int k) { return rough_[k].pressure[1]; });
  const double density = mean([&](int k) { return nodes_[k].density; });
  const double per_conductance = h * h * h * fluidity * rough * density / 12;
  LandTie tie{.k = land.conductance * per_conductance, .k_journal = land.by_journal * per_conductance};
  for (const std::size_t side : {0U, 1U}) {
    const Node& node = nodes_[at[side]];
    const Fluidity& flow = node.flow[1];
    const double half = 0.5 * tie.k;
    const double by_h = half * (3 / h + flow.h / fluidity + rough_[at[side]].pressure_h[1] / rough);
    tie.k_u[side] = by_h * node.h_u + half * (flow.u / fluidity + node.density_u / density);
    tie.k_g[side] = by_h * node.h_g;
    tie.k_rate[side] = half * flow.rate / fluidity;
    tie.k_rotation[side] = half * flow.rotation / fluidity;
  }
  return tie;
}

double FlowBalance::power_over_land(int node) const {
  return over_land(node) * drop_over_land(node) / nodes_[node].density;
}

}  // namespace hersey::film
