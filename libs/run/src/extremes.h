#pragma once

#include "hersey/bearing/journal_bearing.h"
#include "hersey/core/archive.h"
#include "hersey/run/simulate.h"

namespace hersey::run {

/// Gathers the summary of one bearing over the accepted steps. Means are over time, each step counting with its length.
class BearingExtremes {
 public:
  explicit BearingExtremes(std::string name);
  void take(double t, double dt, double clearance, const bearing::BearingObservation& seen);
  [[nodiscard]] BearingSummary summary() const;
  [[nodiscard]] const std::string& name() const { return summary_.name; }
  void persist(Archive& archive);

 private:
  BearingSummary summary_;
  double time_ = 0, energy_ = 0, volume_ = 0;
  double last_put_in_ = 0, last_taken_ = 0;  ///< powers of the last state [W]
};

}  // namespace hersey::run
