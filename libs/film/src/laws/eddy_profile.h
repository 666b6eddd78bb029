#pragma once

#include "hersey/film/turbulence.h"

namespace hersey::film {

/// Friction of a film with Reichardt's eddy viscosity, integrated across its thickness for flow along pressure that is
/// small beside the sliding (turbulence.3 to turbulence.6). The integrals are tabulated over the logarithm of the
/// Reynolds number, with their slopes, and interpolated by cubics to 1e-6.
[[nodiscard]] TurbulentFriction eddy_friction(double reynolds);

}  // namespace hersey::film
