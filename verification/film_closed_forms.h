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

}  // namespace hersey::verification
