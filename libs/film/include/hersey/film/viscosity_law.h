#pragma once

#include <cmath>
#include <variant>
#include <vector>

#include "hersey/film/value_and_slope.h"

namespace hersey::film {

// Each law (film.7) gives ln(mu/mu0) and its slope [1/Pa] at a pressure p >= 0 above the cavitation pressure [Pa]; the
// film takes its exponential. A new law is a struct like these and its name in ViscosityLaw.

/// mu = mu0.
struct ConstantViscosity {
  /// The logarithm is 0 at every pressure.
  [[nodiscard]] ValueAndSlope log_ratio(double /*p*/, double /*mu0*/) const { return {}; }
};

/// mu = mu0 exp(alpha p).
/// @see Barus (1893), Am. J. Sci. 45, 87-96.
struct Barus {
  double alpha = 0;  ///< pressure-viscosity coefficient [1/Pa], >= 0
  /// The logarithm is alpha p and does not depend on mu0.
  [[nodiscard]] ValueAndSlope log_ratio(double p, double /*mu0*/) const { return {alpha * p, alpha}; }
};

/// ln mu + 9.67 = (ln mu0 + 9.67) (1 + p/196.2 MPa)^z, mu in Pa s.
/// @see Roelands (1966), Correlational Aspects of the Viscosity-Temperature-Pressure Relationship of Lubricating Oils.
struct Roelands {
  double z = 0;  ///< pressure-viscosity index [-], >= 0

  static constexpr double pole_pressure = 196.2e6;          ///< [Pa]
  static constexpr double smallest_viscosity = 6.3151e-05;  ///< exp(-9.67) [Pa s]: mu0 lies above it

  /// Logarithm at p above p_cav [Pa] for mu0 [Pa s], > smallest_viscosity.
  [[nodiscard]] ValueAndSlope log_ratio(double p, double mu0) const {
    const double size = std::log(mu0 / smallest_viscosity), slope = size * z / pole_pressure;
    if (p == 0) return {0, slope};  // half of the nodes of a bearing are cavitated
    const double power = std::pow(1 + p / pole_pressure, z);
    return {size * (power - 1), slope * power / (1 + p / pole_pressure)};
  }
};

/// A table over temperature and pressure: ln mu is linear in p between its columns and beyond them, and linear in 1/T
/// between its rows (thermal.27). The local viscosity at p = 0 selects the row.
struct TabledPressure {
  std::vector<double> p;       ///< ascending from 0 [Pa], two at least
  std::vector<double> log_mu;  ///< of mu [Pa s] row by row of falling viscosity, shape (rows, p.size())
  /// Logarithm at `at` above p_cav [Pa]; mu0 [Pa s] selects the row.
  [[nodiscard]] ValueAndSlope log_ratio(double at, double mu0) const;
};

/// Logarithm of the largest viscosity ratio within a law's range: an oil of exp(20) = 5e8 times the viscosity is solid.
inline constexpr double largest_log_viscosity = 20;

/// Limits a logarithm beyond +-largest_log_viscosity smoothly to half as much again (film.9). No answer lies there, but
/// trials of an iteration do: their viscosities stay finite, and slopes are those of the values.
[[nodiscard]] inline ValueAndSlope saturated(const ValueAndSlope& log_ratio) {
  constexpr double room = 0.5 * largest_log_viscosity;
  const double beyond = std::abs(log_ratio.value) - largest_log_viscosity;
  if (!(beyond > 0)) return log_ratio;
  const double part = std::tanh(beyond / room);
  return {std::copysign(largest_log_viscosity + room * part, log_ratio.value), (1 - part * part) * log_ratio.slope};
}

using ViscosityLaw = std::variant<ConstantViscosity, Barus, Roelands, TabledPressure>;

}  // namespace hersey::film
