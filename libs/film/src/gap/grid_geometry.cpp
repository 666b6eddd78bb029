#include "gap/grid_geometry.h"

#include <algorithm>
#include <cmath>

#include "hersey/core/contract.h"
#include "hersey/core/two_pi.h"

namespace hersey::film {

int end_of_patch(const Grid& grid, std::size_t patch) {
  return patch + 1 < grid.patches.size() ? grid.patches[patch + 1] : grid.n_phi;
}

namespace {

/// Returns the integrals over [b, c] of the three parabolas through values at 0, b, c that are 1 at one of them, per
/// length.
Eigen::Vector3d over_second_interval(double before, double length) {
  // The parabola through (-before, 0), (0, 1), (length, 0) and the other two are integrated from 0 to length.
  const double s = before + length;
  return {-length * length / (6 * before * s), (length + 3 * before) / (6 * before),
          (2 * length + 3 * before) / (6 * s)};
}

// Every interval counts the mean of the two parabolas that its nodes share with a neighbour on either side: this is
// exact for parabolas, and of fourth order where the spacing is smooth. On equal spacing these are Gregory's end
// corrections. The trapezoidal rule would lose 1/(n - 1)^2 of a film's load across the width.
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

/// Returns the weights of all lines, of a ring or of each patch.
template <class Length>
Eigen::VectorXd weights_of_lines(const Grid& grid, Length&& length) {
  if (grid.closes()) return parabolic_weights(grid.n_phi, true, length);
  Eigen::VectorXd weights(grid.n_phi);
  for (std::size_t p = 0; p < grid.patches.size(); ++p) {
    const int first = grid.patches[p], end = end_of_patch(grid, p);
    weights.segment(first, end - first) =
        parabolic_weights(end - first, false, [&](int k) { return length(first + k); });
  }
  return weights;
}

void check_patches(const FilmModel& model) {
  const Grid& grid = model.grid;
  HERSEY_REQUIRE(grid.closes() ? closes(model.surface) : grid.patches.front() == 0,
                 "a surface that does not close carries patches, the first from the first line");
  HERSEY_REQUIRE(grid.closes() || !grid.angles.empty(), "patches have angles");
  HERSEY_REQUIRE(model.ends.size() == grid.patches.size(), "two ends for every patch");
  for (std::size_t p = 0; p < grid.patches.size(); ++p) {
    HERSEY_REQUIRE(end_of_patch(grid, p) - grid.patches[p] >= 4, "a patch has four lines at least");
  }
}

void check_grid(const FilmModel& model) {
  const Grid& grid = model.grid;
  HERSEY_REQUIRE(grid.n_phi >= 4 && grid.n_z >= 3, "the grid needs 4 x 3 nodes at least");
  HERSEY_REQUIRE(grid.angles.empty() || static_cast<int>(grid.angles.size()) == grid.n_phi, "an angle for every node");
  HERSEY_REQUIRE(grid.heights.empty() || static_cast<int>(grid.heights.size()) == grid.n_z, "a height for every node");
  check_patches(model);
}

}  // namespace

GridGeometry::GridGeometry(const FilmModel& model) : R(model.R), surface(model.surface) {
  const Grid& grid = model.grid;
  check_grid(model);
  const int n_phi = grid.n_phi, n_z = grid.n_z;
  phi.resize(n_phi), dx.setZero(n_phi), width_phi.setZero(n_phi);
  z.resize(n_z), dz.resize(n_z - 1), width_z.setZero(n_z);
  for (int i = 0; i < n_phi; ++i) phi[i] = grid.phi(i);
  for (int j = 0; j < n_z; ++j) z[j] = model.L * grid.z_over_L(j);
  const bool even_phi = grid.angles.empty(), even_z = grid.heights.empty();
  int intervals = 0;
  for (int i = 0; i < n_phi; ++i) {
    if (grid.next(i) < 0) continue;
    const double next = i + 1 < n_phi ? phi[i + 1] : phi[0] + two_pi;
    dx[i] = even_phi ? two_pi * R / n_phi : R * (next - phi[i]);
    HERSEY_REQUIRE(dx[i] > 0, "the grid's nodes ascend");
    ++intervals;
  }
  mean_dx = grid.closes() ? two_pi * R / n_phi : dx.sum() / intervals;
  mean_dz = model.L / (n_z - 1);
  for (int i = 0; i < n_phi; ++i) width_phi[i] = 0.5 * (dx[i] + (grid.before(i) < 0 ? 0 : dx[grid.before(i)]));
  for (int j = 0; j + 1 < n_z; ++j) {
    dz[j] = even_z ? mean_dz : z[j + 1] - z[j];
    width_z[j] += 0.5 * dz[j];
    width_z[j + 1] += 0.5 * dz[j];
  }
  HERSEY_REQUIRE(dz.minCoeff() > 0, "the grid's nodes ascend");
  weight_phi = weights_of_lines(grid, [&](int k) { return dx[k]; });
  weight_z = parabolic_weights(n_z, false, [&](int k) { return dz[k]; });
  stretch.resize(n_z), stretch_over.resize(n_z), stretch_between.resize(n_z - 1);
  const auto stretch_at = [&](double position) { return film::stretch(surface, R, position); };
  for (int j = 0; j < n_z; ++j) {
    const double below = j > 0 ? 0.5 * dz[j - 1] : 0, above = j + 1 < n_z ? 0.5 * dz[j] : 0;
    stretch[j] = stretch_at(z[j]);
    stretch_over[j] = stretch_at(z[j] + 0.5 * (above - below));
    if (j + 1 < n_z) stretch_between[j] = stretch_at(z[j] + above);
  }
  HERSEY_REQUIRE(stretch.minCoeff() > 0, "an annulus has an inner radius");
}

double GridGeometry::from_to(double from, double to) const {
  return closes(surface) ? std::remainder(to - from, two_pi) : to - from;
}

double GridGeometry::reported_angle(double angle) const {
  return closes(surface) ? std::fmod(std::fmod(angle, two_pi) + two_pi, two_pi) : angle;
}

GridGeometry::Location GridGeometry::locate(double angle) const {
  const auto n = static_cast<int>(phi.size());
  // An angle just below a node counts as on it, so that round-off decides nothing.
  const double sliver = 1e-9 * two_pi / n;
  double along = angle + sliver - phi[0];
  if (closes(surface)) along = std::fmod(along, two_pi);
  if (closes(surface) && along < 0) along += two_pi;
  const double at = phi[0] + along;
  const int node = std::max(static_cast<int>(std::upper_bound(phi.begin(), phi.end(), at) - phi.begin()) - 1, 0);
  if (dx[node] == 0) return {node - 1, 1};
  const double next = node + 1 < n ? phi[node + 1] : phi[0] + two_pi;
  return {node, std::max(0.0, at - sliver - phi[node]) / (next - phi[node])};
}

}  // namespace hersey::film
