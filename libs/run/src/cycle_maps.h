#pragma once

#include <vector>

#include "bearing_cycle.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/results/writer.h"

namespace hersey::run {

/// The bearings' cycles in the results file: losses, extremes and maps, one row per cycle (docs/results-file.md).
class CycleMaps {
 public:
  CycleMaps(const model::Model& model, const model::Machine& machine, results::Writer& writer);

  /// All bearings at an accepted state.
  void take(double t, const std::vector<bearing::BearingObservation>& seen);

  /// The cycle ends with the state last taken.
  /// @returns one entry per bearing.
  std::vector<BearingCycle> close();

  /// At the end of the run: without a complete cycle the row is that of the whole run.
  void finish();

  /// The cycles under way.
  void persist(Archive& archive);

 private:
  struct ExtremeSeries {
    results::Series value, t, phi, z;
  };
  struct BearingSeries {
    results::Series begin, end, is_complete, energy_film, energy_asperity, power_film, power_asperity;
    ExtremeSeries moft, pofp, contact;
    results::Series mean_contact, wear_load, h_min, t_h_min, p_max, t_p_max;
  };

  [[nodiscard]] static BearingSeries declare(const model::Bearing& bearing, results::Writer& writer);
  std::vector<BearingCycle> write(bool is_complete);

  const model::Machine& machine_;
  std::vector<BearingSeries> series_;
  std::vector<CycleSums> sums_;
  int rows_ = 0;
};

}  // namespace hersey::run
