#pragma once

#include <cmath>
#include <variant>
#include <vector>

#include "hersey/film/value_and_slope.h"

namespace hersey::film {

/// 0 degC [K].
inline constexpr double zero_celsius = 273.15;

// Each law (thermal.1 to thermal.3) gives ln mu and its slope [1/K] at a temperature T [K], mu in Pa s at the
// cavitation pressure. A new law is a struct like these and its name in TemperatureLaw.

/// mu does not depend on temperature.
struct FixedViscosity {
  double mu = 0.015;  ///< [Pa s], > 0
  /// ln mu, slope 0.
  [[nodiscard]] ValueAndSlope log_viscosity(double /*T*/) const { return {std::log(mu), 0}; }
};

/// mu = mu_ref exp(-beta (T - T_ref)).
/// @see Reynolds (1886), Phil. Trans. R. Soc. 177, 157-234.
struct ExponentialViscosity {
  double mu_ref = 0.015;  ///< [Pa s], > 0
  double T_ref = 313.15;  ///< [K]
  double beta = 0.03;     ///< [1/K], >= 0
  /// ln mu falls in proportion to T.
  [[nodiscard]] ValueAndSlope log_viscosity(double T) const { return {std::log(mu_ref) - beta * (T - T_ref), -beta}; }
};

/// mu = a exp(b/(T - c)).
/// @see Vogel (1921), Phys. Z. 22, 645-646.
struct VogelViscosity {
  double a = 5e-5;  ///< [Pa s], > 0
  double b = 1000;  ///< [K], >= 0
  double c = 170;   ///< [K], below every temperature of the film
  /// ln mu grows without bound as T falls to c; nearer than a tenth of a kelvin it stays constant.
  [[nodiscard]] ValueAndSlope log_viscosity(double T) const {
    const double above = std::fmax(T - c, 0.1);
    return {std::log(a) + b / above, T - c > 0.1 ? -b / (above * above) : 0};
  }
};

/// Expansion of mineral oils at 15 degC [1/K].
inline constexpr double mineral_oil_expansion = 0.00065;

/// Returns the density at T [K] of an oil that has rho15 at 15 degC and expands from there [1/K] (thermal.28).
[[nodiscard]] inline double density_at(double T, double rho15, double expansion) {
  return rho15 * (1 - expansion * (T - 288.15));
}

/// log10 log10 (nu + 0.7) = A - B log10 T, nu in mm^2/s; mu = nu rho with rho = rho15 (1 - expansion (T - 288.15 K)).
/// @see ASTM D341 (2020), Standard Practice for Viscosity-Temperature Equations of Liquid Petroleum Products.
struct WaltherViscosity {
  double A = 8, B = 3;                       ///< [-]
  double rho15 = 870;                        ///< density at 15 degC [kg/m^3], > 0
  double expansion = mineral_oil_expansion;  ///< [1/K]

  /// Fits kinematic viscosities [m^2/s] at 40 and 100 degC.
  [[nodiscard]] static WaltherViscosity through(double nu40, double nu100, double rho15);
  /// Fits kinematic viscosities [m^2/s] at any two temperatures [K].
  [[nodiscard]] static WaltherViscosity through(double nu_a, double T_a, double nu_b, double T_b, double rho15);

  /// Kinematic viscosity [m^2/s], and its slope.
  [[nodiscard]] ValueAndSlope kinematic(double T) const;
  /// Logarithm of the dynamic viscosity, and its slope.
  [[nodiscard]] ValueAndSlope log_viscosity(double T) const;
  /// Dynamic viscosity [Pa s], computed in two thirds of the time that its logarithm takes.
  [[nodiscard]] double viscosity(double T) const { return kinematic(T).value * density(T); }
  /// Density [kg/m^3].
  [[nodiscard]] double density(double T) const { return density_at(T, rho15, expansion); }
};

/// ln mu is linear in 1/T between the rows of a table, and goes on beyond them as in the first and the last interval.
struct TabledViscosity {
  std::vector<double> T;   ///< ascending [K], two at least
  std::vector<double> mu;  ///< falling [Pa s], > 0
  /// ln mu in the interval in which T lies, and its slope.
  [[nodiscard]] ValueAndSlope log_viscosity(double T) const;
};

using TemperatureLaw =
    std::variant<FixedViscosity, ExponentialViscosity, VogelViscosity, WaltherViscosity, TabledViscosity>;

/// Returns the viscosity at the cavitation pressure [Pa s].
[[nodiscard]] inline double viscosity_at(const TemperatureLaw& law, double T) {
  const auto at = [T](const auto& l) {
    if constexpr (requires { l.viscosity(T); }) return l.viscosity(T);
    return std::exp(l.log_viscosity(T).value);
  };
  return std::visit(at, law);
}

/// True if the viscosity depends on temperature.
[[nodiscard]] inline bool depends_on_temperature(const TemperatureLaw& law) {
  return !std::holds_alternative<FixedViscosity>(law);
}

}  // namespace hersey::film
