#include "hersey/circuit/aerated_oil.h"

#include <algorithm>

namespace hersey::circuit {

// (circuit.8)
Storage::Content Storage::content(double p, double ambient) const {
  const double walls = volume + wall_compliance * p;
  const double oil = 1 + p / bulk_modulus;
  // A tenth of the atmosphere is where oil itself cavitates; bubbles would fill everything at none.
  const double absolute = p + ambient, lowest = 0.1 * ambient;
  const double p_air = std::max(absolute, lowest);
  const double total = free_air / (1 - free_air) + solubility;  // air over oil, both at ambient pressure
  double bubbles = 0, bubbles_slope = 0;
  if (const double undissolved = total - solubility * p_air / ambient; undissolved > 0 && free_air > 0) {
    bubbles = undissolved * ambient / p_air;
    if (absolute > lowest) bubbles_slope = -total * ambient / (p_air * p_air);
  }
  const double fraction = 1 / (1 + bubbles);
  return {walls * oil * fraction, (wall_compliance * oil + walls / bulk_modulus) * fraction -
                                      walls * oil * fraction * fraction * bubbles_slope};
}

}  // namespace hersey::circuit
