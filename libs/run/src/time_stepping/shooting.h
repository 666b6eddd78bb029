#pragma once

#include <functional>

#include "hersey/core/outcome.h"
#include "time_stepping/period_map.h"

namespace hersey::run {

struct ShootingOptions {
  double tolerance = 1e-3;        ///< of the distance from the periodic motion, in shares of every coordinate's swing
  int most = 20;                  ///< periods
  bool predicts = true;           ///< false: each period begins where the one before has ended
  std::function<bool()> repeats;  ///< whether the figures of the period that has ended are those of the one before
  /// Called at the end of each period with its distance from one that repeats, in shares of every coordinate's swing;
  /// not a number where the period could not be run. May be empty.
  std::function<void(double)> on_period = {};
};

/// Periodic motion of a machine, or why there is none.
struct [[nodiscard]] Shooting : Outcome {
  int periods = 0;           ///< run
  Motion motion;             ///< at the start of a period; that of the last one where none has been found
  std::vector<Motion> near;  ///< by which it was found, the nearest first
};

/// Finds the motion that repeats with the period of a map P: periods are trials of the fixed-point problem x = P(x),
/// and each begins where those before predict the fixed point (theory manual, integrator.44). Motions that decay
/// slowly, or grow, cost a few periods each, those that decay fast none.
[[nodiscard]] Shooting shoot(PeriodMap& map, const ShootingOptions& options);

}  // namespace hersey::run
