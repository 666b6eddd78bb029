#include "time_stepping/target_instants.h"

#include <algorithm>
#include <cmath>

namespace hersey::run {

TargetInstants TargetInstants::equal(double start, double duration, double step) {
  TargetInstants instants;
  // A last interval of the size of round-off is left out.
  instants.count_ = static_cast<std::size_t>(std::max(1.0, std::ceil(duration / step - 1e-9)));
  instants.start_ = start;
  instants.step_ = step;
  instants.end_ = start + duration;
  return instants;
}

}  // namespace hersey::run
