#pragma once

#include <array>
#include <cmath>
#include <numbers>

/// The plane pendulum at any amplitude, in Jacobi's elliptic functions (Whittaker 1937, Analytical Dynamics, sec. 44).
namespace hersey::verification {

/// sn, cn, dn of argument u and modulus k by descending Landen transformations (Abramowitz and Stegun 16.4).
struct JacobiElliptic {
  JacobiElliptic(double u, double k) {
    std::array<double, 16> a{}, c{};
    a[0] = 1;
    c[0] = k;
    double b = std::sqrt(1 - k * k);
    int n = 0;
    while (std::abs(c[n]) > 1e-17 && n < 15) {
      a[n + 1] = 0.5 * (a[n] + b);
      c[n + 1] = 0.5 * (a[n] - b);
      b = std::sqrt(a[n] * b);
      ++n;
    }
    double phi = std::ldexp(a[n] * u, n);
    for (; n > 0; --n) phi = 0.5 * (phi + std::asin(c[n] / a[n] * std::sin(phi)));
    sn = std::sin(phi);
    cn = std::cos(phi);
    dn = std::sqrt(1 - k * k * sn * sn);
  }
  double sn, cn, dn;
};

/// K(k) by the arithmetic-geometric mean.
inline double complete_elliptic(double k) {
  double a = 1, b = std::sqrt(1 - k * k);
  for (int i = 0; i < 40 && a - b > 1e-17; ++i) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return std::numbers::pi / (2 * a);
}

/// Released from rest at `amplitude` (from hanging) at t = 0; omega0 = sqrt(g/L) for a point mass.
struct Pendulum {
  double amplitude;  ///< [rad]
  double omega0;     ///< [rad/s]

  [[nodiscard]] double k() const { return std::sin(0.5 * amplitude); }
  [[nodiscard]] double period() const { return 4 * complete_elliptic(k()) / omega0; }
  [[nodiscard]] double angle(double t) const {
    return 2 * std::asin(k() * JacobiElliptic(complete_elliptic(k()) - omega0 * t, k()).sn);
  }
  [[nodiscard]] double rate(double t) const {
    const JacobiElliptic j(complete_elliptic(k()) - omega0 * t, k());
    return -2 * k() * omega0 * j.cn;
  }
};

}  // namespace hersey::verification
