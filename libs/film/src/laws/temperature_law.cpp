#include "hersey/film/temperature_law.h"

#include <algorithm>
#include <numbers>

#include "hersey/core/contract.h"

namespace hersey::film {
namespace {

// Constants of the standard: nu in mm^2/s.
constexpr double walther_constant = 0.7, mm2_s = 1e-6;

double double_logarithm(double nu) { return std::log10(std::log10(nu / mm2_s + walther_constant)); }

}  // namespace

WaltherViscosity WaltherViscosity::through(double nu40, double nu100, double rho15) {
  return through(nu40, 313.15, nu100, 373.15, rho15);
}

WaltherViscosity WaltherViscosity::through(double nu_a, double T_a, double nu_b, double T_b, double rho15) {
  HERSEY_REQUIRE(nu_a > 0.3 * mm2_s && nu_b > 0.3 * mm2_s && T_a != T_b, "two viscosities at two temperatures");
  WaltherViscosity law{.rho15 = rho15};
  const double at_a = double_logarithm(nu_a), at_b = double_logarithm(nu_b);
  law.B = (at_a - at_b) / std::log10(T_b / T_a);
  law.A = at_a + law.B * std::log10(T_a);
  return law;
}

ValueAndSlope WaltherViscosity::kinematic(double T) const {
  const double ln10 = std::numbers::ln10;
  const double inner = std::exp(ln10 * A - B * std::log(T)), sum = std::exp(ln10 * inner);
  const double by_inner = ln10 * sum;  // d sum/d inner
  return {mm2_s * (sum - walther_constant), mm2_s * by_inner * (-B / T) * inner};
}

ValueAndSlope WaltherViscosity::log_viscosity(double T) const {
  const ValueAndSlope nu = kinematic(T);
  const double rho = density(T);
  return {std::log(nu.value * rho), nu.slope / nu.value - expansion * rho15 / rho};
}

ValueAndSlope TabledViscosity::log_viscosity(double at) const {
  HERSEY_REQUIRE(T.size() >= 2 && T.size() == mu.size(), "two rows at least");
  const auto above = std::upper_bound(T.begin() + 1, T.end() - 1, at);
  const auto k = static_cast<std::size_t>(above - T.begin());
  const double a = std::log(mu[k - 1]), b = std::log(mu[k]), from = 1 / T[k - 1], to = 1 / T[k];
  const double slope = (b - a) / (to - from);
  return {a + slope * (1 / at - from), -slope / (at * at)};
}

}  // namespace hersey::film
