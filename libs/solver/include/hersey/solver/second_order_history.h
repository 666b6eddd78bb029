#pragma once

#include <Eigen/Dense>

#include "hersey/core/archive.h"
#include "hersey/solver/equations.h"

namespace hersey::solver {

/// Unknowns with second-order dynamics that a contributor condenses, integrated like those of the system: by the same
/// generalized-alpha, with an algorithmic acceleration of their own (theory manual, chapter integrator).
class SecondOrderHistory {
 public:
  /// At rest in `x`, with no history.
  void start(const Eigen::VectorXd& x);

  /// A step begins (again): back to what was accepted.
  void begin_step() { predicted_ = false; }

  /// The step's predicted state, once: later calls in the same step do nothing.
  void predict(const Stage& stage);

  /// Moves the unknowns by dx, as `stage` moves positions.
  void move(const Stage& stage, const Eigen::VectorXd& dx);

  /// The step is over: what is there stays.
  void accept();

  /// What was accepted; where a step is being solved, it begins again after restoring.
  void persist(Archive& archive);

  /// Of the trial where a step is being solved, else of what was accepted.
  [[nodiscard]] const Eigen::VectorXd& position() const { return x_; }
  /// Its rate.
  [[nodiscard]] const Eigen::VectorXd& rate() const { return v_; }
  /// Its acceleration.
  [[nodiscard]] const Eigen::VectorXd& acceleration() const { return vdot_; }

 private:
  Eigen::VectorXd x_, v_, vdot_;                        // trial
  Eigen::VectorXd x_start_, v_start_, vdot_start_, a_;  // accepted; a_ the algorithmic acceleration
  Eigen::VectorXd a_start_;                             // the same, rescaled to this step's length
  Eigen::VectorXd x_predicted_;
  AlphaParameters parameters_;
  double dt_ = 0, last_dt_ = 0;
  bool predicted_ = false;
};

}  // namespace hersey::solver
