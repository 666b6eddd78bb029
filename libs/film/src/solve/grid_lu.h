#pragma once

#include <span>
#include <vector>

#include "hersey/film/grid.h"
#include "hersey/solver/frontal_lu.h"
#include "hersey/solver/sparse_lu.h"

namespace hersey::film {

/// Returns the nodes of a grid in groups that are eliminated one after the other, a nested dissection: lines of nodes
/// that part the grid come after the parts, down to parts of a few nodes.
/// @see George (1973), SIAM J. Numer. Anal. 10(2), 345-363
[[nodiscard]] std::vector<std::vector<int>> nested_dissection(const Grid& grid);

/// LU of matrices in the pattern of a grid: by fronts along its nested dissection, or with pivots of the whole matrix
/// where those of the groups do not suffice.
class GridLu {
 public:
  explicit GridLu(const Grid& grid) : grid_(grid) {}

  /// Takes the pattern, which stays the caller's.
  void analyse(std::span<const int> column_start, std::span<const int> row_index);
  [[nodiscard]] bool is_analysed() const { return fronts_.size() != 0; }
  /// Returns false if the matrix is singular to working precision.
  [[nodiscard]] bool factorise(std::span<const double> values);
  /// Overwrites `columns` right-hand sides, stored one after the other, by the solutions.
  void solve(std::span<double> b, int columns = 1);
  void solve_transposed(std::span<double> b, int columns = 1);
  /// Returns the operations in floating point of a factor by fronts.
  [[nodiscard]] double operations() const { return fronts_.operations(); }
  /// Saves or restores the pivots of the whole matrix, which the next such factor reuses.
  void persist(Archive& archive) { pivoting_.persist(archive); }

 private:
  const Grid& grid_;
  std::span<const int> column_start_, row_index_;
  solver::FrontalLu fronts_;
  solver::SparseLu pivoting_;
  bool pivots_in_groups_ = true;  ///< the last factor is that of the fronts
};

}  // namespace hersey::film
