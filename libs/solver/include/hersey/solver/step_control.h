#pragma once

#include <Eigen/Core>

#include "hersey/core/archive.h"

namespace hersey::solver {

/// Limits of the step length.
struct StepControlOptions {
  double smallest = 1e-9;  ///< [s], > 0
  double largest = 1;      ///< [s], >= smallest
  double unit = 0;   ///< > 0: step lengths are this value divided by powers of 2; for cases in which each new length
                     ///< costs a factorisation [s]
  double order = 3;  ///< the error of a step goes as its length to this power
  /// Steps over which an error's present change counts as an error: keeps low orders short where their error passes
  /// through zero.
  double reach = 8;
  double largest_growth = 1.3;  ///< of a step over the one before
};

/// Chooses step lengths from the errors of previous steps (theory manual eq. (integrator.14)).
/// Step lengths follow the motion without lag: they are chosen by the error of the next step, extrapolated from the
/// last two. Steps before and after an instant of large errors are then equal, and their errors cancel as those of
/// equal steps do. The rate of change of an error counts as an error, too, which keeps the step short where a third
/// derivative passes through zero. Steps grow by at most a third at a time, since faster growth excites the modes of
/// the constraints.
/// @see Hairer, Lubich and Wanner (2006), Geometric Numerical Integration, ch. VIII.3: reversible step selection.
/// @verified_by step_control_test.cpp
class StepControl {
 public:
  /// @pre 0 < smallest <= first <= largest, where first is clamped into the limits.
  StepControl(const StepControlOptions& options, double first);

  /// Returns the next step to try if an instant that must be hit lies `remaining` ahead. If two steps but not one reach
  /// the instant, they are equal, so that no short remainder is left. With a unit it is the largest part of the unit
  /// that fits, provided that parts of it can reach the instant.
  [[nodiscard]] double proposed(double remaining) const;

  /// Reports an accepted step with its signed errors relative to the tolerance (within -1..1).
  void accepted(double dt, const Eigen::VectorXd& errors);
  /// Reports a rejected step with its error relative to the tolerance (> 1). Returns false if no smaller step is
  /// allowed.
  [[nodiscard]] bool rejected(double dt, double error);
  /// Reports a step without a solution. Returns false if no smaller step is allowed.
  [[nodiscard]] bool failed(double dt);

  /// Returns the length of the next step [s], irrespective of instants to hit.
  [[nodiscard]] double dt() const { return dt_; }

  /// Saves or restores the next step length and the history from which it is chosen.
  void persist(Archive& archive);

 private:
  [[nodiscard]] bool shorten(double dt, double factor);
  [[nodiscard]] double wanted(double dt, const Eigen::VectorXd& errors);
  void accept_part(double dt, double wanted);
  [[nodiscard]] double part_of_unit(double most) const;

  StepControlOptions options_;
  double dt_;
  Eigen::VectorXd factors_;  ///< errors of the last step divided by its length cubed; empty if there is none
  Eigen::VectorXd change_;   ///< change of `factors_` over the last step
  double factor_ = 0;        ///< norm of `factors_`, changes included
  bool after_rejection_ = false;
};

}  // namespace hersey::solver
