#include "hersey/film/groove_mixing.h"

#include <algorithm>

namespace hersey::film {

// What is drawn in is the oil carried over as far as there is enough of it (thermal.68).
std::vector<EndOil> mixed_in_groove(const std::vector<EndFlow>& flows, double carry_over, double T_fresh) {
  double drawn = 0, leaving = 0, heat = 0;
  for (const EndFlow& flow : flows)
    drawn += flow.drawn, leaving += flow.leaving, heat += flow.leaving * (flow.T - T_fresh);
  const double carried = carry_over * leaving;
  EndOil oil;
  if (leaving > 0) {
    oil.carried = carried < drawn ? carried / drawn : 1;
    oil.drawn_again = std::min(carried, drawn) / leaving;
    oil.rise = oil.carried * heat / leaving;
  }
  return std::vector<EndOil>(flows.size(), oil);
}

}  // namespace hersey::film
