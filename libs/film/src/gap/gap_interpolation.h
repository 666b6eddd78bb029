#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "gap/grid_geometry.h"
#include "hersey/film/grid.h"

namespace hersey::film {

/// Gap and motion of surfaces between the nodes of a grid (theory manual, film.13 and film.14): values on the faces
/// around the bearing and means over the control volumes, from nodal values. Both are exact for a round journal
/// anywhere in a round bore, whatever the grid: a gap that travels around the bearing then takes as much oil out of
/// every control volume by its rate as it brings in over the faces. Along z, where gaps are straight or nearly so,
/// nodal values and their means do.
class GapInterpolation {
 public:
  GapInterpolation(const Grid& grid, const GridGeometry& geometry);

  /// By how much a field exceeds the mean of both nodes on the faces after each node around the bearing: shape
  /// (grid.size()).
  void bends(const Eigen::VectorXd& field, Eigen::VectorXd& bends) const;

  /// The same on the face after node (i, j) alone.
  [[nodiscard]] double bend(const Eigen::VectorXd& field, int i, int j) const;

  /// By how much its mean over each control volume exceeds the value at the node: shape (grid.size()).
  void excesses(const Eigen::VectorXd& field, Eigen::VectorXd& excesses) const;

 private:
  int n_phi_, n_z_;
  std::vector<std::array<double, 4>> face_;  ///< weights of nodes i - 1 to i + 2 on the face after node i
  std::vector<std::array<double, 3>> cell_;  ///< weights of nodes i - 1 to i + 1 in the mean over volume i
};

}  // namespace hersey::film
