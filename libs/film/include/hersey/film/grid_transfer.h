#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/film/grid.h"

namespace hersey::film {

/// Returns the grid of half as many nodes in each direction, in the same pattern of spacing.
[[nodiscard]] Grid half_of(const Grid& grid);

/// True if half the nodes still resolve a film.
[[nodiscard]] bool can_be_coarsened(const Grid& grid);

/// Interpolates fields of one grid on another, linearly between the nodes.
class GridTransfer {
 public:
  /// Interpolates between grids of one pattern of spacing: fields are functions of the fraction of the way around the
  /// bearing and across it, counted in nodes, as for resampled().
  GridTransfer(const Grid& from, const Grid& to);
  /// Interpolates between any two rings or grids of the same patches: fields are functions of phi and z.
  [[nodiscard]] static GridTransfer by_position(const Grid& from, const Grid& to);

  /// Interpolates a field. @param field  shape (from.size() per_node), `per_node` values of each node side by side
  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& field, int per_node = 1) const;
  /// Interpolates what has one value at each angle. @param values  shape (from.n_phi, any)
  [[nodiscard]] Eigen::MatrixXd around(const Eigen::MatrixXd& values) const;
  /// Interpolates what has one value at each axial position. @param values  shape (from.n_z, any)
  [[nodiscard]] Eigen::MatrixXd along(const Eigen::MatrixXd& values) const;

 private:
  struct Between {
    int first = 0, second = 0;
    double weight = 0;  ///< of the second
  };
  void lay_around_ring(const Grid& from, const Grid& to);
  void lay_around_patches(const Grid& from, const Grid& to);
  explicit GridTransfer(const Grid& from) : n_phi_(from.n_phi), n_z_(from.n_z) {}
  [[nodiscard]] static Eigen::MatrixXd between(const std::vector<Between>& positions, const Eigen::MatrixXd& values);

  int n_phi_, n_z_;  // of the grid that fields are taken from
  std::vector<Between> around_, along_;
};

}  // namespace hersey::film
