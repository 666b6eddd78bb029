#pragma once

#include <string>

#include "hersey/core/archive.h"

namespace hersey::solver {

/// What may keep unknowns of its own (a film, the nodes of an elastic body) and condense them exactly out of a Newton
/// system: it owns their history between the beginning of a step and its acceptance, and says how well they are solved.
/// Without any the defaults hold.
class CondensedPart {
 public:
  virtual ~CondensedPart() = default;

  /// Whether there are condensed unknowns: each evaluation moves them on, and the tangent is that of the place they
  /// have reached.
  [[nodiscard]] virtual bool has_condensed_unknowns() const { return false; }

  /// Largest relative residual among them at the last evaluation; 0 where there are none.
  [[nodiscard]] virtual double internal_residual() const { return 0; }

  /// Name of the condensed equation behind `internal_residual`.
  [[nodiscard]] virtual std::string name_of_internal_residual() const { return {}; }

  /// Whether the step may end where it was evaluated last and Newton's method found it solved. False: what belongs to
  /// the whole of the step changes the equations (a film whose oil the step's end does not account for), and they are
  /// to be solved once more from there; asked again afterwards.
  [[nodiscard]] virtual bool is_step_consistent() { return true; }

  /// A state outside the domain of the equations, e.g. "bearing big_end: gap closed (-1.2 um at ...)"; empty if inside.
  /// Whoever solves asks after each evaluation and shortens the Newton increment where it is not empty.
  [[nodiscard]] virtual std::string domain_error() const { return {}; }

  /// Everything that steps to come depend on beside the state: histories of condensed unknowns, and what is kept from
  /// one solution to the next if it changes their round-off. After restoring, steps are those of the run that saved.
  virtual void persist(Archive& archive) { (void)archive; }
};

/// The same of a part that sees the system through `Motion`.
template <typename Motion>
class Condensed : public CondensedPart {
 public:
  /// A step from `start` over `dt` [s] begins (again): condensed unknowns return to their state at `start`.
  virtual void begin_step(const Motion& start, double dt) { (void)start, (void)dt; }

  /// The step ended in `end`: condensed unknowns keep what they have.
  virtual void accept_step(const Motion& end) { (void)end; }
};

}  // namespace hersey::solver
