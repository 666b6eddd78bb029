#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "hersey/core/spatial.h"

/// Derivatives of given fields, to round-off and of any order.
namespace hersey::mbd::test {

/// A number that carries its slope along one variable (forward mode). A slope that is varied once more, Varied<Varied>,
/// is a second derivative.
template <class T>
struct Varied {
  T value{}, slope{};

  Varied() = default;
  Varied(double x) : value(x) {}  // NOLINT: a constant is a Varied
  Varied(const T& x, const T& along) : value(x), slope(along) {}

  Varied& operator+=(const Varied& b) {
    value += b.value;
    slope += b.slope;
    return *this;
  }
  friend Varied operator+(Varied a, const Varied& b) { return a += b; }
  friend Varied operator-(const Varied& a, const Varied& b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Varied operator-(const Varied& a) { return {-a.value, -a.slope}; }
  friend Varied operator*(double a, const Varied& b) { return {a * b.value, a * b.slope}; }
  friend Varied operator*(const Varied& a, const Varied& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
};

template <class T>
Varied<T> sin(const Varied<T>& x) {
  using std::cos, std::sin;
  return {sin(x.value), cos(x.value) * x.slope};
}
template <class T>
Varied<T> cos(const Varied<T>& x) {
  using std::cos, std::sin;
  return {cos(x.value), -(sin(x.value) * x.slope)};
}

// Few and plain: tests are compiled without optimisation, in which matrices of a library's take many times as long.
template <class T>
using VectorOf = std::array<T, 3>;
template <class T>
using MatrixOf = std::array<VectorOf<T>, 3>;  ///< rows

template <class T>
VectorOf<T> operator+(const VectorOf<T>& a, const VectorOf<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class T>
MatrixOf<T> operator+(const MatrixOf<T>& A, const MatrixOf<T>& B) {
  return {A[0] + B[0], A[1] + B[1], A[2] + B[2]};
}
template <class T>
VectorOf<T> operator*(double s, const VectorOf<T>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
template <class T>
VectorOf<T> operator*(const MatrixOf<T>& A, const VectorOf<T>& b) {
  VectorOf<T> product;
  for (std::size_t i = 0; i < 3; ++i) product[i] = A[i][0] * b[0] + A[i][1] * b[1] + A[i][2] * b[2];
  return product;
}
template <class T>
MatrixOf<T> transposed(const MatrixOf<T>& A) {
  MatrixOf<T> B;
  for (std::size_t i = 0; i < 9; ++i) B[i % 3][i / 3] = A[i / 3][i % 3];
  return B;
}
template <class T>
MatrixOf<T> operator*(const MatrixOf<T>& A, const MatrixOf<T>& B) {
  const MatrixOf<T> columns = transposed(B);
  return transposed(MatrixOf<T>{A * columns[0], A * columns[1], A * columns[2]});
}

/// a with a~ = the skew part of A.
template <class T>
VectorOf<T> axial(const MatrixOf<T>& A) {
  return 0.5 * VectorOf<T>{A[2][1] - A[1][2], A[0][2] - A[2][0], A[1][0] - A[0][1]};
}

/// Returns the rotation by `angle` about axis `k` of the frame.
template <class T>
MatrixOf<T> rotated_about(std::size_t k, const T& angle) {
  using std::cos, std::sin;
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  MatrixOf<T> R{};
  R[k][k] = T(1.0);
  R[i][i] = R[j][j] = cos(angle);
  R[j][i] = sin(angle);
  R[i][j] = -R[j][i];
  return R;
}

/// The slopes of all components.
template <class T>
T slopes(const Varied<T>& a) {
  return a.slope;
}
template <class A, std::size_t n>
auto slopes(const std::array<A, n>& a) {
  std::array<decltype(slopes(a[0])), n> slope;
  for (std::size_t i = 0; i < n; ++i) slope[i] = slopes(a[i]);
  return slope;
}

/// df/dx of numbers f.
template <class Function, class T>
auto slope_of(Function&& f, const T& x) {
  return slopes(f(Varied<T>(x, T(1.0))));
}

inline Vector3 vector(const VectorOf<double>& a) { return {a[0], a[1], a[2]}; }
inline Matrix3 matrix(const MatrixOf<double>& A) {
  return (Matrix3() << vector(A[0]).transpose(), vector(A[1]).transpose(), vector(A[2]).transpose()).finished();
}

}  // namespace hersey::mbd::test
