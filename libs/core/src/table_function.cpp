#include "hersey/core/table_function.h"

#include <algorithm>
#include <cmath>

#include "hersey/core/contract.h"

namespace hersey {
namespace {

std::string text_of(double x) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.9g", x);
  return buffer.data();
}

/// Returns the slope at a point between intervals of widths h0, h1 and secants d0, d1: 0 at an extremum, otherwise the
/// weighted harmonic mean, which is at most three times the smaller secant, so that the cubics are monotone.
double monotone_slope(double h0, double d0, double h1, double d1) {
  if (d0 * d1 <= 0) return 0;
  const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

/// Returns the one-sided three-point slope at an end, limited so that the first cubic is monotone.
double end_slope(double h0, double d0, double h1, double d1) {
  const double slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (slope * d0 <= 0) return 0;
  if (d0 * d1 <= 0 && std::abs(slope) > 3 * std::abs(d0)) return 3 * d0;
  return slope;
}

}  // namespace

TableFunction::TableFunction(std::vector<double> x, std::vector<double> y, const Options& options)
    : x_(std::move(x)), y_(std::move(y)), options_(options) {
  HERSEY_REQUIRE(!x_.empty() && x_.size() == y_.size(), "a table is made of points");
  HERSEY_REQUIRE(options_.period >= 0 && std::isfinite(options_.period) && std::isfinite(options_.scale),
                 "a period is a finite length");
  for (std::size_t i = 0; i < x_.size(); ++i) {
    HERSEY_REQUIRE(std::isfinite(x_[i]) && std::isfinite(y_[i]), "table values are finite");
    HERSEY_REQUIRE(i == 0 || x_[i] > x_[i - 1], "a table's abscissa increases");
  }
  for (double& value : y_) value *= options_.scale;
  if (is_periodic()) close_period();
  if (options_.interpolation == Interpolation::smooth) find_slopes();
}

void TableFunction::close_period() {
  const double missing = options_.period - (x_.back() - x_.front());
  const double round_off = 1e-9 * options_.period;  // round-off of the conversion of units
  HERSEY_REQUIRE(missing >= -round_off, "a periodic table spans at most its period");
  if (missing > round_off) {
    x_.push_back(x_.front() + options_.period);
    y_.push_back(y_.front());
    return;
  }
  HERSEY_REQUIRE(std::abs(y_.back() - y_.front()) <= 1e-6 * (std::abs(y_.back()) + std::abs(y_.front())),
                 "a periodic table ends where it begins");
  x_.back() = x_.front() + options_.period;
  y_.back() = y_.front();
}

void TableFunction::find_slopes() {
  const std::size_t n = x_.size();
  slope_.assign(n, 0.0);
  if (n < 2) return;
  std::vector<double> h(n - 1), d(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    h[i] = x_[i + 1] - x_[i];
    d[i] = (y_[i + 1] - y_[i]) / h[i];
  }
  for (std::size_t i = 1; i + 1 < n; ++i) slope_[i] = monotone_slope(h[i - 1], d[i - 1], h[i], d[i]);
  if (is_periodic()) {
    slope_.front() = slope_.back() = monotone_slope(h[n - 2], d[n - 2], h[0], d[0]);
  } else if (n == 2) {
    slope_.front() = slope_.back() = d[0];
  } else {
    slope_.front() = end_slope(h[0], d[0], h[1], d[1]);
    slope_.back() = end_slope(h[n - 2], d[n - 2], h[n - 3], d[n - 3]);
  }
}

double TableFunction::into_range(double x) const {
  if (is_periodic()) {
    const double periods = std::floor((x - lower()) / options_.period);
    return std::clamp(x - periods * options_.period, lower(), upper());
  }
  if (!covers(x, x)) {
    throw TableRangeError("the table covers " + text_of(lower()) + " to " + text_of(upper()) + " but was asked for " +
                          text_of(x));
  }
  return std::clamp(x, lower(), upper());
}

bool TableFunction::covers(double lo, double hi) const {
  // The last time of a run is a sum of steps: it may exceed the table's end by round-off, but no more.
  const double slack = 1e-9 * (upper() - lower());
  return is_periodic() || (lower() - slack <= lo && hi <= upper() + slack);
}

std::vector<double> TableFunction::kinks(double lo, double hi) const {
  std::vector<double> found;
  const std::size_t n = x_.size();
  if (options_.interpolation == Interpolation::smooth || n < 3) return found;
  const double slack = 1e-12 * std::max(std::abs(lo), std::abs(hi));
  const auto secant = [&](std::size_t i) { return (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]); };
  const double first = is_periodic() ? std::floor((lo - lower()) / options_.period) : 0;
  const double last = is_periodic() ? std::floor((hi - lower()) / options_.period) : 0;
  for (double period = first; period <= last; ++period) {
    for (std::size_t i = is_periodic() ? 0 : 1; i + 1 < n; ++i) {
      const double x = x_[i] + period * (is_periodic() ? options_.period : 0);
      const bool bends = secant(i) != secant(i == 0 ? n - 2 : i - 1);
      if (bends && lo + slack < x && x < hi - slack) found.push_back(x);
    }
  }
  return found;
}

TableFunction::Piece TableFunction::piece_at(double given) const {
  const double x = into_range(given);
  if (x_.size() == 1) return {0, y_[0], 0, 0, 0};
  const auto right = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
  const auto i = static_cast<std::size_t>(right - x_.begin()) - 1;
  const double h = x_[i + 1] - x_[i];
  const double secant = (y_[i + 1] - y_[i]) / h;
  if (slope_.empty()) return {x - x_[i], y_[i], secant, 0, 0};
  const double m0 = slope_[i], m1 = slope_[i + 1];
  return {x - x_[i], y_[i], m0, (3 * secant - 2 * m0 - m1) / h, (m0 + m1 - 2 * secant) / (h * h)};
}

double TableFunction::value(std::span<const double> x) const {
  const auto [s, y0, m0, c, d] = piece_at(x[0]);
  return y0 + s * (m0 + s * (c + s * d));
}

void TableFunction::gradient(std::span<const double> x, std::span<double> gradient) const {
  const auto [s, y0, m0, c, d] = piece_at(x[0]);
  std::fill(gradient.begin(), gradient.end(), 0.0);
  gradient[0] = m0 + s * (2 * c + 3 * s * d);
}

double TableFunction::second_derivative(std::span<const double> x) const {
  const auto [s, y0, m0, c, d] = piece_at(x[0]);
  return 2 * c + 6 * s * d;
}

}  // namespace hersey
