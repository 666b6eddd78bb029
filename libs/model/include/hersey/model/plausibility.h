#pragma once

#include <string>
#include <vector>

#include "hersey/model/model.h"

namespace hersey::model {

/// What is hardly meant of a film that has been computed: a peak pressure p_max [Pa] above what its lining bears, or a
/// smallest gap h_min [m] below the roughness of the surfaces; each with what to do. Empty: nothing.
[[nodiscard]] std::vector<std::string> doubts_of_surfaces(const Bearing& bearing, double p_max, double h_min);

}  // namespace hersey::model
