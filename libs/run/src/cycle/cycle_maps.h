#pragma once

#include <vector>

#include "cycle/bearing_cycle.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "table/quantity.h"

namespace hersey::run {

/// A cycle of a bearing that has ended.
struct CycleRow {
  const BearingCycle& cycle;
  bool is_complete = false;  ///< a cycle of the model; else the whole run
  double radius = 0;         ///< of the film, to which an annulus' z is relative [m]
};

/// The bearings' cycles in the results file: losses, extremes and maps, one row per cycle (docs/results-file.md).
class CycleMaps {
 public:
  CycleMaps(const model::Model& model, const model::Machine& machine, results::Writer& writer);

  /// All bearings at an accepted state.
  void take(double t, const std::vector<bearing::BearingObservation>& observation);

  /// Ends the cycle with the state last taken.
  /// @returns one entry per bearing.
  std::vector<BearingCycle> close();

  /// At the end of the run: without a complete cycle the row is that of the whole run.
  void finish();

  /// The cycles under way.
  void persist(Archive& archive);

  [[nodiscard]] static QuantityGroup describe();

 private:
  std::vector<BearingCycle> write(bool is_complete);

  const model::Machine& machine_;
  std::vector<QuantityRows<CycleRow, model::Bearing>> series_;
  std::vector<CycleSums> sums_;
  int rows_ = 0;
};

}  // namespace hersey::run
