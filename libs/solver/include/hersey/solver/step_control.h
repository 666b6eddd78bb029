#pragma once

#include "hersey/core/archive.h"

namespace hersey::solver {

/// Limits within which steps are chosen.
struct StepControlOptions {
  double smallest = 1e-9;  ///< [s], > 0
  double largest = 1;      ///< [s], >= smallest
  double unit = 0;         ///< > 0: steps are this over powers of 2, where each new step size costs a factorisation [s]
};

/// Chooses step lengths from the errors of the steps before (theory manual eq. (integrator.12)).
///
/// A proportional-integral controller for a local error of third order: it aims below the tolerance, grows by at most
/// a third of a step at a time, since the constraints' own modes bear no fast growth, and keeps the step where the gain
/// would be small.
/// @see Gustafsson (1991), ACM Trans. Math. Softw. 17, 533-554.
/// @verified_by step_control_test.cpp
class StepControl {
 public:
  /// @pre 0 < smallest <= first <= largest, where first is clamped into the limits.
  StepControl(const StepControlOptions& options, double first);

  /// The step to try when `remaining` is left to an instant that must be hit: equal parts where one step does not reach
  /// it and two do, so that no crumb is left. With a unit the largest part of it that fits, wherever parts of it can
  /// reach the instant.
  [[nodiscard]] double proposed(double remaining) const;

  /// The step taken had this error, relative to the tolerance (<= 1).
  void accepted(double dt, double error);
  /// The step tried had this error (> 1). Returns false if no smaller step is allowed.
  [[nodiscard]] bool rejected(double dt, double error);
  /// The step tried had no solution. Returns false if no smaller step is allowed.
  [[nodiscard]] bool failed(double dt);

  [[nodiscard]] double dt() const { return dt_; }

  void persist(Archive& archive);

 private:
  [[nodiscard]] bool shorten(double dt, double factor);
  void accept_part(double dt, double error);
  [[nodiscard]] double part_of_unit(double most) const;

  StepControlOptions options_;
  double dt_;
  double last_error_ = 0.5;
  bool after_rejection_ = false;
};

}  // namespace hersey::solver
