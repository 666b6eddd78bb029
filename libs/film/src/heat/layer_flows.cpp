#include "heat/layer_flows.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "heat/eddy_mixing.h"
#include "observe/film_power.h"

namespace hersey::film {

namespace {

// Largest fraction by which the heat of half volumes along the edges is corrected.
constexpr double kMostCompleted = 0.5;

}  // namespace

Eigen::Vector2d pressure_gradient(const FlowBalance& balance, int node) {
  const Grid& grid = balance.model().grid;
  const GridGeometry& geometry = balance.geometry();
  const auto slope = [&](int from, int to, double length) {
    return (balance.nodes()[to].p - balance.nodes()[from].p) / length;
  };
  const int i = node / grid.n_z, j = node % grid.n_z, last = grid.before(i), next = grid.next(i);
  const double back = last < 0 ? 0 : geometry.step(last, j), ahead = next < 0 ? 0 : geometry.step(i, j);
  const double around =
      slope(last < 0 ? node : grid.index(last, j), next < 0 ? node : grid.index(next, j), back + ahead);
  const int below = std::max(j - 1, 0), above = std::min(j + 1, grid.n_z - 1);
  return {around, slope(grid.index(i, below), grid.index(i, above), geometry.z[above] - geometry.z[below])};
}

Eigen::Vector2d one_sided_gradient(const FlowBalance& balance, int node) {
  const double supply_fraction = 1 - balance.balance_weight(node);
  const Eigen::Vector2d smooth = pressure_gradient(balance, node);
  if (supply_fraction == 0) return smooth;
  const Grid& grid = balance.model().grid;
  const GridGeometry& geometry = balance.geometry();
  const int i = node / grid.n_z, j = node % grid.n_z, last = grid.before(i), next = grid.next(i);
  const auto slope = [&](int from, int to, double length) {
    return (balance.nodes()[to].p - balance.nodes()[from].p) / length;
  };
  const auto weighted = [](double a, double b) {
    const double size = std::abs(a) + std::abs(b);
    return size > 0 ? (a * std::abs(a) + b * std::abs(b)) / size : 0;
  };
  const double before = last < 0 ? 0 : slope(grid.index(last, j), node, geometry.step(last, j)),
               after = next < 0 ? 0 : slope(node, grid.index(next, j), geometry.step(i, j));
  const double below = j > 0 ? slope(node - 1, node, geometry.dz[j - 1]) : 0,
               above = j + 1 < grid.n_z ? slope(node, node + 1, geometry.dz[j]) : 0;
  return (1 - supply_fraction) * smooth +
         supply_fraction * Eigen::Vector2d(weighted(before, after), weighted(below, above));
}

WithinLayers within_layers(const Lubricant& oil) {
  return oil.shear_thinning.is_newtonian() ? WithinLayers::linear : WithinLayers::constant;
}

LayerFlows::LayerFlows(const FilmModel& model, int layers)
    : model_(model),
      layers_(static_cast<std::size_t>(layers)),
      across_(layering_of(layers_)),
      within_(within_layers(model.lubricant)),
      fractions_(static_cast<std::size_t>(model.grid.size())) {
  upwards_.resize(fractions_.size() * layers_);
  heat_.resize(fractions_.size() * layers_);
  lost_.resize(fractions_.size());
}

void LayerFlows::evaluate(const FlowBalance& balance, const FilmWrench& wrench, const SurfaceMotion& motion,
                          const Eigen::VectorXd& mu) {
  std::vector<double> with_eddies(layers_);
  for (std::size_t k = 0; k < fractions_.size(); ++k) {
    const std::span<const double> own{mu.data() + k * layers_, layers_};
    const EddyMixing mixing(model_, balance.nodes()[k]);
    if (!mixing.mixes()) {
      find_fractions(own, within_, fractions_[k]);
      continue;
    }
    std::copy(own.begin(), own.end(), with_eddies.begin());
    add_eddies(mixing, with_eddies);
    find_fractions(with_eddies, WithinLayers::constant, fractions_[k]);
  }
  flow_over_faces(balance, motion);
  flow_upwards(balance);
  dissipate(balance, wrench, motion);
}

// Flow along pressure and the flow carried by each surface have profiles of their own. The additions of roughness,
// pockets and bends of the gap to the flow carried are shared by all layers.
void LayerFlows::flow_over_faces(const FlowBalance& balance, const SurfaceMotion& motion) {
  faces_.resize(balance.faces().size() * layers_);
  leads_.resize(faces_.size());
  const auto first_axial = static_cast<std::size_t>(model_.grid.size());
  for (std::size_t f = 0; f < balance.faces().size(); ++f) {
    const Face& face = balance.faces()[f];
    const FaceFlow& flow = balance.flows()[f];
    const Node &a = balance.nodes()[face.a], &b = balance.nodes()[face.b];
    const LayerFractions &at_a = fractions_[face.a], &at_b = fractions_[face.b];
    const double along_pressure = flow.K * (a.p - b.p) + balance.line_flow_through_face(f);
    const double carried = flow.carried((flow.couette >= 0 ? a : b).theta).value;
    const double stretch = f < first_axial ? balance.geometry().stretch[face.a % model_.grid.n_z] : 1;
    const double u_shell = stretch * (f < first_axial ? motion.u_shell : motion.w_shell);
    const double slip = stretch * (f < first_axial ? motion.u_journal : motion.w_journal) - u_shell;
    const double fraction = flow.couette != 0 ? carried / flow.couette : 0;
    const double full = fraction * flow.density * face.width * 0.5 * (a.h + b.h);
    double rest = carried;
    for (std::size_t l = 0; l < layers_; ++l) {
      const double own =
          full * (u_shell * across_.width(l) + 0.5 * slip * (at_a.sliding_flow[l] + at_b.sliding_flow[l]));
      faces_[f * layers_ + l] = 0.5 * along_pressure * (at_a.pressure_flow[l] + at_b.pressure_flow[l]) + own;
      leads_[f * layers_ + l] = 0.5 * along_pressure * (at_a.pressure_lead[l] + at_b.pressure_lead[l]) +
                                0.5 * full * slip * (at_a.sliding_lead[l] + at_b.sliding_lead[l]);
      rest -= own;
    }
    for (std::size_t l = 0; l < layers_; ++l) faces_[f * layers_ + l] += rest * across_.width(l);
  }
}

// Each layer keeps its fraction of the node's oil; the rest of its inflow leaves it upwards. Where a cavitation model
// loses oil, all layers do.
void LayerFlows::flow_upwards(const FlowBalance& balance) {
  std::vector<double> out(fractions_.size() * layers_);
  for (std::size_t k = 0; k < fractions_.size(); ++k) {
    const auto node = static_cast<int>(k);
    const double leaving = std::max(balance.outflow(node), 0.0) + std::max(-balance.supply(node), 0.0);
    const double coming = std::max(-balance.outflow(node), 0.0) + std::max(balance.supply(node), 0.0);
    for (std::size_t l = 0; l < layers_; ++l)
      out[k * layers_ + l] =
          (balance.storage(node) - coming) * across_.width(l) + leaving * fractions_[k].pressure_flow[l];
  }
  for (std::size_t f = 0; f < balance.faces().size(); ++f) {
    const auto a = static_cast<std::size_t>(balance.faces()[f].a), b = static_cast<std::size_t>(balance.faces()[f].b);
    for (std::size_t l = 0; l < layers_; ++l) {
      out[a * layers_ + l] += faces_[f * layers_ + l];
      out[b * layers_ + l] -= faces_[f * layers_ + l];
    }
  }
  for (std::size_t k = 0; k < fractions_.size(); ++k) {
    double sum = 0, up = 0;
    for (std::size_t l = 0; l < layers_; ++l) sum += out[k * layers_ + l];
    lost_[k] = -sum;
    for (std::size_t l = 0; l < layers_; ++l) {
      up -= out[k * layers_ + l] - sum * across_.width(l);
      upwards_[k * layers_ + l] = l + 1 < layers_ ? up : 0;
    }
  }
}

// Heat by flow along pressure, and by sliding.
void LayerFlows::dissipate_in_volumes(const FlowBalance& balance, const FilmWrench& wrench,
                                      const SurfaceMotion& motion) {
  along_pressure_.assign(fractions_.size(), 0.0);
  by_sliding_.resize(fractions_.size());
  for (std::size_t f = 0; f < balance.faces().size(); ++f) {
    const double half = 0.5 * pressure_power(balance, f);
    along_pressure_[static_cast<std::size_t>(balance.faces()[f].a)] += half;
    along_pressure_[static_cast<std::size_t>(balance.faces()[f].b)] += half;
  }
  for (int k = 0; k < model_.grid.size(); ++k) {
    const auto at_node = static_cast<std::size_t>(k);
    const double by_tie = balance.supply_dissipation(k);
    const auto [other, beyond] = balance.split_of_dissipation(k);
    along_pressure_[static_cast<std::size_t>(other)] += beyond * by_tie;
    along_pressure_[at_node] += (1 - beyond) * by_tie + balance.power_over_land(k);
    by_sliding_[at_node] = balance.area(k) * sliding_power(balance, wrench, motion, k);
  }
}

// Sums over volumes differ from the film's power, an integral of higher order (film.53). Between nodes the error of a
// sum cancels, up to the half volumes along the edges (Euler and Maclaurin): they take the difference (thermal.9).
void LayerFlows::complete_at_edges(const FlowBalance& balance, const FilmWrench& wrench, const SurfaceMotion& motion) {
  const Eigen::VectorXd beyond = power_beyond_volumes(balance, motion, wrench);
  for (int i = 0; i < model_.grid.n_phi; ++i) {
    const auto first = static_cast<std::size_t>(model_.grid.index(i, 0)),
               last = static_cast<std::size_t>(model_.grid.index(i, model_.grid.n_z - 1));
    const double there = along_pressure_[first] + by_sliding_[first] + along_pressure_[last] + by_sliding_[last];
    if (there <= 0) continue;
    const double fraction = 1 + std::clamp(beyond[i] / there, -kMostCompleted, kMostCompleted);
    for (const std::size_t edge : {first, last}) along_pressure_[edge] *= fraction, by_sliding_[edge] *= fraction;
  }
}

// The small rest is shared by all.
void LayerFlows::dissipate(const FlowBalance& balance, const FilmWrench& wrench, const SurfaceMotion& motion) {
  dissipate_in_volumes(balance, wrench, motion);
  complete_at_edges(balance, wrench, motion);
  FilmObservables whole;
  whole.flow_features.setZero(static_cast<Eigen::Index>(model_.features.size()));
  add_powers(balance, motion, wrench, whole);
  const double sum = std::accumulate(along_pressure_.begin(), along_pressure_.end(), 0.0) +
                     std::accumulate(by_sliding_.begin(), by_sliding_.end(), 0.0);
  const double scale = sum > 0 ? whole.power_film / sum : 1;
  for (int k = 0; k < model_.grid.size(); ++k) {
    const Node& node = balance.nodes()[k];
    const double mixed = node.sheared_fraction * balance.area(k) * node.h *
                         balance.slip(k % model_.grid.n_z).dot(pressure_gradient(balance, k));
    const auto at_node = static_cast<std::size_t>(k);
    const LayerFractions& of = fractions_[at_node];
    for (std::size_t l = 0; l < layers_; ++l) {
      heat_[at(at_node, static_cast<int>(l))] =
          scale * (by_sliding_[at_node] * of.sliding_heat[l] + along_pressure_[at_node] * of.pressure_heat[l] +
                   mixed * of.mixed_heat[l]);
    }
  }
}

}  // namespace hersey::film
