#include "gap/grid_geometry.h"

#include <algorithm>
#include <cmath>

#include "hersey/core/contract.h"
#include "hersey/core/turn.h"

namespace hersey::film {
namespace {

/// Integrals over [b, c] of the three parabolas through values at 0, b, c that are 1 at one of them, per length.
Eigen::Vector3d over_second_interval(double before, double length) {
  // The parabola through (-before, 0), (0, 1), (length, 0) and its kin, integrated from 0 to length.
  const double s = before + length;
  return {-length * length / (6 * before * s), (length + 3 * before) / (6 * before),
          (2 * length + 3 * before) / (6 * s)};
}

// Every interval counts the mean of the two parabolas that its nodes share with a neighbour on either side: exact for
// parabolas, fourth order where the spacing is smooth. On equal spacing these are Gregory's end corrections. The
// trapezoidal rule would lose 1/(n - 1)^2 of a film's load across the width.
template <class Length>
Eigen::VectorXd parabolic_weights(int n, bool periodic, Length&& length) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(n);
  const int intervals = periodic ? n : n - 1;
  const auto wrap = [n](int i) { return (i % n + n) % n; };
  for (int k = 0; k < intervals; ++k) {
    const double here = length(k);
    const bool has_before = periodic || k > 0, has_after = periodic || k + 2 < n;
    const double half = has_before && has_after ? 0.5 : 1.0;
    if (has_before) {
      const Eigen::Vector3d w = half * here * over_second_interval(length(wrap(k - 1)), here);
      weights[wrap(k - 1)] += w[0], weights[k] += w[1], weights[wrap(k + 1)] += w[2];
    }
    if (has_after) {
      const Eigen::Vector3d w = half * here * over_second_interval(length(wrap(k + 1)), here);
      weights[wrap(k + 2)] += w[0], weights[wrap(k + 1)] += w[1], weights[k] += w[2];
    }
  }
  return weights;
}

void check(const Grid& grid) {
  HERSEY_REQUIRE(grid.n_phi >= 4 && grid.n_z >= 3, "the grid needs 4 x 3 nodes at least");
  HERSEY_REQUIRE(grid.angles.empty() || static_cast<int>(grid.angles.size()) == grid.n_phi, "an angle for every node");
  HERSEY_REQUIRE(grid.heights.empty() || static_cast<int>(grid.heights.size()) == grid.n_z, "a height for every node");
}

}  // namespace

GridGeometry::GridGeometry(const FilmModel& model) {
  const Grid& grid = model.grid;
  check(grid);
  const int n_phi = grid.n_phi, n_z = grid.n_z;
  phi.resize(n_phi), dx.resize(n_phi), width_phi.resize(n_phi);
  z.resize(n_z), dz.resize(n_z - 1), width_z.setZero(n_z);
  for (int i = 0; i < n_phi; ++i) phi[i] = grid.phi(i);
  for (int j = 0; j < n_z; ++j) z[j] = model.L * grid.z_over_L(j);
  mean_dx = turn * model.R / n_phi;
  mean_dz = model.L / (n_z - 1);
  const bool even_phi = grid.angles.empty(), even_z = grid.heights.empty();
  for (int i = 0; i < n_phi; ++i) {
    const double next = i + 1 < n_phi ? phi[i + 1] : phi[0] + turn;
    dx[i] = even_phi ? mean_dx : model.R * (next - phi[i]);
  }
  for (int i = 0; i < n_phi; ++i) width_phi[i] = 0.5 * (dx[i] + dx[(i + n_phi - 1) % n_phi]);
  for (int j = 0; j + 1 < n_z; ++j) {
    dz[j] = even_z ? mean_dz : z[j + 1] - z[j];
    width_z[j] += 0.5 * dz[j];
    width_z[j + 1] += 0.5 * dz[j];
  }
  HERSEY_REQUIRE(dx.minCoeff() > 0 && dz.minCoeff() > 0, "the grid's nodes ascend");
  weight_phi = parabolic_weights(n_phi, true, [&](int k) { return dx[k]; });
  weight_z = parabolic_weights(n_z, false, [&](int k) { return dz[k]; });
}

GridGeometry::Place GridGeometry::place_of(double angle) const {
  const auto n = static_cast<int>(phi.size());
  // Just below a node counts as on it: round-off decides nothing.
  const double sliver = 1e-9 * turn / n;
  double along = std::fmod(angle + sliver - phi[0], turn);
  if (along < 0) along += turn;
  const double at = phi[0] + along;
  const int node = static_cast<int>(std::upper_bound(phi.begin(), phi.end(), at) - phi.begin()) - 1;
  const double next = node + 1 < n ? phi[node + 1] : phi[0] + turn;
  return {node, std::max(0.0, at - sliver - phi[node]) / (next - phi[node])};
}

}  // namespace hersey::film
