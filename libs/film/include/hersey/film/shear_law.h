#pragma once

#include <cmath>
#include <variant>

#include "hersey/film/value_and_slope.h"

namespace hersey::film {

/// Ratio R = mu/mu_n [-] of a sheared oil's viscosity to that at rest, mu_n, at the same temperature and pressure, with
/// its first and second derivative by the logarithm of the shear rate.
struct ShearRatio {
  double value = 1, slope = 0, bend = 0;
  /// Tangent viscosity d tau/d gamma over mu_n, and its slope by that logarithm (thermal.23).
  [[nodiscard]] ValueAndSlope tangent() const { return {value + slope, slope + bend}; }
};

// Each law (thermal.21, thermal.22) gives R at x, the shear rate over the critical one. A new law is a struct like
// these and its name in ShearLaw.

/// The viscosity does not depend on the shear rate.
struct Newtonian {
  /// R = 1.
  [[nodiscard]] ShearRatio ratio(double /*x*/) const { return {}; }
  /// True if the stress always rises with the shear rate.
  [[nodiscard]] bool is_monotone() const { return true; }
};

/// mu = mu_inf + (mu_n - mu_inf)/(1 + x^m).
/// @see Cross (1965), J. Colloid Sci. 20, 417-437.
struct Cross {
  double limit = 0;     ///< mu_inf/mu_n [-], 0 to 1
  double exponent = 1;  ///< m [-], > 0

  /// R has lost half of 1 - limit at x = 1.
  [[nodiscard]] ShearRatio ratio(double x) const {
    const double m = exponent, left = 1 / (1 + std::pow(x, m)), gone = left * (1 - left), most = 1 - limit;
    return {limit + most * left, -most * m * gone, most * m * m * gone * (1 - 2 * left)};
  }
  /// The tangent viscosity is limit + (1 - limit) ((1 - m) left + m left^2) with left = 1/(1 + x^m). It is least at
  /// left = (m - 1)/(2 m).
  [[nodiscard]] bool is_monotone() const {
    const double m = exponent;
    return m <= 1 || limit > (1 - limit) * (m - 1) * (m - 1) / (4 * m);
  }
};

/// mu = mu_inf + (mu_n - mu_inf) (1 + x^a)^((n - 1)/a); a = 2 is Carreau's.
/// @see Carreau (1972), Trans. Soc. Rheol. 16, 99-127; Yasuda (1979), thesis, MIT.
struct Carreau {
  double limit = 0;       ///< mu_inf/mu_n [-], 0 to 1
  double exponent = 1;    ///< n: the stress grows with this power of the rate where mu_inf is nothing [-], 0 to 1
  double transition = 2;  ///< a: how suddenly [-], > 0

  /// R falls like x^(n - 1) beyond x = 1.
  [[nodiscard]] ShearRatio ratio(double x) const {
    const double left = 1 / (1 + std::pow(x, transition)), gone = 1 - left, n_1 = exponent - 1;
    const double power = (1 - limit) * std::pow(left, -n_1 / transition);
    return {limit + power, n_1 * power * gone, n_1 * power * gone * (n_1 * gone + transition * left)};
  }
  /// The stress always rises: no power n >= 0 of the rate falls.
  [[nodiscard]] bool is_monotone() const { return true; }
};

using ShearLaw = std::variant<Newtonian, Cross, Carreau>;

/// Shear thinning of an oil.
struct ShearThinning {
  ShearLaw law = {};
  double critical_rate = 0;  ///< gamma_c [1/s], > 0; without meaning where critical_stress is given
  /// gamma_c mu_n instead [Pa], > 0, of an oil whose critical rate rises as heat thins it. 0: not given.
  double critical_stress = 0;

  /// True if there is none.
  [[nodiscard]] bool is_newtonian() const { return std::holds_alternative<Newtonian>(law); }
  /// d ln x/d ln mu_n at a given shear rate [-].
  [[nodiscard]] double by_viscosity() const { return critical_stress > 0 ? 1 : 0; }
  /// Ratio at a shear rate [1/s] of an oil of viscosity mu_n [Pa s] at rest.
  [[nodiscard]] ShearRatio ratio(double rate, double mu_n) const {
    const double x = critical_stress > 0 ? rate * mu_n / critical_stress : rate / critical_rate;
    return std::visit([x](const auto& one) { return one.ratio(x); }, law);
  }
};

}  // namespace hersey::film
