#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hersey {

/// Weights of f(x +- k h) in central differences of eighth order (Fornberg 1988, Math. Comp. 51, 699-706, Table 1).
inline constexpr std::array<double, 4> first_difference = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
inline constexpr std::array<double, 5> second_difference = {-205.0 / 72, 8.0 / 5, -1.0 / 5, 8.0 / 315, -1.0 / 560};

/// Returns the first or second derivative of `f` at `x` by differences whose step adapts to the function.
///
/// Round-off falls and truncation grows with the step h. Starting from a tiny h, where truncation is negligible, h is
/// doubled as long as the new estimate agrees with all earlier ones within their round-off. The first disagreement
/// shows truncation (or a kink), and the best estimate is the earlier one with the least round-off (Lepski's
/// principle). Increasing steps, unlike extrapolation from large ones, cannot be misled by a function that repeats
/// within the first step. Returns NaN if f is not finite around x.
template <int order, class F>
[[nodiscard]] double derivative(const F& f, double x) {
  static_assert(order == 1 || order == 2);
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const double f0 = f(x);
  // Estimates and their round-off bounds; the exact value lies in the intersection of all intervals free of truncation.
  double best = std::numeric_limits<double>::quiet_NaN(), least = std::numeric_limits<double>::infinity();
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  const double unit = std::max(1.0, std::abs(x));
  for (double step = (order == 1 ? 1e-8 : 1e-6) * unit; step < 1e3 * unit; step *= 2) {
    const double h = (x + step) - x;  // exactly representable
    double sum = order == 1 ? 0 : second_difference[0] * f0;
    double magnitude = std::abs(f0);
    double steepest = 0;
    double before = f0, after = f0;
    for (int k = 1; k <= 4; ++k) {
      const double plus = f(x + k * h), minus = f(x - k * h);
      sum += order == 1 ? first_difference[k - 1] * (plus - minus) : second_difference[k] * (plus + minus);
      magnitude = std::max({magnitude, std::abs(plus), std::abs(minus)});
      steepest = std::max({steepest, std::abs(plus - after), std::abs(minus - before)});
      after = plus, before = minus;
    }
    const double estimate = sum / (order == 1 ? h : h * h);
    if (!std::isfinite(estimate)) break;
    // f has a relative error of a few eps, and the rounding of its argument times its slope.
    const double noise = 8 * eps * (magnitude + std::abs(x) * steepest / h);
    const double bound = noise / (order == 1 ? h : h * h);
    if (estimate - bound > high || estimate + bound < low) break;
    if (bound < least) least = bound, best = estimate;
    low = std::max(low, estimate - bound);
    high = std::min(high, estimate + bound);
  }
  return best;
}

}  // namespace hersey
