#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/film/grid.h"

namespace hersey::film {

/// The grid of half as many nodes in each direction, in the same pattern of spacing.
[[nodiscard]] Grid half_of(const Grid& grid);

/// Whether a film is left with a shape on half the nodes.
[[nodiscard]] bool can_be_coarsened(const Grid& grid);

/// Fields on one grid from those on another of the same pattern of spacing, linearly between the nodes. Both are taken
/// as functions of the share of the way around the bearing and across it, counted in nodes: on the places of
/// resampled().
class GridTransfer {
 public:
  /// Between these grids.
  GridTransfer(const Grid& from, const Grid& to);
  /// @param field  shape (from.size() per_node), `per_node` values of each node side by side
  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& field, int per_node = 1) const;
  /// Of what has one value at each angle. @param values  shape (from.n_phi)
  [[nodiscard]] Eigen::VectorXd around(const Eigen::VectorXd& values) const;

 private:
  struct Between {
    int first = 0, second = 0;
    double share = 0;  ///< of the second
  };
  int n_z_;
  std::vector<Between> around_, along_;
};

}  // namespace hersey::film
