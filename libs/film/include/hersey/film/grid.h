#pragma once

#include <algorithm>
#include <numbers>
#include <vector>

namespace hersey::film {

/// Nodes on lines phi = const and rows z = const; the first and last rows lie on the film's edges. The index of node
/// (i, j) is i n_z + j. Without positions of its own it is equally spaced: phi_i = 2 pi i/n_phi and
/// z_j = -L/2 + L j/(n_z - 1). Without patches it closes to a ring: after the last line comes the first.
struct Grid {
  int n_phi = 60;                    ///< >= 4
  int n_z = 13;                      ///< >= 3
  std::vector<double> angles = {};   ///< ascending within 2 pi [rad], n_phi of them; empty: equally spaced
  std::vector<double> heights = {};  ///< z/L, ascending from -1/2 to 1/2, n_z of them; empty: equally spaced
  /// Lines with which patches of film begin, ascending from 0; each ends with the line before the next one, on which,
  /// as on its first, an edge lies. They need angles. Empty: a ring.
  std::vector<int> patches = {};

  /// True if it is a ring.
  [[nodiscard]] bool closes() const { return patches.empty(); }
  /// The line after line i in the direction of growing phi; -1: an edge lies there.
  [[nodiscard]] int next(int i) const {
    const int after = i + 1 < n_phi ? i + 1 : 0;
    return begins_patch(after) ? -1 : after;
  }
  /// The line before line i; -1: an edge lies there.
  [[nodiscard]] int before(int i) const { return begins_patch(i) ? -1 : i > 0 ? i - 1 : n_phi - 1; }
  /// True if a patch begins with line i.
  [[nodiscard]] bool begins_patch(int i) const { return std::find(patches.begin(), patches.end(), i) != patches.end(); }
  /// True if line i is the first or the last of a patch.
  [[nodiscard]] bool is_end(int i) const { return next(i) < 0 || before(i) < 0; }
  /// The patch with line i.
  [[nodiscard]] int patch_of(int i) const {
    return static_cast<int>(std::upper_bound(patches.begin(), patches.end(), i) - patches.begin()) - 1;
  }

  /// Number of nodes.
  [[nodiscard]] int size() const { return n_phi * n_z; }
  /// Index of node (i, j) in all fields.
  [[nodiscard]] int index(int i, int j) const { return i * n_z + j; }
  [[nodiscard]] double phi(int i) const {
    return angles.empty() ? 2 * std::numbers::pi * i / n_phi : angles[i];
  }  ///< [rad]
  /// z/L of row j [-], from -1/2 to 1/2.
  [[nodiscard]] double z_over_L(int j) const {
    return heights.empty() ? static_cast<double>(j) / (n_z - 1) - 0.5 : heights[j];
  }
  /// True if nodes are equally spaced in both directions.
  [[nodiscard]] bool is_uniform() const { return angles.empty() && heights.empty(); }
};

/// Returns the number of the patch on which each line lies, for results, shape (n_phi).
[[nodiscard]] inline std::vector<double> arc_of_lines(const Grid& grid) {
  std::vector<double> arc;
  for (int i = 0; i < grid.n_phi; ++i) arc.push_back(grid.patch_of(i));
  return arc;
}

/// Returns the mean distance of its lines [rad].
[[nodiscard]] double mean_step(const Grid& grid);

/// A position towards which cells get smaller.
struct Refinement {
  double position = 0;  ///< in the unit of the direction
  double reach = 1;     ///< distance at which half of the refinement has gone, same unit, > 0
  double factor = 1;    ///< by which the cells at the position are smaller than far away, >= 1
};

/// A patch of film from one angle to another [rad].
struct Patch {
  double from = 0, to = 1;
  int lines = 30;  ///< >= 4, those on its edges included
};

/// Returns a grid of patches in ascending order, equally spaced in each.
[[nodiscard]] Grid patch_grid(const std::vector<Patch>& patches, int n_z);

/// Returns a grid with cells that shrink smoothly towards the positions given: the density of nodes is 1 + sum of
/// (factor - 1)/(1 + (distance/reach)^2). Refining it keeps its pattern, so that errors fall with their order.
/// @param around  positions in phi [rad].
/// @param along   positions in z/L [-].
[[nodiscard]] Grid graded_grid(int n_phi, int n_z, const std::vector<Refinement>& around,
                               const std::vector<Refinement>& along);

/// Returns a grid of patches with cells that shrink towards the positions given, as those of a ring do.
[[nodiscard]] Grid graded_grid(const std::vector<Patch>& patches, int n_z, const std::vector<Refinement>& around,
                               const std::vector<Refinement>& along);

/// Returns the grid with about half as many lines and rows: every second one where their number allows it, of each
/// patch by itself.
[[nodiscard]] Grid halved(const Grid& grid);

/// Returns a grid of the same pattern of spacing with other numbers of nodes. Where they divide, nodes of the coarser
/// grid are nodes of the finer one.
[[nodiscard]] Grid resampled(const Grid& grid, int n_phi, int n_z);

/// Returns the same grid with its lines further on by `fraction` of the cell before the next one; patches keep their
/// ends and, for a fraction above 0, get one line more. The mean over several fractions has a higher order in figures
/// that depend on the position of fronts between lines.
/// @param fraction  0 to below 1.
[[nodiscard]] Grid turned(const Grid& grid, double fraction);

}  // namespace hersey::film
