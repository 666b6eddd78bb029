#include "hersey/film/greenwood_tripp.h"

#include <cmath>
#include <numbers>

namespace hersey::film {

ValueAndSlope greenwood_tripp_exact(double H) {
  if (H >= 8) return {};
  // With s = H + t^2 the integral runs over all t of a smooth function that decays at both ends: F_{5/2} = 1/sqrt(2 pi)
  // int t^6 exp(-(H + t^2)^2/2) dt. The trapezoidal rule then converges exponentially.
  constexpr double dt = 1.0 / 12;
  const double reach = std::sqrt(9 - H);
  double f52 = 0, f32 = 0;
  for (double t = dt; t < reach; t += dt) {
    const double t2 = t * t, s = H + t2;
    const double weight = t2 * t2 * std::exp(-0.5 * s * s);
    f52 += t2 * weight;
    f32 += weight;
  }
  const double both_sides = 2 * dt / std::sqrt(2 * std::numbers::pi);
  return {both_sides * f52, -2.5 * both_sides * f32};
}

ValueAndSlope greenwood_tripp_fit(double H) {
  if (H >= 4) return {};
  constexpr double a = 4.4086e-5, b = 6.804;
  const double power = a * std::pow(4 - H, b - 1);
  return {power * (4 - H), -b * power};
}

}  // namespace hersey::film
