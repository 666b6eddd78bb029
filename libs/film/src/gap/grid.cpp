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

namespace {

/// Density of nodes at an angle of a ring.
double density_around(double phi, const std::vector<Refinement>& around) {
  double sum = 1;
  for (const Refinement& r : around) sum += density_at(std::remainder(phi - r.position, two_pi), r);
  return sum;
}

std::vector<double> graded_heights(int n_z, const std::vector<Refinement>& along) {
  if (along.empty()) return {};
  return equal_parts(n_z, -0.5, 0.5, [&](double z) {
    double sum = 1;
    for (const Refinement& r : along) sum += density_at(z - r.position, r);
    return sum;
  });
}

}  // namespace

Grid graded_grid(int n_phi, int n_z, const std::vector<Refinement>& around, const std::vector<Refinement>& along) {
  check(around), check(along);
  Grid grid{.n_phi = n_phi, .n_z = n_z, .heights = graded_heights(n_z, along)};
  if (around.empty()) return grid;
  grid.angles = equal_parts(n_phi + 1, 0, two_pi, [&](double phi) { return density_around(phi, around); });
  grid.angles.pop_back();
  return grid;
}

Grid graded_grid(const std::vector<Patch>& patches, int n_z, const std::vector<Refinement>& around,
                 const std::vector<Refinement>& along) {
  check(around), check(along);
  Grid grid = patch_grid(patches, n_z);
  grid.heights = graded_heights(n_z, along);
  for (std::size_t p = 0; p < patches.size() && !around.empty(); ++p) {
    const Patch& patch = patches[p];
    const std::vector<double> lines =
        equal_parts(patch.lines, patch.from, patch.to, [&](double phi) { return density_around(phi, around); });
    std::copy(lines.begin(), lines.end(), grid.angles.begin() + grid.patches[p]);
  }
  return grid;
}

Grid halved(const Grid& grid) {
  const int n_z = grid.n_z / 2 + 1;
  if (grid.patches.size() <= 1) return resampled(grid, (grid.n_phi + 1) / 2, n_z);
  Grid half = resampled(grid, grid.n_phi, n_z);
  half.angles.clear(), half.patches.clear();
  for (std::size_t p = 0; p < grid.patches.size(); ++p) {
    const int first = grid.patches[p], end = p + 1 < grid.patches.size() ? grid.patches[p + 1] : grid.n_phi;
    const std::vector<double> lines(grid.angles.begin() + first, grid.angles.begin() + end);
    const int count = std::max(4, (end - first + 1) / 2);
    half.patches.push_back(static_cast<int>(half.angles.size()));
    for (int k = 0; k + 1 < count; ++k)
      half.angles.push_back(between(lines, static_cast<double>(k) * (end - first - 1) / (count - 1)));
    half.angles.push_back(lines.back());
  }
  half.n_phi = static_cast<int>(half.angles.size());
  return half;
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

namespace {

Grid moved_within_patches(const Grid& grid, double fraction) {
  Grid other{.n_phi = 0, .n_z = grid.n_z, .heights = grid.heights};
  for (int i = 0; i < grid.n_phi; ++i) {
    if (grid.begins_patch(i)) {
      other.patches.push_back(static_cast<int>(other.angles.size()));
      other.angles.push_back(grid.phi(i));
    }
    other.angles.push_back(grid.next(i) < 0 ? grid.phi(i) : grid.phi(i) + fraction * (grid.phi(i + 1) - grid.phi(i)));
  }
  other.n_phi = static_cast<int>(other.angles.size());
  return other;
}

}  // namespace

Grid turned(const Grid& grid, double fraction) {
  HERSEY_REQUIRE(fraction >= 0 && fraction < 1, "a fraction of the cells");
  if (!grid.closes()) return fraction > 0 ? moved_within_patches(grid, fraction) : grid;
  Grid other = grid;
  other.angles.resize(grid.n_phi);
  for (int i = 0; i < grid.n_phi; ++i) {
    const double next = i + 1 < grid.n_phi ? grid.phi(i + 1) : grid.phi(0) + two_pi;
    other.angles[i] = grid.phi(i) + fraction * (next - grid.phi(i));
  }
  return other;
}

}  // namespace hersey::film
