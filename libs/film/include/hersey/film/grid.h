#pragma once

#include <numbers>
#include <vector>

namespace hersey::film {

/// Circumferential x axial grid of nodes, periodic in phi; the first and last rows in z lie on the bearing's edges. The
/// index of node (i, j) is i n_z + j. Without places of its own it is equally spaced: phi_i = 2 pi i/n_phi and
/// z_j = -L/2 + L j/(n_z - 1).
struct Grid {
  int n_phi = 60;                    ///< >= 4
  int n_z = 13;                      ///< >= 3
  std::vector<double> angles = {};   ///< ascending within one turn [rad], n_phi of them; empty: equally spaced
  std::vector<double> heights = {};  ///< z/L, ascending from -1/2 to 1/2, n_z of them; empty: equally spaced

  /// Nodes.
  [[nodiscard]] int size() const { return n_phi * n_z; }
  /// Of node (i, j) in all fields.
  [[nodiscard]] int index(int i, int j) const { return i * n_z + j; }
  [[nodiscard]] double phi(int i) const {
    return angles.empty() ? 2 * std::numbers::pi * i / n_phi : angles[i];
  }  ///< [rad]
  /// [-], from -1/2 to 1/2.
  [[nodiscard]] double z_over_L(int j) const {
    return heights.empty() ? static_cast<double>(j) / (n_z - 1) - 0.5 : heights[j];
  }
  /// Whether nodes are equally spaced both ways.
  [[nodiscard]] bool is_uniform() const { return angles.empty() && heights.empty(); }
};

/// A place towards which cells get smaller.
struct Refinement {
  double place = 0;   ///< in the unit of the direction
  double reach = 1;   ///< distance at which half of it has gone, same unit, > 0
  double factor = 1;  ///< by which the cells at the place are smaller than far away, >= 1
};

/// A grid with cells that shrink smoothly towards the places given: the density of nodes is 1 + sum of
/// (factor - 1)/(1 + (distance/reach)^2). Refining it keeps its pattern, so that errors fall with their order.
/// @param around  places in phi [rad].
/// @param along   places in z/L [-].
[[nodiscard]] Grid graded_grid(int n_phi, int n_z, const std::vector<Refinement>& around,
                               const std::vector<Refinement>& along);

/// The same pattern of spacing with other numbers of nodes. Where they divide, nodes of the coarser grid are nodes of
/// the finer one.
[[nodiscard]] Grid resampled(const Grid& grid, int n_phi, int n_z);

}  // namespace hersey::film
