#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "gap/grid_geometry.h"
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

 private:
  /// Weights of some lines.
  template <std::size_t N>
  struct Lines {
    std::array<int, N> line{};
    std::array<double, N> weight{};
  };
  template <std::size_t N>
  void sum(const std::vector<Lines<N>>& of, const Eigen::VectorXd& field, Eigen::VectorXd& sums) const;

  int n_z_;
  std::vector<Lines<4>> face_;  ///< bend on the face after each line; without weights where there is none
  std::vector<Lines<3>> cell_;  ///< excess over each line's volumes
};

}  // namespace hersey::film
