#pragma once

#include <limits>

#include "hersey/bearing/film_force.h"
#include "hersey/core/archive.h"
#include "hersey/run/summary.h"

namespace hersey::run {

/// Gathers the summary of one bearing over the accepted steps. Means are over time, each step counting with its length.
class BearingExtremes {
 public:
  explicit BearingExtremes(std::string name);
  void take(double t, double dt, const bearing::BearingObservation& observation);
  [[nodiscard]] BearingSummary summary() const;
  [[nodiscard]] const std::string& name() const { return summary_.name; }
  /// Smallest thickness at the last step; infinite before the first one [m].
  [[nodiscard]] double last_thickness() const { return last_thickness_; }
  void persist(Archive& archive);

 private:
  BearingSummary summary_;
  double last_thickness_ = std::numeric_limits<double>::infinity();
  double time_ = 0, energy_ = 0, volume_ = 0;
  double energy_film_ = 0, energy_other_shear_ = 0;
  double last_put_in_ = 0, last_taken_ = 0;  ///< powers of the last state [W]
};

}  // namespace hersey::run
