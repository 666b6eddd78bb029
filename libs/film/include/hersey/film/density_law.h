#pragma once

#include <cmath>
#include <variant>

#include "hersey/film/value_and_slope.h"

namespace hersey::film {

// Each law (film.8) gives rho/rho0 and its slope [1/Pa] at a pressure p >= 0 above the cavitation pressure [Pa], and
// the work that brings a unit of volume (at rho0) to p, the integral of dp rho0/rho [Pa]. A new law is a struct like
// these and its name in DensityLaw.

/// rho = rho0.
struct Incompressible {
  /// rho/rho0 and its slope [1/Pa].
  [[nodiscard]] ValueAndSlope ratio(double /*p*/) const { return {1, 0}; }
  /// Integral of dp rho0/rho from 0 to p [Pa].
  [[nodiscard]] double work(double p) const { return p; }
};

/// rho = rho0 (1 + rise p/(1 + saturation p)).
/// @see Dowson and Higginson (1966), Elasto-Hydrodynamic Lubrication, Pergamon.
struct DowsonHigginson {
  double rise = 0.6e-9;        ///< compressibility at p = 0 [1/Pa], >= 0
  double saturation = 1.7e-9;  ///< [1/Pa], >= 0
  /// rho/rho0 and its slope [1/Pa].
  [[nodiscard]] ValueAndSlope ratio(double p) const {
    const double d = 1 + saturation * p;
    return {1 + rise * p / d, rise / (d * d)};
  }
  /// Integral of dp rho0/rho from 0 to p [Pa].
  [[nodiscard]] double work(double p) const {
    const double sum = rise + saturation;
    return sum > 0 ? (saturation * p + rise * std::log1p(sum * p) / sum) / sum : p;
  }
};

/// rho = rho0 exp(p/B): a bulk modulus rho dp/drho that does not depend on pressure.
struct ConstantBulkModulus {
  double bulk_modulus = 1.5e9;  ///< B [Pa], > 0
  /// rho/rho0 and its slope [1/Pa].
  [[nodiscard]] ValueAndSlope ratio(double p) const {
    const double ratio = std::exp(p / bulk_modulus);
    return {ratio, ratio / bulk_modulus};
  }
  /// Integral of dp rho0/rho from 0 to p [Pa].
  [[nodiscard]] double work(double p) const { return -bulk_modulus * std::expm1(-p / bulk_modulus); }
};

/// A homogeneous mixture of oil and small bubbles of gas, which is compressed at one temperature (damper.9): rho = rho0
/// (1 + r)/(1 + r P/(P + p)), r = gas_fraction/(1 - gas_fraction).
/// @see Nikolajsen (1999), J. Tribol. 121, 186.
struct BubblyOil {
  double gas_fraction = 0;  ///< of the mixture's volume at p = 0 [-], in [0, 1)
  double pressure = 1e5;    ///< P, absolute pressure at p = 0 [Pa], > 0
  /// rho/rho0 and its slope [1/Pa].
  [[nodiscard]] ValueAndSlope ratio(double p) const {
    const double r = gas_fraction / (1 - gas_fraction), absolute = pressure + p, volume = 1 + r * pressure / absolute;
    return {(1 + r) / volume, (1 + r) * r * pressure / (absolute * absolute * volume * volume)};
  }
  /// Integral of dp rho0/rho from 0 to p [Pa].
  [[nodiscard]] double work(double p) const {
    const double r = gas_fraction / (1 - gas_fraction);
    return (p + r * pressure * std::log1p(p / pressure)) / (1 + r);
  }
};

using DensityLaw = std::variant<Incompressible, DowsonHigginson, ConstantBulkModulus, BubblyOil>;

}  // namespace hersey::film
