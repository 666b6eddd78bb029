#pragma once

#include <optional>
#include <vector>

#include "hersey/run/orbits.h"

namespace hersey::run {

/// Where a multiplier crosses the unit circle on the way from one orbit to the next.
struct Crossing {
  std::complex<double> multiplier;  ///< there
  double share = 0;                 ///< of the way, 0 to 1
};

/// Returns the first crossing between two neighbouring orbits, by their largest multipliers; nothing if as many of them
/// are beyond the unit circle on both sides.
[[nodiscard]] std::optional<Crossing> crossing_between(const OrbitAtValue& a, const OrbitAtValue& b);

/// Names all crossings of a branch: (integrator.49).
[[nodiscard]] std::vector<BifurcationAt> bifurcations_of(const std::vector<OrbitAtValue>& orbits);

}  // namespace hersey::run
