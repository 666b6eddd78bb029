#pragma once

#include <atomic>

#include "hersey/core/outcome.h"
#include "time_stepping/machine_run.h"

namespace hersey::run {

/// Map of a machine over one of its periods, from the motion at its start to that at its end. Time goes on from period
/// to period.
class PeriodMap {
 public:
  /// @param run  begun; outlives this
  /// @param period  [s], > 0
  /// @param stop  set from outside: a period ends with its step; null: none does
  PeriodMap(MachineRun& run, double period, const std::atomic<bool>* stop);

  /// Runs one period on from where the machine is.
  [[nodiscard]] Outcome take();
  /// Runs one period on from `start`. If it fails, the machine is where it was.
  [[nodiscard]] Outcome take_from(const Motion& start);

  [[nodiscard]] Motion motion() { return run_.motion(); }
  [[nodiscard]] const mbd::Mechanism& mechanism() { return run_.mechanism(); }

  /// Returns way_between() two motions, positions and velocities in shares of how far they went in the last period.
  [[nodiscard]] Eigen::VectorXd way(const Motion& from, const Motion& to);
  /// Number of positions and velocities, which come first in a way.
  [[nodiscard]] Eigen::Index coordinates() { return 2 * mechanism().nv(); }
  /// Takes positions and velocities of a way in shares of how far they went in the last period.
  void compare_by_swing(Eigen::VectorXd& way);

 private:
  MachineRun& run_;
  double period_;
  const std::atomic<bool>* stop_;
  Swing swing_;
  double end_;
};

}  // namespace hersey::run
