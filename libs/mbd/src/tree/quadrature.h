#pragma once

#include <array>
#include <cmath>

namespace hersey::mbd {

/// Integrals over [a, b] of f and of |f|.
struct Integral {
  double value = 0;
  double size = 0;
};

/// Five-point Gauss-Legendre rule.
template <class F>
Integral gauss5(const F& f, double a, double b) {
  // Nodes and weights: Abramowitz and Stegun (1964), table 25.4.
  static constexpr std::array<double, 3> x{0.0, 0.538469310105683091, 0.906179845938663993};
  static constexpr std::array<double, 3> w{0.568888888888888889, 0.478628670499366468, 0.236926885056189088};
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  Integral sum;
  const auto add = [&](double t, double weight) {
    const double value = f(t);
    sum.value += half * weight * value;
    sum.size += std::abs(half * weight * value);
  };
  add(middle, w[0]);
  for (std::size_t i = 1; i < x.size(); ++i) {
    add(middle - half * x[i], w[i]);
    add(middle + half * x[i], w[i]);
  }
  return sum;
}

/// Bisects until halves and whole agree to `tolerance`. At a kink or jump of a table the halves shrink towards it, and
/// the depth limit ends where they no longer matter: one path of the bisection, not all of them.
template <class F>
double refine(const F& f, double a, double b, double whole, double tolerance, int depth) {
  const double middle = 0.5 * (a + b);
  const double left = gauss5(f, a, middle).value, right = gauss5(f, middle, b).value;
  if (depth == 0 || !(std::abs(left + right - whole) > tolerance)) return left + right;  // not a number ends it too
  return refine(f, a, middle, left, tolerance, depth - 1) + refine(f, middle, b, right, tolerance, depth - 1);
}

/// Adaptive integral over [a, b], to round-off of the integral of |f|: where f changes sign nothing smaller is
/// reachable.
template <class F>
double integrate(const F& f, double a, double b) {
  constexpr int panels = 8, max_depth = 40;
  std::array<Integral, panels> panel;
  const auto edge = [&](int i) { return a + (b - a) * i / panels; };
  double size = 0;
  for (int i = 0; i < panels; ++i) {
    panel[i] = gauss5(f, edge(i), edge(i + 1));
    size += panel[i].size;
  }
  double sum = 0;
  for (int i = 0; i < panels; ++i) sum += refine(f, edge(i), edge(i + 1), panel[i].value, 1e-14 * size, max_depth);
  return sum;
}

}  // namespace hersey::mbd
