#pragma once

#include <cmath>

#include "hersey/core/spatial.h"

namespace hersey::mbd {

/// A number as a function of the twist xi that moves one frame against another, X(xi) = exp(xi^) X, up to the second
/// order: what is computed with it comes with exact first and second derivatives at xi = 0.
struct Taylor {
  double value = 0;
  Vector6 d = Vector6::Zero();   ///< by xi
  Matrix6 dd = Matrix6::Zero();  ///< twice by xi, symmetric

  Taylor() = default;
  Taylor(double x) : value(x) {}  // NOLINT: a constant is a function
  Taylor(double x, const Vector6& first, const Matrix6& second) : value(x), d(first), dd(second) {}

  friend Taylor operator+(const Taylor& a, const Taylor& b) { return {a.value + b.value, a.d + b.d, a.dd + b.dd}; }
  friend Taylor operator-(const Taylor& a, const Taylor& b) { return {a.value - b.value, a.d - b.d, a.dd - b.dd}; }
  friend Taylor operator-(const Taylor& a) { return {-a.value, -a.d, -a.dd}; }
  friend Taylor operator*(const Taylor& a, const Taylor& b) {
    const Matrix6 mixed = a.d * b.d.transpose();
    return {a.value * b.value, a.value * b.d + b.value * a.d,
            a.value * b.dd + b.value * a.dd + mixed + mixed.transpose()};
  }

  /// f(x) for a function with these derivatives at the value of x.
  [[nodiscard]] Taylor under(double f, double slope, double curvature) const {
    return {f, slope * d, slope * dd + curvature * d * d.transpose()};
  }
};

/// @pre b is not zero
inline Taylor operator/(const Taylor& a, const Taylor& b) {
  const double r = 1 / b.value;
  return a * b.under(r, -r * r, 2 * r * r * r);
}

/// @pre x > 0
inline Taylor sqrt(const Taylor& x) {
  const double root = std::sqrt(x.value);
  return x.under(root, 0.5 / root, -0.25 / (root * x.value));
}

inline Taylor cos(const Taylor& x) { return x.under(std::cos(x.value), -std::sin(x.value), -std::cos(x.value)); }

/// @pre x and y are not both zero
inline Taylor atan2(const Taylor& y, const Taylor& x) {
  // In axes along (x, y) the angle is the arc tangent of a ratio that is zero, whose curvature is zero there.
  const double angle = std::atan2(y.value, x.value), c = std::cos(angle), s = std::sin(angle);
  const Taylor ratio = (c * y - s * x) / (c * x + s * y);
  return {angle, ratio.d, ratio.dd};
}

/// A vector of them.
struct TaylorVector {
  Taylor x, y, z;

  friend TaylorVector operator+(const TaylorVector& a, const TaylorVector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend TaylorVector operator-(const TaylorVector& a, const TaylorVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend TaylorVector operator*(const Taylor& s, const TaylorVector& a) { return {s * a.x, s * a.y, s * a.z}; }
  [[nodiscard]] Taylor dot(const TaylorVector& b) const { return x * b.x + y * b.y + z * b.z; }
};

}  // namespace hersey::mbd
