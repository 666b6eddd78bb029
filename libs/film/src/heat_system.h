#pragma once

#include <Eigen/Dense>
#include <array>
#include <utility>
#include <vector>

#include "hersey/film/grid.h"
#include "hersey/solver/sparse_lu.h"

namespace hersey::film {

/// The linear system of a film's layers and of a ring around it, row by row: each layer is coupled to those below and
/// above it, to the same one of the four neighbouring nodes, and the lowest to the ring. Rows: layers node by node, then
/// the ring's angles.
class HeatSystem {
 public:
  /// Neighbours of a node: before and after it around the bearing and along the axis.
  enum Side { before, after, left, right };

  HeatSystem(const Grid& grid, int layers, bool has_ring);

  [[nodiscard]] int size() const { return static_cast<int>(row_start_.size()) - 1; }
  [[nodiscard]] int row(int node, int layer) const { return node * layers_ + layer; }
  [[nodiscard]] int ring_row(int i) const { return nodes_ * layers_ + i; }

  void set_zero();
  [[nodiscard]] double& diagonal(int row) { return values_[diagonal_[row]]; }
  [[nodiscard]] double& below(int node, int layer) { return values_[layer_[row(node, layer)][4]]; }
  [[nodiscard]] double& above(int node, int layer) { return values_[layer_[row(node, layer)][5]]; }
  [[nodiscard]] double& beside(int node, int layer, Side side) { return values_[layer_[row(node, layer)][side]]; }
  [[nodiscard]] double& to_ring(int node) { return values_[layer_[row(node, 0)][6]]; }
  [[nodiscard]] double& from_film(int i, int j) { return values_[ring_[i][2 + j]]; }
  [[nodiscard]] double& ring_before(int i) { return values_[ring_[i][0]]; }
  [[nodiscard]] double& ring_after(int i) { return values_[ring_[i][1]]; }

  /// One row by itself: columns and entries.
  using Row = std::vector<std::pair<int, double>>;
  [[nodiscard]] Row entries(int row) const;
  /// Multiplies a row.
  void scale(int row, double factor);

  /// False where the system is singular.
  [[nodiscard]] bool factorise();
  /// Overwrites right-hand sides, a column each, with their solutions.
  void solve(Eigen::MatrixXd& b) const;

 private:
  int nodes_, layers_;
  std::vector<int> row_start_, column_;
  std::vector<int> diagonal_;
  std::vector<std::array<int, 7>> layer_;  ///< slots of the four sides, below, above, ring; one beyond where there is none
  std::vector<std::vector<int>> ring_;     ///< slots of before, after, then of the nodes at that angle
  std::vector<double> values_;             ///< one more than the pattern
  solver::SparseLu lu_;
};

}  // namespace hersey::film
