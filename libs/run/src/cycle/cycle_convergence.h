#pragma once

#include <string>
#include <vector>

#include "cycle/bearing_cycle.h"
#include "hersey/core/archive.h"
#include "hersey/model/model.h"

namespace hersey::run {

/// Difference between a cycle of the machine and the one before.
struct CycleChange {
  int number = 0;       ///< of the cycle, from 1
  double value = 0;     ///< largest difference of a figure, over the larger one; not a number in the first cycle
  std::string largest;  ///< the figure that changed most, "film thickness of big_end"
};

/// Detects the ends of cycles and their periodicity: compares each bearing's smallest film thickness, peak pressure and
/// mean friction loss, and the error of its quasi-steady walls over their rise (plus 1 K) (model::Cycle).
class CycleConvergence {
 public:
  explicit CycleConvergence(const model::Model& model) : model_(model) {}

  /// True if a cycle ends with the accepted step that ended at `t`.
  [[nodiscard]] bool ends(double t) const;

  /// Takes the cycle that has ended, one entry per bearing.
  [[nodiscard]] CycleChange take(const std::vector<BearingCycle>& cycle);

  /// True if that cycle repeats the one before closely enough to end the run.
  [[nodiscard]] bool converged(const CycleChange& change) const;

  void persist(Archive& archive);

 private:
  struct Figures {
    double h_min = 0, p_max = 0, power = 0;
  };

  const model::Model& model_;
  int ended_ = 0;
  std::vector<Figures> last_;
};

}  // namespace hersey::run
