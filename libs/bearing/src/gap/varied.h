#pragma once

#include <Eigen/Dense>

#include "hersey/core/spatial.h"

namespace hersey::bearing {

/// A quantity with its variation under a twist that moves one frame in another.
struct Varied {
  double value;
  Eigen::Matrix<double, 1, 6> d;
};

[[nodiscard]] inline Varied operator+(const Varied& a, const Varied& b) { return {a.value + b.value, a.d + b.d}; }
[[nodiscard]] inline Varied operator-(const Varied& a, const Varied& b) { return {a.value - b.value, a.d - b.d}; }
[[nodiscard]] inline Varied operator*(const Varied& a, const Varied& b) {
  return {a.value * b.value, a.value * b.d + b.value * a.d};
}
[[nodiscard]] inline Varied operator/(const Varied& a, const Varied& b) {
  const double q = a.value / b.value;
  return {q, (a.d - q * b.d) / b.value};
}

/// A vector carried by the moved frame, with its variation.
struct VariedVector {
  Vector3 value;
  Eigen::Matrix<double, 3, 6> d;
  [[nodiscard]] Varied operator[](int i) const { return {value[i], d.row(i)}; }
};

/// A direction fixed to the moved frame.
[[nodiscard]] inline VariedVector varied_direction(const Vector3& direction) {
  VariedVector v{direction, Eigen::Matrix<double, 3, 6>::Zero()};
  v.d.leftCols<3>() = -skew(direction);
  return v;
}

/// The origin of the moved frame.
[[nodiscard]] inline VariedVector varied_origin(const Vector3& r) {
  VariedVector v{r, Eigen::Matrix<double, 3, 6>::Zero()};
  v.d << -skew(r), Matrix3::Identity();
  return v;
}

}  // namespace hersey::bearing
