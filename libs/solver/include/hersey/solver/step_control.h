#pragma once

#include <Eigen/Core>

#include "hersey/core/archive.h"

namespace hersey::solver {

/// Limits within which steps are chosen.
struct StepControlOptions {
  double smallest = 1e-9;  ///< [s], > 0
  double largest = 1;      ///< [s], >= smallest
  double unit = 0;         ///< > 0: steps are this over powers of 2, where each new step size costs a factorisation [s]
};

/// Chooses step lengths from the errors of the steps before (theory manual eq. (integrator.14)).
///
/// Steps follow the motion without lag: the error is that of the step to come, told from the last two, so that on the
/// way out of a hard place steps are those of the way in, and the errors of both cancel as those of equal steps do.
/// What changes fast counts as an error too, which keeps the step where a third derivative passes through zero. Steps
/// grow by at most a third at a time, since the constraints' own modes bear no fast growth.
/// @see Hairer, Lubich and Wanner (2006), Geometric Numerical Integration, ch. VIII.3: reversible step selection.
/// @verified_by step_control_test.cpp
class StepControl {
 public:
  /// @pre 0 < smallest <= first <= largest, where first is clamped into the limits.
  StepControl(const StepControlOptions& options, double first);

  /// The step to try when `remaining` is left to an instant that must be hit: equal parts where one step does not reach
  /// it and two do, so that no crumb is left. With a unit the largest part of it that fits, wherever parts of it can
  /// reach the instant.
  [[nodiscard]] double proposed(double remaining) const;

  /// The step taken had these errors relative to the tolerance, with their signs (within -1..1).
  void accepted(double dt, const Eigen::VectorXd& errors);
  /// The step tried had this error (> 1). Returns false if no smaller step is allowed.
  [[nodiscard]] bool rejected(double dt, double error);
  /// The step tried had no solution. Returns false if no smaller step is allowed.
  [[nodiscard]] bool failed(double dt);

  /// The step wanted next, without regard to instants to hit [s].
  [[nodiscard]] double dt() const { return dt_; }

  /// The step wanted, and what it is told from.
  void persist(Archive& archive);

 private:
  [[nodiscard]] bool shorten(double dt, double factor);
  [[nodiscard]] double wanted(double dt, const Eigen::VectorXd& errors);
  void accept_part(double dt, double wanted);
  [[nodiscard]] double part_of_unit(double most) const;

  StepControlOptions options_;
  double dt_;
  Eigen::VectorXd factors_;  ///< errors of the last step over its length cubed; empty where there is none
  Eigen::VectorXd change_;   ///< of the factors over the last step
  double factor_ = 0;        ///< their size, changes included
  bool after_rejection_ = false;
};

}  // namespace hersey::solver
