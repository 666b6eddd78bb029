#pragma once

#include <Eigen/Dense>

#include "hersey/core/archive.h"
#include "hersey/solver/equations.h"

namespace hersey::solver {

/// Time integration of condensed unknowns with second-order dynamics by the same generalized-alpha method as the
/// system, with an algorithmic acceleration of their own (theory manual, chapter integrator).
class SecondOrderHistory {
 public:
  /// Sets the unknowns to rest at `x` without history.
  void start(const Eigen::VectorXd& x);

  /// Begins a step, possibly again: the unknowns return to the accepted state.
  void begin_step() { predicted_ = false; }

  /// Predicts the state at the end of the step; later calls in the same step have no effect.
  void predict(const Stage& stage);

  /// Moves the unknowns by the increment dx of position, and rates and accelerations according to `stage`.
  void move(const Stage& stage, const Eigen::VectorXd& dx);

  /// Accepts the present state.
  void accept();

  /// Saves or restores the accepted state; a step that is being solved begins again after restoring.
  void persist(Archive& archive);

  /// Returns the unknowns of the trial state while a step is being solved, otherwise of the accepted state.
  [[nodiscard]] const Eigen::VectorXd& position() const { return x_; }
  /// Returns the rates of position().
  [[nodiscard]] const Eigen::VectorXd& rate() const { return v_; }
  /// Returns the accelerations of position().
  [[nodiscard]] const Eigen::VectorXd& acceleration() const { return vdot_; }

 private:
  Eigen::VectorXd x_, v_, vdot_;                        // trial state
  Eigen::VectorXd x_start_, v_start_, vdot_start_, a_;  // accepted state; a_ is the algorithmic acceleration
  Eigen::VectorXd a_start_;                             // algorithmic acceleration rescaled to the length of this step
  Eigen::VectorXd x_predicted_;
  AlphaParameters parameters_;
  double dt_ = 0, last_dt_ = 0;
  bool predicted_ = false;
};

}  // namespace hersey::solver
