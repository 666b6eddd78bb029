#pragma once

#include <variant>

#include "hersey/film/shear_law.h"

namespace hersey::film {

/// Smallest mu_inf/mu_n [-] and smallest power of the rate; the stress of an oil that reaches one of them rises.
inline constexpr double least_limit = 1e-5, least_power = 0.1;

/// True if the stress of an oil rises with the shear rate without bound, so that layers of a film that share a stress
/// have shear rates of their own (theory manual, thermal.25).
[[nodiscard]] inline bool has_rising_stress(const ShearThinning& oil) {
  if (const auto* law = std::get_if<Cross>(&oil.law))
    return law->limit >= least_limit || law->exponent <= 1 - least_power;
  if (const auto* law = std::get_if<Carreau>(&oil.law))
    return law->limit >= least_limit || law->exponent >= least_power;
  return true;
}

}  // namespace hersey::film
