#pragma once

#include <string>
#include <vector>

#include "hersey/model/model.h"

namespace hersey::model {

/// Returns warnings about an implausible film: a peak pressure p_max [Pa] above the permissible one of its lining, or a
/// smallest gap h_min [m] below the roughness of the surfaces; each with a remedy. Empty if there are none.
[[nodiscard]] std::vector<std::string> surface_warnings(const Bearing& bearing, double p_max, double h_min);

/// Returns a warning about a film that is computed as a laminar one and is not laminar everywhere (theory manual,
/// turbulence.15). Empty if there is none.
/// @param reynolds_max  largest Reynolds number of its sliding [-]
/// @param laminar_share  smallest part of its area that is laminar [-]
[[nodiscard]] std::vector<std::string> regime_warnings(const Bearing& bearing, double reynolds_max,
                                                       double laminar_share);

/// Returns warnings about a journal in a body (film::BodyJournal), which heat enters evenly only if it rotates (theory
/// manual, thermal.59).
/// @param turned  its net rotation in its shell [rad]
/// @param travelled  the sum of the magnitudes of its rotations [rad]
[[nodiscard]] std::vector<std::string> rotation_warnings(const Bearing& bearing, double turned, double travelled);

}  // namespace hersey::model
