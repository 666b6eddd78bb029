#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "hersey/core/spatial.h"

namespace hersey::mbd {

/// A number that carries its derivatives with respect to the twist xi_A and the relative velocity V_AB_A of two bodies
/// (see ForceResponse): what is computed with it comes with exact derivatives (forward mode).
struct Dual {
  using Gradient = Eigen::Array<double, 12, 1>;
  double value = 0;
  Gradient d = Gradient::Zero();  ///< with respect to [xi; V]

  Dual() = default;
  Dual(double x) : value(x) {}  // NOLINT: a constant is a Dual
  Dual(double x, const Gradient& gradient) : value(x), d(gradient) {}

  Dual& operator+=(const Dual& b) {
    value += b.value;
    d += b.d;
    return *this;
  }
  Dual& operator-=(const Dual& b) {
    value -= b.value;
    d -= b.d;
    return *this;
  }
  Dual& operator*=(const Dual& b) {
    d = d * b.value + value * b.d;
    value *= b.value;
    return *this;
  }
  Dual& operator/=(const Dual& b) {
    value /= b.value;
    d = (d - value * b.d) / b.value;
    return *this;
  }
  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator*(Dual a, const Dual& b) { return a *= b; }
  friend Dual operator/(Dual a, const Dual& b) { return a /= b; }
  friend Dual operator-(const Dual& a) { return {-a.value, -a.d}; }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }
};

/// @pre x > 0, or the derivative is not finite.
inline Dual sqrt(const Dual& x) {
  const double root = std::sqrt(x.value);
  return {root, x.d / (2 * root)};
}
inline Dual abs(const Dual& x) { return x.value < 0 ? -x : x; }
/// @pre x > 0.
inline Dual pow(const Dual& x, double exponent) {
  const double power = std::pow(x.value, exponent);
  return {power, (exponent * power / x.value) * x.d};
}

inline double value_of(double x) { return x; }
inline double value_of(const Dual& x) { return x.value; }

template <class T>
using Vec3 = Eigen::Matrix<T, 3, 1>;

// Products are written out, because those of Eigen need traits for mixed scalars.
template <class T>
T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T>
Vec3<T> scaled(const T& s, const Vec3<T>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
template <class T>
T length(const Vec3<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}
template <class T>
Vec3<T> constant(const Vector3& a) {
  return {T(a[0]), T(a[1]), T(a[2])};
}

/// X_AB with derivatives.
template <class T>
struct PoseOf {
  Vec3<T> x, y, z, r;  ///< B's axes and origin in A

  [[nodiscard]] Vec3<T> rotate(const Vec3<T>& v) const {
    return Vec3<T>(scaled(v[0], x) + scaled(v[1], y) + scaled(v[2], z));
  }
  [[nodiscard]] Vec3<T> inverse_rotate(const Vec3<T>& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
  [[nodiscard]] Vec3<T> transform(const Vec3<T>& p) const { return Vec3<T>(rotate(p) + r); }
  [[nodiscard]] Vec3<T> inverse_transform(const Vec3<T>& p) const { return inverse_rotate(Vec3<T>(p - r)); }
};

}  // namespace hersey::mbd

namespace Eigen {
template <>
struct NumTraits<hersey::mbd::Dual> : NumTraits<double> {
  using Real = hersey::mbd::Dual;
  using NonInteger = hersey::mbd::Dual;
  using Nested = hersey::mbd::Dual;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 13,
    AddCost = 13,
    MulCost = 26
  };
};
}  // namespace Eigen
