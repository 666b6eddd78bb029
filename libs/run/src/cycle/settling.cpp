#include "cycle/settling.h"

#include <algorithm>

namespace hersey::run {

bool SettlingTest::settled(const StepRecord& step) {
  const std::optional<model::Settle>& settle = model_.simulation.settle;
  if (!settle || step.bearings.empty()) return false;
  const double t = step.mechanism.t;
  if (next_ && t < *next_) return false;
  const bool repeats = !last_.empty() && change(step) <= settle->tolerance;
  last_ = step.bearings;
  next_ = t + settle->over * (1 - 1e-9);
  return repeats;
}

double SettlingTest::change(const StepRecord& step) const {
  double largest = 0;
  for (std::size_t i = 0; i < last_.size(); ++i) {
    largest = std::max(largest, (step.bearings[i].position.relative - last_[i].position.relative).norm());
  }
  return largest;
}

void SettlingTest::persist(Archive& archive) {
  archive.each("last", last_, [](Archive& a, bearing::BearingObservation& observation) {
    a.io("relative", observation.position.relative);
  });
  archive.io("next", next_);
}

}  // namespace hersey::run
