#include "gap/flow_factors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hersey/core/contract.h"

namespace hersey::film {
namespace {

// Fits of Patir and Cheng; the rows belong to Peklenik's ratio 1/9, 1/6, 1/3, 1, 3, 6, 9.
struct PressureFit {
  double C, r, from;  ///< 1 - C exp(-r H), for gamma > 1: 1 + C H^-r; for H > from
};
struct ShearFit {
  double A1, a1, a2, a3, A2;  ///< A1 H^a1 exp(-a2 H + a3 H^2) up to H = 5, A2 exp(-H/4) above
};
struct StressFit {
  double A3, a4, a5, a6;  ///< A3 H^a4 exp(-a5 H + a6 H^2) up to H = 7, 0 above
};
constexpr int fits = 7, isotropic = 3;
constexpr std::array<double, fits> gammas{1.0 / 9, 1.0 / 6, 1.0 / 3, 1, 3, 6, 9};
constexpr std::array<PressureFit, fits> pressure_fits{{{1.48, 0.42, 1.0},
                                                       {1.38, 0.42, 1.0},
                                                       {1.18, 0.42, 0.75},
                                                       {0.90, 0.56, 0.5},
                                                       {0.225, 1.5, 0.5},
                                                       {0.520, 1.5, 0.5},
                                                       {0.870, 1.5, 0.5}}};
constexpr std::array<ShearFit, fits> shear_fits{{{2.046, 1.12, 0.78, 0.03, 1.856},
                                                 {1.962, 1.08, 0.77, 0.03, 1.754},
                                                 {1.858, 1.01, 0.76, 0.03, 1.561},
                                                 {1.899, 0.98, 0.92, 0.05, 1.126},
                                                 {1.560, 0.85, 1.13, 0.08, 0.556},
                                                 {1.290, 0.62, 1.09, 0.08, 0.388},
                                                 {1.011, 0.54, 1.07, 0.08, 0.295}}};
constexpr std::array<StressFit, fits> stress_fits{{{14.1, 2.45, 2.30, 0.10},
                                                   {13.4, 2.42, 2.30, 0.10},
                                                   {12.3, 2.32, 2.30, 0.10},
                                                   {11.1, 2.31, 2.38, 0.11},
                                                   {9.8, 2.25, 2.80, 0.18},
                                                   {10.1, 2.25, 2.90, 0.18},
                                                   {8.7, 2.15, 2.97, 0.18}}};

// Smallest H for which the fits of the shear flow are valid.
constexpr double smallest_H = 0.5;

/// Returns a function that rises from 0 at `from` to 1 at `to` with horizontal tangents.
ValueAndSlope smooth_step(double H, double from, double to) {
  const double t = std::clamp((H - from) / (to - from), 0.0, 1.0);
  return {t * t * (3 - 2 * t), 6 * t * (1 - t) / (to - from)};
}

/// Returns A H^a exp(-b H + c H^2).
ValueAndSlope power_exponential(double H, double A, double a, double b, double c) {
  const double value = A * std::pow(H, a) * std::exp(H * (c * H - b));
  return {value, value * (a / H - b + 2 * c * H)};
}

ValueAndSlope pressure_fit(const PressureFit& fit, bool along, double H) {
  if (along) {
    const double excess = fit.C * std::pow(H, -fit.r);
    return {1 + excess, -fit.r * excess / H};
  }
  const double lack = fit.C * std::exp(-fit.r * H);
  return {1 - lack, fit.r * lack};
}

// Towards contact a factor above 1 is continued along its tangent. A factor that falls would become negative on it and
// is continued along a hyperbola.
ValueAndSlope pressure_row(int row, double H) {
  const PressureFit& fit = pressure_fits[row];
  const bool along = row > isotropic;
  if (H >= fit.from) return pressure_fit(fit, along, H);
  const ValueAndSlope limit = pressure_fit(fit, along, fit.from);
  const double down = fit.from - H;
  if (along) return {limit.value - limit.slope * down, limit.slope};
  const double steep = limit.slope / limit.value, denominator = 1 + steep * down;
  return {limit.value / denominator, limit.slope / (denominator * denominator)};
}

// Both fits differ by less than 0.1 % where they meet and are blended there. Towards contact a parabola leads to zero.
ValueAndSlope shear_row(int row, double H) {
  const ShearFit& fit = shear_fits[row];
  if (H < smallest_H) {
    const ValueAndSlope limit = power_exponential(smallest_H, fit.A1, fit.a1, fit.a2, fit.a3);
    const double secant = limit.value / smallest_H, bend = (limit.slope - secant) / smallest_H;
    return {H * (secant + bend * (H - smallest_H)), secant + bend * (2 * H - smallest_H)};
  }
  const ValueAndSlope fade = smooth_step(H, 4.5, 5.5);
  ValueAndSlope near, far;
  if (fade.value < 1) near = power_exponential(H, fit.A1, fit.a1, fit.a2, fit.a3);
  if (fade.value > 0) far.value = fit.A2 * std::exp(-0.25 * H), far.slope = -0.25 * far.value;
  return {near.value + fade.value * (far.value - near.value),
          near.slope + fade.value * (far.slope - near.slope) + fade.slope * (far.value - near.value)};
}

// The fit ends at H = 7 with a jump of about 0.01; it is blended to zero before.
ValueAndSlope stress_row(int row, double H) {
  if (H >= 7) return {};
  const StressFit& fit = stress_fits[row];
  const ValueAndSlope near = power_exponential(H, fit.A3, fit.a4, fit.a5, fit.a6), fade = smooth_step(H, 6, 7);
  return {near.value * (1 - fade.value), near.slope * (1 - fade.value) - near.value * fade.slope};
}

}  // namespace

PatirCheng::PatirCheng(double gamma) {
  HERSEY_REQUIRE(0.11 - 1e-9 <= gamma && gamma <= 1 / 0.11 + 1e-9,
                 "flow factors are known for Peklenik ratios from 1/9 to 9");
  while (row_ + 2 < fits && gamma >= gammas[row_ + 1]) ++row_;
  weight_ = std::clamp(std::log(gamma / gammas[row_]) / std::log(gammas[row_ + 1] / gammas[row_]), 0.0, 1.0);
}

template <class Fit>
ValueAndSlope PatirCheng::interpolated(Fit&& fit) const {
  if (weight_ == 0) return fit(row_);
  const ValueAndSlope below = fit(row_), above = fit(row_ + 1);
  return {below.value + weight_ * (above.value - below.value), below.slope + weight_ * (above.slope - below.slope)};
}

ValueAndSlope PatirCheng::pressure(double H) const {
  return interpolated([H](int row) { return pressure_row(row, H); });
}

ValueAndSlope PatirCheng::shear(double H) const {
  return interpolated([H](int row) { return shear_row(row, H); });
}

ValueAndSlope PatirCheng::stress(double H) const {
  return interpolated([H](int row) { return stress_row(row, H); });
}

ValueAndSlope couette_stress_factor(double H) {
  // phi_f is the mean of z/(z + t) over heights 3 sigma t with the density 35/32 (1 - t^2)^3, z = H/3.
  const double z = H / 3, z2 = z * z;
  if (z >= 2) {
    double value = 0, slope = 0, term = 1;  // even moments of the density over even powers of z
    for (int k = 0; term > 1e-17; ++k) {
      value += term;
      slope -= 2 * k * term / H;
      term *= (2.0 * k + 1) / ((2.0 * k + 9) * z2);
    }
    return {value, slope};
  }
  constexpr double scale = 35.0 / 32;
  const double a = 1 - z2, cube = a * a * a, cube_z = -6 * z * a * a;
  double bracket = 0, bracket_z = 0;
  if (z <= 1) {
    constexpr double cut = 1.0 / 300;  // of gaps below sigma/100, over 3 sigma
    constexpr std::array<double, 7> c{-55, 132, 345, -160, -405, 60, 147};
    double polynomial = 0, polynomial_z = 0;
    for (std::size_t k = c.size(); k-- > 0;) {
      polynomial_z = polynomial_z * z + polynomial;
      polynomial = polynomial * z + c[k];
    }
    const double logarithm = std::log((z + 1) / cut);
    bracket = cube * logarithm + polynomial / 60;
    bracket_z = cube_z * logarithm + cube / (z + 1) + polynomial_z / 60;
  } else {
    const double logarithm = std::log((z + 1) / (z - 1));
    bracket = cube * logarithm + z / 15 * (66 + z2 * (30 * z2 - 80));
    bracket_z = cube_z * logarithm - 2 * cube / (z2 - 1) + (66 + z2 * (150 * z2 - 240)) / 15;
  }
  return {scale * z * bracket, scale * (bracket + z * bracket_z) / 3};
}

MeanGap mean_gap(double H) {
  const double density = std::exp(-0.5 * H * H) / std::sqrt(2 * std::numbers::pi);
  const double open = 0.5 * std::erfc(-H / std::numbers::sqrt2);
  return {H * open + density, open, density};
}

}  // namespace hersey::film
