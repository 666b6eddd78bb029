#pragma once

#include <algorithm>
#include <array>
#include <vector>

namespace hersey::film {

/// Multigrid only has to approximate the solution, and six digits are enough: half the memory is half the time on large
/// grids.
using Real = float;

/// A vector over the nodes of all lines, line by line, with one extra node at either end that is always finite: the
/// missing neighbours of the first and the last node are multiplied by zero coefficients.
class LineVector {
 public:
  LineVector() = default;
  explicit LineVector(int size) : values_(static_cast<std::size_t>(size) + 2, 0.0) {}
  [[nodiscard]] Real* data() { return values_.data() + 1; }
  [[nodiscard]] const Real* data() const { return values_.data() + 1; }
  [[nodiscard]] Real& operator[](int i) { return values_[static_cast<std::size_t>(i) + 1]; }
  [[nodiscard]] Real operator[](int i) const { return values_[static_cast<std::size_t>(i) + 1]; }
  void fill(Real value) { std::fill(values_.begin(), values_.end(), value); }

 private:
  std::vector<Real> values_;
};

/// A matrix over `lines` lines of n nodes that close to a ring. A node is coupled to the three nearest of its own line
/// and of the lines before (west) and after it (east).
class LineOperator {
 public:
  /// West, centre and east, each for the nodes j - 1, j and j + 1.
  using Row = std::array<Real, 9>;
  static constexpr int west = 0, centre = 3, east = 6;

  LineOperator() = default;
  LineOperator(int lines, int n);

  [[nodiscard]] int lines() const { return lines_; }
  [[nodiscard]] int nodes_per_line() const { return n_; }
  [[nodiscard]] int size() const { return lines_ * n_; }
  [[nodiscard]] int before(int line) const { return line == 0 ? lines_ - 1 : line - 1; }
  [[nodiscard]] int after(int line) const { return line + 1 == lines_ ? 0 : line + 1; }
  [[nodiscard]] Row& row(int node) { return rows_[node]; }
  [[nodiscard]] const Row& row(int node) const { return rows_[node]; }
  void set_zero();

  /// LU factorisation of every line's own tridiagonal block, without pivoting. False where a pivot vanishes.
  [[nodiscard]] bool factorise_lines();

  /// Solves one line's block for x in place of its right-hand side; the second does so for the transposed block.
  void solve_line(int line, Real* x) const;
  void solve_line_transposed(int line, Real* x) const;

  /// Gauss-Seidel on A x = b line by line, in ascending or descending order.
  void relax(const LineVector& b, bool ascending, LineVector& x) const;
  /// Gauss-Seidel from x = 0; `residual` becomes b - A x.
  void relax_from_zero(const LineVector& b, bool ascending, LineVector& x, LineVector& residual) const;

 private:
  struct Pivot {
    Real below = 0, inverse = 0, above = 0;  ///< multiplier, 1/pivot, entry to the right over the pivot
  };
  int lines_ = 0, n_ = 0;
  std::vector<Row> rows_;
  std::vector<Pivot> pivots_;
};

}  // namespace hersey::film
