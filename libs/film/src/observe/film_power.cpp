#include "observe/film_power.h"

#include <algorithm>
#include <cmath>

namespace hersey::film {
namespace {

/// Returns the weights of values in the middles of intervals in an integral over all of them, over the intervals'
/// lengths: each interval has the parabola through its own value and those of its neighbours.
Eigen::VectorXd parabolic_weights(const Eigen::VectorXd& length) {
  const auto n = static_cast<int>(length.size());
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);
  if (n < 3) return weights;
  const auto distance = [&](int j) { return 0.5 * (length[j] + length[j + 1]); };
  for (int j = 0; j < n; ++j) {
    const int middle = std::clamp(j, 1, n - 2);
    const double a = distance(middle - 1), b = distance(middle), bend = length[j] * length[j] * length[j] / 12;
    weights[middle - 1] += bend / (a * (a + b)) / length[middle - 1];
    weights[middle] -= bend / (a * b) / length[middle];
    weights[middle + 1] += bend / (b * (a + b)) / length[middle + 1];
  }
  return weights;
}

/// Factors that turn sums over volumes, which the balance of oil implies, into integrals by the weights of the wrench,
/// which are exact for a film's parabola across the width.
struct Across {
  Eigen::VectorXd axial;   ///< of faces along the axis
  Eigen::VectorXd around;  ///< of nodes, and of faces around
};

Across across(const GridGeometry& geometry) {
  return {parabolic_weights(geometry.dz), geometry.weight_z.cwiseQuotient(geometry.width_z)};
}

/// Work of the oil that a feature feeds over the land before an edge, beyond the part counted at a prescribed node.
double oil_over_land(const FlowBalance& balance, int node) {
  if (balance.over_land(node) == 0) return 0;
  const double edge = balance.is_on_open_edge(node) ? 0 : balance.edge_unknown(node);
  const double counted =
      balance.is_on_supply(node) ? oil_work(balance.model().lubricant, balance.supply_unknown(node)) : 0;
  return (oil_work(balance.model().lubricant, edge + balance.drop_over_land(node)) - counted) * balance.over_land(node);
}

// Power of a film that is sheared over the whole gap: mu slip^2/h, more of it between rough surfaces.
double full_sliding_power(const FlowBalance& balance, const FilmWrench& wrench, const SurfaceMotion& motion, int node) {
  const double stretch = balance.geometry().stretch[node % balance.model().grid.n_z];
  const double slip2_phi = std::pow(stretch * (motion.u_journal - motion.u_shell), 2);
  const double slip2_z = std::pow(motion.w_journal - motion.w_shell, 2);
  const Node& at = balance.nodes()[node];
  const RoughGap& rough = balance.rough_gaps()[node];
  const double slip2 = rough.couette[0] * slip2_phi + rough.couette[1] * slip2_z;
  return at.mu * slip2 * wrench.relief_factor(node) / at.h;
}

}  // namespace

double sliding_power(const FlowBalance& balance, const FilmWrench& wrench, const SurfaceMotion& motion, int node) {
  return balance.nodes()[node].sheared_fraction * full_sliding_power(balance, wrench, motion, node);
}

// Pressure drives oil through the gap: the power over a face is volume flow times drop. In guembel a face on which the
// pressure is cut off counts the part before the cut.
double pressure_power(const FlowBalance& balance, std::size_t f) {
  const Face& face = balance.faces()[f];
  const Node &a = balance.nodes()[face.a], &b = balance.nodes()[face.b];
  const FaceFlow& flow = balance.flows()[f];
  return flow.K / flow.density * (a.p - b.p) * (a.wall - b.wall) + balance.recirculation(f);
}

Eigen::VectorXd power_beyond_volumes(const FlowBalance& balance, const SurfaceMotion& motion,
                                     const FilmWrench& wrench) {
  const Grid& grid = balance.model().grid;
  const Across weights = across(balance.geometry());
  const Eigen::VectorXd axial = weights.axial.array() - 1, around = weights.around.array() - 1;
  Eigen::VectorXd beyond = Eigen::VectorXd::Zero(grid.n_phi);
  for (int i = 0; i < grid.n_phi; ++i) {
    const int next = std::max(grid.next(i), 0);  // there is no face, and no power, after the end of a patch
    for (int j = 0; j < grid.n_z; ++j) {
      const int k = grid.index(i, j);
      const double to_next = 0.5 * around[j] * pressure_power(balance, balance.face_after(i, j));
      const auto [other, fraction] = balance.split_of_dissipation(k);
      const double by_tie = around[j] * balance.supply_dissipation(k);
      beyond[i] += around[j] * balance.area(k) * sliding_power(balance, wrench, motion, k) + to_next;
      beyond[next] += to_next;
      beyond[i] += (1 - fraction) * by_tie;
      beyond[other / grid.n_z] += fraction * by_tie;
      if (j + 1 < grid.n_z) beyond[i] += axial[j] * pressure_power(balance, balance.face_above(i, j));
    }
  }
  return beyond;
}

void add_powers(const FlowBalance& balance, const SurfaceMotion& motion, const FilmWrench& wrench, FilmObservables& o) {
  const FilmModel& model = balance.model();
  const Grid& grid = model.grid;
  const GridGeometry& geometry = balance.geometry();
  const auto [axial, around] = across(geometry);
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      const int k = grid.index(i, j);
      const Node& node = balance.nodes()[k];
      const double area = geometry.weight(i, j);
      const double work = oil_work(model.lubricant, node.wall - model.p_cav);
      const double sliding = area * full_sliding_power(balance, wrench, motion, k);
      o.power_film_other_shear +=
          (node.other_sheared_fraction - node.sheared_fraction) * sliding;  // the terms below do not depend on it
      o.power_film += node.sheared_fraction * sliding +
                      around[j] * (pressure_power(balance, balance.face_after(i, j)) + balance.supply_dissipation(k));
      if (j + 1 < grid.n_z) o.power_film += axial[j] * pressure_power(balance, balance.face_above(i, j));
      o.power_film += balance.power_over_land(k);
      o.power_asperity += area * node.asperity * wrench.friction_power_per_contact(j);
      // The supply feeds oil at its own pressure: the way to the node dissipates (FlowBalance::supply_dissipation).
      if (balance.is_on_supply(k))
        o.power_oil -= oil_work(model.lubricant, balance.supply_unknown(k)) * balance.supply(k);
      o.power_oil += work * balance.outflow(k) - oil_over_land(balance, k);
      o.power_stored +=
          area * (work * balance.storage(k) / balance.area(k) - (node.wall + node.asperity) * motion.g_rate[k]);
    }
  }
  o.power_film_other_shear += o.power_film;
}

}  // namespace hersey::film
