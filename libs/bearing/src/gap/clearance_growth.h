#pragma once

#include <algorithm>

#include "hersey/core/archive.h"

namespace hersey::bearing {

/// How the clearance moves with the temperatures of its walls from step to step (theory manual, thermal.43).
class ClearanceGrowth {
 public:
  /// Where a run starts. @param growth  [m]
  void start_at(double growth) { start_ = now_ = target_ = growth; }

  /// Over the step that begins; dt = 0: at an instant.
  void begin_step(double dt) {
    const double over = std::max(over_, least_over_);
    now_ = start_ + (target_ - start_) * (over > 0 ? std::min(1.0, dt / over) : 1.0);
    rate_ = dt > 0 ? (now_ - start_) / dt : 0;
  }
  /// The step of length dt has ended with temperatures that call for `target` [m].
  void accept_step(double target, double dt) {
    start_ = now_, over_ = dt, since_settled_ += dt;
    target_ = target;
  }
  /// The same step's temperatures were others. @param target  that they call for [m]
  void change_target(double target) { target_ = target; }
  /// Temperatures that are kept for cycles have been corrected at the end of one, by no motion of walls: the clearance
  /// follows in about a quarter of the next.
  void settle(double target) {
    least_over_ = 0.25 * since_settled_;
    since_settled_ = 0;
    target_ = target;
  }

  /// At the end of the step, over the clearance as given [m].
  [[nodiscard]] double now() const { return now_; }
  /// In the step [m/s].
  [[nodiscard]] double rate() const { return rate_; }
  /// That temperatures call for [m].
  [[nodiscard]] double target() const { return target_; }

  /// All of it.
  void persist(Archive& archive) {
    archive.io("start", start_), archive.io("now", now_), archive.io("rate", rate_);
    archive.io("target", target_), archive.io("over", over_);
    archive.io("least_over", least_over_), archive.io("since_settled", since_settled_);
  }

 private:
  double start_ = 0, now_ = 0, rate_ = 0, target_ = 0;
  double over_ = 0;           ///< length of the step before [s]
  double least_over_ = 0;     ///< in which the clearance may come to its target [s]
  double since_settled_ = 0;  ///< time since walls were last settled [s]
};

}  // namespace hersey::bearing
