#pragma once

#include <vector>

#include "hersey/solver/sparse_lu.h"
#include "solve/line_operator.h"

namespace hersey::film {

/// Multigrid for operators on a ring of lines (theory manual, film.37): Gauss-Seidel by whole lines along the flow,
/// every second line kept on the next coarser grid, all nodes of a line kept, so that a strong coupling along the lines
/// is solved exactly and one across them is left to coarser grids, whatever the shape of the cells. Transfers and
/// coarse operators follow from the matrix alone: the rows of a line left out express it by its two neighbours for
/// fields that do not vary along the line, and the coarse matrix is R A P.
class Multigrid {
 public:
  Multigrid(int lines, int nodes_per_line);

  /// Finest operator, to be filled before setup(). Rows of inactive nodes are to be those of the identity.
  [[nodiscard]] LineOperator& finest() { return levels_.front().A; }

  /// @param active     nodes that take part in coarser grids, one entry per node of the finest
  /// @param ascending  true if the flow runs towards growing line numbers
  /// @returns false where a line's own block or the coarsest matrix is singular
  [[nodiscard]] bool setup(const std::vector<char>& active, bool ascending);

  /// Applies one V-cycle from zero: an approximate solution of A x = b, for one right-hand side or several abreast.
  template <class Value>
  void cycle(const LineVectorOf<Value>& b, LineVectorOf<Value>& x);

 private:
  struct Level {
    LineOperator A;
    std::vector<char> active;
    // Interpolation to a node from the coarse line at or before it and from the one after, and the restriction of its
    // residual to these.
    LineVector p_before, p_after, r_before, r_after;
  };
  /// Vectors of a cycle on one level; x and b of the finest are the caller's.
  template <class Value>
  struct Scratch {
    LineVectorOf<Value> x, b, residual;
  };
  static void weigh(Level& fine, LineVector& scratch);
  static void coarsen(const Level& fine, Level& coarse);
  [[nodiscard]] bool factorise_coarsest();
  template <class Value>
  [[nodiscard]] std::vector<Scratch<Value>>& scratch_of();
  template <class Value>
  void descend(std::size_t level, const LineVectorOf<Value>& b, LineVectorOf<Value>& x);
  template <class Value>
  void solve_coarsest(const LineVectorOf<Value>& b, LineVectorOf<Value>& x);

  std::vector<Level> levels_;
  std::vector<Scratch<Real>> single_;  ///< empty until a cycle needs them
  std::vector<Scratch<Pack>> abreast_;
  bool ascending_ = true;
  LineVector scratch_;
  solver::SparseLu lu_;
  std::vector<int> slot_node_, slot_entry_;  ///< indices of the values of the coarsest pattern in its rows
  std::vector<double> values_, rhs_;
};

}  // namespace hersey::film
