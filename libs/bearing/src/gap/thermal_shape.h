#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

#include "hersey/core/archive.h"

namespace hersey::bearing {

/// How the shape that heat gives a shell moves with the cycles at whose ends its body settles (theory manual,
/// thermal.58): as ClearanceGrowth does, node by node.
class ThermalShape {
 public:
  /// Where a run starts. @param shape  outwards, at the nodes [m]; empty: the shell keeps its shape
  void start_at(Eigen::VectorXd shape) {
    start_ = now_ = target_ = std::move(shape);
    rate_.setZero(now_.size());
  }

  /// Over the step that begins.
  void begin_step(double dt) {
    if (!moves()) return;
    now_ = start_ + std::min(1.0, dt / over_) * (target_ - start_);
    if (dt > 0) rate_ = (now_ - start_) / dt;
  }
  /// The step of length dt has ended.
  void accept_step(double dt) { start_ = now_, since_settled_ += dt; }
  /// The body has settled at the end of a cycle, by no motion of walls: its shape follows in about a quarter of the
  /// next.
  void settle(Eigen::VectorXd target) {
    over_ = 0.25 * since_settled_;
    since_settled_ = 0;
    target_ = std::move(target);
  }

  /// At the end of the step [m], and its rate in the step [m/s].
  [[nodiscard]] const Eigen::VectorXd& now() const { return now_; }
  [[nodiscard]] const Eigen::VectorXd& rate() const { return rate_; }
  /// True if a target has ever been set.
  [[nodiscard]] bool moves() const { return over_ > 0 && now_.size() > 0; }

  /// All of it.
  void persist(Archive& archive) {
    if (now_.size() == 0) return;
    archive.io("shape_start", start_), archive.io("shape_now", now_), archive.io("shape_rate", rate_);
    archive.io("shape_target", target_), archive.io("shape_over", over_);
    archive.io("shape_since_settled", since_settled_);
  }

 private:
  Eigen::VectorXd start_, now_, rate_, target_;
  double over_ = 0;           ///< in which it may come to its target [s]; 0: there is none
  double since_settled_ = 0;  ///< time since the body has last settled [s]
};

}  // namespace hersey::bearing
