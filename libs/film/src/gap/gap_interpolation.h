#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "gap/grid_geometry.h"
#include "hersey/core/packed.h"
#include "hersey/film/grid.h"

namespace hersey::film {

/// Interpolates gap and motion of surfaces between the nodes of a grid (theory manual, film.13 and film.14): values on
/// the faces around the bearing and means over the control volumes, from nodal values. Both are exact for a round
/// journal at any position in a round bore, on every grid: a gap that travels around the bearing then takes as much oil
/// out of every control volume by its rate as it brings in over the faces. On a plane they are exact for powers of phi
/// instead. At the end of a patch they use the nodes inside it. Along z gaps are straight or nearly so, and nodal
/// values and their means are used.
class GapInterpolation {
 public:
  GapInterpolation(const Grid& grid, const GridGeometry& geometry);

  /// Computes the excess of a field over the mean of both nodes on the faces after each node around the bearing, shape
  /// (grid.size()).
  void bends(const Eigen::VectorXd& field, Eigen::VectorXd& bends) const;

  /// Returns the excess on the face after node (i, j) alone.
  [[nodiscard]] double bend(const Eigen::VectorXd& field, int i, int j) const;

  /// Computes the excess of the field's mean over each control volume over the value at its node, shape (grid.size()).
  void excesses(const Eigen::VectorXd& field, Eigen::VectorXd& excesses) const;

  /// Adds to fields what bends() and excesses() make of them, transposed: of as many columns as are packed, whose
  /// numbers at a node follow one another.
  HERSEY_KERNEL void add_transposed_bends(const double* bends, double* fields) const {
    add_transposed(face_, bends, fields);
  }
  HERSEY_KERNEL void add_transposed_excesses(const double* excesses, double* fields) const {
    add_transposed(cell_, excesses, fields);
  }

  /// Calls act(node, weight) for the nodes whose values make the excess on the face after node (i, j).
  template <class Act>
  void for_each_of_bend(int i, int j, const Act& act) const {
    const Lines<4>& f = face_[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < 4; ++k) act(f.line[k] * n_z_ + j, f.weight[k]);
  }

  /// Nodes of a line along the axis.
  [[nodiscard]] Eigen::Index line_size() const { return n_z_; }

 private:
  /// Weights of some lines.
  template <std::size_t N>
  struct Lines {
    std::array<int, N> line{};
    std::array<double, N> weight{};
  };
  template <std::size_t N>
  void sum(const std::vector<Lines<N>>& of, const Eigen::VectorXd& field, Eigen::VectorXd& sums) const;
  template <std::size_t N>
  HERSEY_KERNEL void add_transposed(const std::vector<Lines<N>>& of, const double* sums, double* fields) const {
    const auto numbers = static_cast<std::ptrdiff_t>(n_z_) * Packed::width;
    for (std::size_t i = 0; i < of.size(); ++i) {
      const double* const sum = sums + static_cast<std::ptrdiff_t>(i) * numbers;
      for (std::size_t k = 0; k < N; ++k) {
        double* const at = fields + of[i].line[k] * numbers;
        for (std::ptrdiff_t j = 0; j < numbers; j += Packed::width)
          (Packed::load(at + j) + of[i].weight[k] * Packed::load(sum + j)).store(at + j);
      }
    }
  }

  int n_z_;
  std::vector<Lines<4>> face_;  ///< bend on the face after each line; without weights where there is none
  std::vector<Lines<3>> cell_;  ///< excess over each line's volumes
};

}  // namespace hersey::film
