#pragma once

#include "hersey/fem/beam.h"

namespace hersey::fem {

/// Returns the section of a tube, or of a solid round bar where `bore` is 0. Effective area in shear after Cowper
/// (1966), J. Appl. Mech. 33, 335.
/// @pre 0 <= bore < diameter [m]
[[nodiscard]] BeamSection circular_section(double diameter, double bore, double poisson_ratio);

/// Returns the section of a solid rectangle of `width` along the section's y and `height` along z: torsion constant by
/// Saint-Venant's series, effective areas in shear after Cowper.
/// @pre both > 0 [m]
[[nodiscard]] BeamSection rectangular_section(double width, double height, double poisson_ratio);

}  // namespace hersey::fem
