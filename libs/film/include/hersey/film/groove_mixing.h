#pragma once

#include <vector>

#include "hersey/film/heat_state.h"

namespace hersey::film {

/// Returns the oil that the ends around a groove draw in, in the order of `flows`: oil that has left films over these
/// ends, mixed, and for the rest fresh oil (theory manual, thermal.68). Without flow out of films all is fresh.
/// @param carry_over  fraction of the oil that reaches the groove which stays on the journal, 0 to 1 [-]
/// @param T_fresh  of fresh oil, over which temperatures rise [K]
[[nodiscard]] std::vector<EndOil> mixed_in_groove(const std::vector<EndFlow>& flows, double carry_over, double T_fresh);

}  // namespace hersey::film
