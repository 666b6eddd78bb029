#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "hersey/core/scalar_function.h"

namespace hersey {

/// A table was evaluated outside its range.
class TableRangeError : public std::range_error {
 public:
  using std::range_error::range_error;
};

enum class Interpolation {
  linear,  ///< piecewise linear; the derivative jumps at the points, where the right-hand one is returned
  smooth,  ///< monotone piecewise cubic: no overshoot, continuous first derivative; the second derivative jumps at the
           ///< points
};

/// A tabulated function of one variable, y(x) = scale * table(x).
/// Smooth tables are piecewise cubic Hermite polynomials with the slopes of Fritsch and Butland: they are monotone
/// where the points are, and approximate a smooth function to third order between the points (second order at extrema).
/// @see Fritsch and Butland (1984), SIAM J. Sci. Stat. Comput. 5, 300-304.
/// @verified_by table_function_test.cpp
class TableFunction final : public ScalarFunction {
 public:
  struct Options {
    Interpolation interpolation = Interpolation::linear;
    double period = 0;  ///< period of a periodic table, > 0; 0: not periodic
    double scale = 1;   ///< factor on every value
  };

  /// @param x  increasing, at least one value; for a periodic table x.back() - x.front() <= period. If it is the period
  ///           itself, the first and last value must agree.
  /// @param y  values, as many as x.
  /// @throws ContractError if these rules are violated or a value is not finite.
  TableFunction(std::vector<double> x, std::vector<double> y, const Options& options);

  /// @throws TableRangeError outside the table's range; its message states the range. Cost O(log n).
  [[nodiscard]] double value(std::span<const double> x) const override;
  void gradient(std::span<const double> x, std::span<double> gradient) const override;
  [[nodiscard]] double second_derivative(std::span<const double> x) const override;

  /// True if the table is periodic.
  [[nodiscard]] bool is_periodic() const { return options_.period > 0; }
  /// Returns the first point.
  [[nodiscard]] double lower() const { return x_.front(); }
  /// Returns the last point.
  [[nodiscard]] double upper() const { return x_.back(); }

  /// Returns the points strictly inside (lo, hi) at which the slope jumps, ascending; a smooth table has none.
  [[nodiscard]] std::vector<double> kinks(double lo, double hi) const;

  /// True if the table covers every x in [lo, hi].
  [[nodiscard]] bool covers(double lo, double hi) const;

 private:
  /// Cubic y0 + s (m0 + s (c + s d)), where s is the distance from the left point of the interval.
  struct Piece {
    double s, y0, m0, c, d;
  };
  [[nodiscard]] Piece piece_at(double x) const;
  [[nodiscard]] double into_range(double x) const;
  void close_period();
  void find_slopes();

  std::vector<double> x_, y_;
  std::vector<double> slope_;  ///< slopes at the points; empty for linear tables
  Options options_;
};

}  // namespace hersey
