#pragma once

#include <string>

#include "hersey/core/archive.h"

namespace hersey::solver {

/// Interface of a part that may have unknowns of its own (a film, the nodes of an elastic body) and condense them
/// exactly out of a Newton system. The part owns their history between the beginning of a step and its acceptance, and
/// reports their residual. The defaults are those of a part without condensed unknowns.
class CondensedPart {
 public:
  virtual ~CondensedPart() = default;

  /// True if there are condensed unknowns: each evaluation iterates them once, and the tangent is evaluated at their
  /// new values.
  [[nodiscard]] virtual bool has_condensed_unknowns() const { return false; }

  /// True if condensed unknowns move only where the tangent is evaluated: residuals without it say nothing then.
  [[nodiscard]] virtual bool needs_tangent() const { return false; }

  /// Returns the largest relative residual of the condensed equations at the last evaluation; 0 if there are none.
  [[nodiscard]] virtual double internal_residual() const { return 0; }

  /// Returns the name of the condensed equation with `internal_residual`.
  [[nodiscard]] virtual std::string name_of_internal_residual() const { return {}; }

  /// True if the step may end at its last evaluation, which Newton's method found solved. False: a condition on the
  /// step as a whole changes the equations (a film whose oil balance over the step is not satisfied), and they have to
  /// be solved again from there; the function is then called again.
  [[nodiscard]] virtual bool is_step_consistent() { return true; }

  /// Returns why the last evaluated state is outside the domain of the equations, e.g. "bearing big_end: gap closed
  /// (-1.2 um at ...)"; empty if it is inside. Solvers call it after each evaluation and shorten the Newton increment
  /// if the state is outside.
  [[nodiscard]] virtual std::string domain_error() const { return {}; }

  /// Saves or restores everything beside the state on which later steps depend: histories of condensed unknowns, and
  /// data kept between solutions that affect round-off. After restoring, steps are identical to those of the saved run.
  virtual void persist(Archive& archive) { (void)archive; }
};

/// Interface of a part that receives the state of the system as a `Motion`.
template <typename Motion>
class Condensed : public CondensedPart {
 public:
  /// Begins a step from `start` over `dt` [s], possibly again: condensed unknowns return to their state at `start`.
  virtual void begin_step(const Motion& start, double dt) { (void)start, (void)dt; }

  /// Accepts the step, which ended in `end`: condensed unknowns keep their values.
  virtual void accept_step(const Motion& end) { (void)end; }
};

}  // namespace hersey::solver
