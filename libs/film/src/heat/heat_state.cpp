#include "hersey/film/heat_state.h"

#include <algorithm>
#include <cmath>

namespace hersey::film {

double HeatBalance::error() const {
  const double scale = std::max({std::abs(power), std::abs(source), std::abs(to_oil), std::abs(to_shell),
                                 std::abs(to_journal), std::abs(stored)});
  return scale > 0 ? std::abs(power + source - to_oil - to_shell - to_journal - stored) / scale : 0;
}

}  // namespace hersey::film
