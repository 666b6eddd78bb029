#pragma once

#include "hersey/film/value_and_slope.h"

namespace hersey::film {

/// Eddy viscosity over molecular viscosity at a distance from a wall of `y_plus` = y sqrt(tau rho)/mu [-], by
/// Reichardt's law (turbulence.3).
[[nodiscard]] double eddy_viscosity_ratio(double y_plus);

/// Friction of a film over that of a laminar one, with its slope by the logarithm of the Reynolds number [-]: of
/// sliding, and of flow along pressure in the direction of sliding and across it.
struct EddyFriction {
  ValueAndSlope sliding, along, across;
};

/// Friction of a film with Reichardt's eddy viscosity, integrated across its thickness for flow along pressure that is
/// small beside the sliding (turbulence.3 to turbulence.6). The integrals are tabulated over the logarithm of the
/// Reynolds number, with their slopes, and interpolated by cubics to 1e-6.
[[nodiscard]] EddyFriction eddy_friction(double reynolds);

}  // namespace hersey::film
