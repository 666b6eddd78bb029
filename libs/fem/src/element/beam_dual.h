#pragma once

#include <Eigen/Core>
#include <cmath>

namespace hersey::fem {

/// A number that carries its derivatives with respect to the twelve unknowns of a beam element: what is computed with
/// it comes with exact derivatives (forward mode).
struct Dual {
  using Gradient = Eigen::Matrix<double, 12, 1>;
  double value = 0;
  Gradient d = Gradient::Zero();

  Dual() = default;
  Dual(double x) : value(x) {}  // NOLINT: a constant is a Dual
  Dual(double x, const Gradient& gradient) : value(x), d(gradient) {}

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.d + b.d}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.d - b.d}; }
  friend Dual operator-(const Dual& a) { return {-a.value, -a.d}; }
  friend Dual operator*(const Dual& a, const Dual& b) { return {a.value * b.value, a.d * b.value + b.d * a.value}; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double quotient = a.value / b.value;
    return {quotient, (a.d - quotient * b.d) / b.value};
  }
};

/// @pre x > 0
inline Dual sqrt(const Dual& x) {
  const double root = std::sqrt(x.value);
  return {root, x.d / (2 * root)};
}
inline Dual sin(const Dual& x) { return {std::sin(x.value), std::cos(x.value) * x.d}; }
inline Dual cos(const Dual& x) { return {std::cos(x.value), -std::sin(x.value) * x.d}; }
inline Dual atan2(const Dual& y, const Dual& x) {
  const double square = x.value * x.value + y.value * y.value;
  return {std::atan2(y.value, x.value), (x.value * y.d - y.value * x.d) / square};
}

}  // namespace hersey::fem
