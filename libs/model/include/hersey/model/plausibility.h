#pragma once

#include <string>
#include <vector>

#include "hersey/model/model.h"

namespace hersey::model {

/// What is hardly meant of a film that has been computed: a peak pressure p_max [Pa] above what its lining bears, or a
/// smallest gap h_min [m] below the roughness of the surfaces; each with what to do. Empty: nothing.
[[nodiscard]] std::vector<std::string> surface_warnings(const Bearing& bearing, double p_max, double h_min);

/// Of a journal in a body (film::BodyJournal), to which heat comes evenly only as it turns (theory manual, thermal.59).
/// @param turned  by which it has turned in its shell [rad] @param travelled  the same, to and fro counted alike [rad]
[[nodiscard]] std::vector<std::string> rotation_warnings(const Bearing& bearing, double turned, double travelled);

}  // namespace hersey::model
