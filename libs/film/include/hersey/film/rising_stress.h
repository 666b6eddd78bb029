#pragma once

#include <variant>

#include "hersey/film/shear_law.h"

namespace hersey::film {

/// mu_inf/mu_n [-] and power of the rate of which one at least is in a stress that layers can share.
inline constexpr double least_limit = 1e-5, least_power = 0.1;

/// Whether the stress of an oil goes on rising as it is sheared, so that layers of a film which share it have rates of
/// their own (theory manual, thermal.25).
[[nodiscard]] inline bool has_rising_stress(const ShearThinning& oil) {
  if (const auto* law = std::get_if<Cross>(&oil.law))
    return law->limit >= least_limit || law->exponent <= 1 - least_power;
  if (const auto* law = std::get_if<Carreau>(&oil.law))
    return law->limit >= least_limit || law->exponent >= least_power;
  return true;
}

}  // namespace hersey::film
