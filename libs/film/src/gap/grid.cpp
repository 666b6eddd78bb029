#include "hersey/film/grid.h"

#include <algorithm>
#include <cmath>

#include "hersey/core/contract.h"
#include "hersey/core/two_pi.h"

namespace hersey::film {
namespace {

// Points per node of the table by which a density is integrated; the positions of nodes are then exact to 1e-4 of a
// cell.
constexpr int points_per_node = 32;

/// Returns the positions of `count` nodes between `first` and `last`, between which equal parts of the integral of
/// `density` lie; the last node lies on `last`.
template <class Density>
std::vector<double> equal_parts(int count, double first, double last, Density&& density) {
  const int points = points_per_node * count;
  const double step = (last - first) / points;
  std::vector<double> integral(points + 1, 0.0);
  for (int k = 0; k < points; ++k) integral[k + 1] = integral[k] + step * density(first + (k + 0.5) * step);
  std::vector<double> nodes(count);
  int k = 0;
  for (int i = 0; i < count; ++i) {
    const double fraction = integral.back() * i / (count - 1);
    while (k + 1 < points && integral[k + 1] < fraction) ++k;
    nodes[i] = first + step * (k + (fraction - integral[k]) / (integral[k + 1] - integral[k]));
  }
  nodes.front() = first, nodes.back() = last;
  return nodes;
}

/// Returns the density of nodes that a refinement adds (film.11).
double density_at(double distance, const Refinement& r) {
  const double ratio = distance / r.reach;
  return (r.factor - 1) / (1 + ratio * ratio);
}

/// Returns positions at fractional indices, interpolated linearly between the nodes.
double between(const std::vector<double>& nodes, double index) {
  const int last = static_cast<int>(nodes.size()) - 1;
  const int below = std::clamp(static_cast<int>(std::floor(index + 1e-9)), 0, last - 1);
  const double t = index - below;
  return t < 1e-9 ? nodes[below] : (1 - t) * nodes[below] + t * nodes[below + 1];
}

void check(const std::vector<Refinement>& positions) {
  for (const Refinement& r : positions)
    HERSEY_REQUIRE(r.reach > 0 && r.factor >= 1, "a refinement has reach and factor");
}

}  // namespace

double mean_step(const Grid& grid) {
  if (grid.closes()) return two_pi / grid.n_phi;
  double sum = 0;
  for (int i = 0; i < grid.n_phi; ++i)
    if (grid.next(i) >= 0) sum += grid.phi(i + 1) - grid.phi(i);
  return sum / (grid.n_phi - static_cast<int>(grid.patches.size()));
}

Grid graded_grid(int n_phi, int n_z, const std::vector<Refinement>& around, const std::vector<Refinement>& along) {
  check(around), check(along);
  Grid grid{.n_phi = n_phi, .n_z = n_z};
  if (!around.empty()) {
    const auto density = [&](double phi) {
      double sum = 1;
      for (const Refinement& r : around) sum += density_at(std::remainder(phi - r.position, two_pi), r);
      return sum;
    };
    grid.angles = equal_parts(n_phi + 1, 0, two_pi, density);
    grid.angles.pop_back();
  }
  if (!along.empty()) {
    const auto density = [&](double z) {
      double sum = 1;
      for (const Refinement& r : along) sum += density_at(z - r.position, r);
      return sum;
    };
    grid.heights = equal_parts(n_z, -0.5, 0.5, density);
  }
  return grid;
}

Grid patch_grid(const std::vector<Patch>& patches, int n_z) {
  Grid grid{.n_phi = 0, .n_z = n_z};
  for (const Patch& patch : patches) {
    HERSEY_REQUIRE(patch.lines >= 4 && patch.from < patch.to, "a patch has four lines and a length");
    grid.patches.push_back(grid.n_phi);
    for (int k = 0; k < patch.lines; ++k)
      grid.angles.push_back(patch.from + (patch.to - patch.from) * k / (patch.lines - 1));
    grid.n_phi += patch.lines;
  }
  return grid;
}

Grid resampled(const Grid& grid, int n_phi, int n_z) {
  HERSEY_REQUIRE(grid.patches.size() <= 1 || n_phi == grid.n_phi, "a ring or one patch: several keep their lines");
  Grid other{.n_phi = n_phi, .n_z = n_z};
  other.patches = grid.patches;
  if (!grid.closes() && n_phi == grid.n_phi) {
    other.angles = grid.angles;
  } else if (!grid.closes()) {
    for (int i = 0; i < n_phi; ++i)
      other.angles.push_back(between(grid.angles, static_cast<double>(i) * (grid.n_phi - 1) / (n_phi - 1)));
    other.angles.back() = grid.angles.back();
  } else if (!grid.angles.empty()) {
    std::vector<double> full_circle = grid.angles;
    full_circle.push_back(grid.angles.front() + two_pi);
    other.angles.resize(n_phi);
    for (int i = 0; i < n_phi; ++i) {
      other.angles[i] = between(full_circle, static_cast<double>(i) * grid.n_phi / n_phi);
    }
  }
  if (!grid.heights.empty()) {
    other.heights.resize(n_z);
    for (int j = 0; j < n_z; ++j) {
      other.heights[j] = between(grid.heights, static_cast<double>(j) * (grid.n_z - 1) / (n_z - 1));
    }
    other.heights.back() = 0.5;
  }
  return other;
}

Grid turned(const Grid& grid, double fraction) {
  HERSEY_REQUIRE(grid.closes() && fraction >= 0 && fraction < 1, "a ring, and a fraction of its cells");
  Grid other = grid;
  other.angles.resize(grid.n_phi);
  for (int i = 0; i < grid.n_phi; ++i) {
    const double next = i + 1 < grid.n_phi ? grid.phi(i + 1) : grid.phi(0) + two_pi;
    other.angles[i] = grid.phi(i) + fraction * (next - grid.phi(i));
  }
  return other;
}

}  // namespace hersey::film
