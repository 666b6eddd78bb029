#pragma once

#include <cmath>
#include <numbers>

/// Closed forms for journal bearing films, in the notation of the theory manual. Angles [rad] from the widest gap in
/// the direction of rotation; e is the eccentricity ratio; forces are dimensionless as stated.
namespace hersey::verification {

inline constexpr double pi = std::numbers::pi;

/// Film force in the bearing's radial (towards the smallest gap) and tangential direction, over mu omega R L (R/c)^2.
struct FilmForce {
  double radial = 0;
  double tangential = 0;
  [[nodiscard]] double load() const { return std::hypot(radial, tangential); }
  [[nodiscard]] double attitude() const { return std::atan2(tangential, radial); }  ///< [rad]
};

/// Infinitely long bearing, film full all around (Sommerfeld 1904).
inline FilmForce long_full(double e) { return {0, 12 * pi * e / ((2 + e * e) * std::sqrt(1 - e * e))}; }

/// Infinitely long bearing, negative pressures dropped (Guembel 1921).
inline FilmForce long_half(double e) {
  return {12 * e * e / ((2 + e * e) * (1 - e * e)), 6 * pi * e / ((2 + e * e) * std::sqrt(1 - e * e))};
}

/// Infinitely long bearing, full film: pressure above that at the widest gap, over mu omega (R/c)^2.
inline double long_full_pressure(double e, double phi) {
  const double C = std::cos(phi), S = std::sin(phi);
  return 6 * e * S * (2 + e * C) / ((2 + e * e) * (1 + e * C) * (1 + e * C));
}

/// Infinitely long bearing, full film: friction torque on the journal about its axis, over mu omega R^2 L (R/c)
/// (Sommerfeld 1904): 4 pi (1 + 2 e^2) / ((2 + e^2) sqrt(1 - e^2)).
inline double long_full_journal_torque(double e) {
  return 4 * pi * (1 + 2 * e * e) / ((2 + e * e) * std::sqrt(1 - e * e));
}

/// Short bearing, half film (Ocvirk 1952): Sommerfeld number S times (L/D)^2.
inline double short_half_sommerfeld(double e) {
  const double a = 1 - e * e;
  return a * a / (pi * e * std::sqrt(pi * pi * a + 16 * e * e));
}

/// Short bearing, half film: attitude angle [rad].
inline double short_half_attitude(double e) { return std::atan2(pi * std::sqrt(1 - e * e), 4 * e); }

/// Non-rotating infinitely long journal approaching the bore at speed V, full film: force over mu L V (R/c)^3
/// (Booker 1965): 12 pi / (1 - e^2)^{3/2}.
inline double long_full_squeeze(double e) { return 12 * pi / std::pow(1 - e * e, 1.5); }

/// Parallel rectangular plates B x L, L >= B, approaching at V: W h^3/(mu L B^3 V), by the double sine series
/// (Archibald 1956). Summed until the terms fall below round-off of six digits.
inline double squeeze_plates(double L_over_B) {
  double series = 0;
  for (int n = 1; n < 200; n += 2) series += std::tanh(n * pi * L_over_B / 2) / std::pow(n, 5);
  return 1 - 192 / (std::pow(pi, 5) * L_over_B) * series;
}

/// A plane slider of infinite width, gap h2 (1 + K (1 - x/B)), the flat surface sliding towards the narrow end with
/// oil at one pressure at both (Reynolds 1886; Lamb, Hydrodynamics, 6th ed., art. 330a).
struct LongSlider {
  double K = 0;  ///< [-], > 0

  /// Load over 6 mu U (B/h2)^2, per width.
  [[nodiscard]] double load() const { return (std::log1p(K) - 2 * K / (2 + K)) / (K * K); }
  /// Friction on the surface that slides, over mu U B/h2, per width.
  [[nodiscard]] double friction() const { return 4 * std::log1p(K) / K - 6 / (2 + K); }
  /// Of pressure from the wide end, over B.
  [[nodiscard]] double centre() const {
    const double a = 1 + K, log_a = std::log1p(K);
    return (a * (2 + a) * log_a - 2.5 * K * K - 3 * K) / (K * ((2 + K) * log_a - 2 * K));
  }
};

/// A parallel gap between discs, from the radius r1 to r2 (texts on hydrostatic bearings; Hamrock, Schmid and Jacobson,
/// Fundamentals of Fluid Film Lubrication).
struct ParallelAnnulus {
  double r1 = 0, r2 = 0;  ///< [m]

  [[nodiscard]] double log_ratio() const { return std::log(r2 / r1); }
  /// Flow from the inner to the outer radius over h^3 p/mu, p the inner pressure.
  [[nodiscard]] double flow() const { return pi / (6 * log_ratio()); }
  /// Load of that pressure, over itself [m^2].
  [[nodiscard]] double area() const { return pi * ((r2 * r2 - r1 * r1) / (2 * log_ratio()) - r1 * r1); }
  /// Torque of one that turns over mu omega/h [m^4].
  [[nodiscard]] double torque() const { return pi * (std::pow(r2, 4) - std::pow(r1, 4)) / 2; }
  /// Load of two that approach at the speed V, over mu V/h^3 [m^4].
  [[nodiscard]] double squeeze() const {
    const double outer = r2 * r2, inner = r1 * r1;
    return 1.5 * pi * (outer * outer - inner * inner - std::pow(outer - inner, 2) / log_ratio());
  }
};

}  // namespace hersey::verification
