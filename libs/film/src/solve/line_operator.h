#pragma once

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

namespace hersey::film {

/// Multigrid only has to approximate the solution, and six digits are enough: half the memory is half the time on large
/// grids.
using Real = float;

/// Right-hand sides that are solved side by side. A recurrence along a line waits for the node before; four of them
/// fill the registers of every processor, read the matrix once and take little longer than one.
constexpr int kAbreast = 4;

/// The values of as many right-hand sides at one node.
using Pack [[gnu::vector_size(kAbreast * sizeof(Real))]] = Real;

/// The same values in double precision.
using WidePack [[gnu::vector_size(kAbreast * sizeof(double))]] = double;
template <class Value>
using WideOf = std::conditional_t<std::is_same_v<Value, Real>, double, WidePack>;

/// The value of right-hand side k at a node.
[[nodiscard]] inline Real lane(const Real& value, int /*k*/) { return value; }
[[nodiscard]] inline Real lane(const Pack& values, int k) { return values[k]; }
inline void set_lane(Real& value, int /*k*/, Real to) { value = to; }
inline void set_lane(Pack& values, int k, Real to) { values[k] = to; }

/// A vector over the nodes of all lines, line by line, with one extra node at either end that is always finite: the
/// missing neighbours of the first and the last node are multiplied by zero coefficients. Value is Real, or Pack for
/// several vectors side by side.
template <class Value>
class LineVectorOf {
 public:
  LineVectorOf() = default;
  explicit LineVectorOf(int size) : values_(static_cast<std::size_t>(size) + 2, Value{}) {}
  [[nodiscard]] Value* data() { return values_.data() + 1; }
  [[nodiscard]] const Value* data() const { return values_.data() + 1; }
  [[nodiscard]] Value& operator[](int i) { return values_[static_cast<std::size_t>(i) + 1]; }
  [[nodiscard]] const Value& operator[](int i) const { return values_[static_cast<std::size_t>(i) + 1]; }
  [[nodiscard]] int size() const { return values_.empty() ? 0 : static_cast<int>(values_.size()) - 2; }
  void set_zero() { std::fill(values_.begin(), values_.end(), Value{}); }

 private:
  std::vector<Value> values_;
};
using LineVector = LineVectorOf<Real>;

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

  /// Solves one line's block for x in place of its right-hand side; the second does so for the transposed block. Value
  /// here and below: Real or Pack.
  template <class Value>
  void solve_line(int line, Value* x) const;
  void solve_line_transposed(int line, Real* x) const;

  /// Gauss-Seidel on A x = b line by line, in ascending or descending order.
  template <class Value>
  void relax(const LineVectorOf<Value>& b, bool ascending, LineVectorOf<Value>& x) const;
  /// Gauss-Seidel from x = 0; `residual` becomes b - A x.
  template <class Value>
  void relax_from_zero(const LineVectorOf<Value>& b, bool ascending, LineVectorOf<Value>& x,
                       LineVectorOf<Value>& residual) const;

 private:
  struct Pivot {
    Real below = 0, inverse = 0, above = 0;  ///< multiplier, 1/pivot, entry to the right over the pivot
  };
  int lines_ = 0, n_ = 0;
  std::vector<Row> rows_;
  std::vector<Pivot> pivots_;
};

}  // namespace hersey::film
