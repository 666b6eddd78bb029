// Flow from a feature over the land to an edge within the same cell (film.22).
#include <algorithm>
#include <cmath>
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
      if (edges_[node].kind == EdgeNode::Kind::wall || edges_[node].of_patch) continue;
      const double back = before < 0 ? 0 : 0.5 * geometry_.step(before, j), ahead = 0.5 * geometry_.step(i, j);
      const double middle = R * geometry_.from_to(geometry_.phi[i], phi), reach = 0.5 * R * feature.arc;
      bool touches = false;
      for (const double image : {-two_pi * R, 0.0, two_pi * R}) {
        const double from = std::max(-back, middle + image - reach), to = std::min(ahead, middle + image + reach);
        if (from >= to) continue;
        strips_.push_back({node, grid.index(i, next), f, from, to, 1 / land - 1 / flow_tube, u});
        touches = true;
      }
      if (touches) prescribe({.node = node, .feature = f, .u = u, .centrality = -land / half}, true);
    }
  }
}

// Where features overlap the oil takes the shortest land; their order has no effect.
void FlowBalance::merge_land_intervals() {
  std::stable_sort(strips_.begin(), strips_.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
  std::vector<double> borders;
  for (auto first = strips_.begin(); first != strips_.end();) {
    const auto last = std::find_if(first, strips_.end(), [&](const LandInterval& s) { return s.node != first->node; });
    const auto flow = [](const LandInterval& s) { return (s.to - s.from) * s.gain; };
    const auto main = std::max_element(first, last, [&](const auto& a, const auto& b) { return flow(a) < flow(b); });
    borders.clear();
    for (auto strip = first; strip != last; ++strip) borders.insert(borders.end(), {strip->from, strip->to});
    std::sort(borders.begin(), borders.end());
    double conductance = 0;
    for (std::size_t k = 1; k < borders.size(); ++k) {
      const double middle = 0.5 * (borders[k - 1] + borders[k]);
      double gain = 0;
      for (auto strip = first; strip != last; ++strip)
        if (strip->u == main->u && strip->from < middle && middle < strip->to) gain = std::max(gain, strip->gain);
      conductance += gain * (borders[k] - borders[k - 1]);
    }
    land_index_[main->node] = static_cast<int>(lands_.size());
    lands_.push_back({main->node, main->inside, main->feature, conductance, main->u});
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
  const Node &edge = nodes_[node], &inside = nodes_[land->inside];
  const auto mean = [&](double a, double b) { return 0.5 * (a + b); };
  const double h = mean(edge.h, inside.h), fluidity = mean(edge.flow[1].value, inside.flow[1].value);
  const double rough = mean(rough_[node].pressure[1], rough_[land->inside].pressure[1]);
  const double k = land->conductance / 12 * h * h * h * fluidity * rough * mean(edge.density, inside.density);
  return k * drop_over_land(node);
}

double FlowBalance::power_over_land(int node) const {
  return over_land(node) * drop_over_land(node) / nodes_[node].density;
}

}  // namespace hersey::film
