#pragma once

#include <span>
#include <vector>

#include "hersey/mbd/two_body_force.h"

namespace hersey::mbd {

/// The mechanism at one evaluation, as far as unknowns that forces share depend on it.
struct SharedMotion {
  double t = 0;                             ///< time [s]
  double dt = 0;                            ///< length of the step being solved [s]; 0: steady or instantaneous
  std::span<const RelativeMotion> motions;  ///< of all two-body forces, in the order of the mechanism
  std::span<const double> rates;            ///< of the joint coordinates on which the unknowns depend [rad/s or m/s]
};

/// Unknowns that several two-body forces share, as films share the pressures of an oil circuit. They are condensed as a
/// force's own are: within an evaluation they first follow the motion of all forces, then these are evaluated, then
/// what they share moves on by its Newton increment and their responses with it.
///
/// The response of each force includes the answer of what is shared to the force's own motion; that to the motion of
/// the others comes with the next evaluation.
class SharedUnknowns : public solver::CondensedPart {
 public:
  /// Begins a step over `dt` [s] from the state accepted last, possibly again.
  virtual void begin_step(double dt) { (void)dt; }
  /// Comes before the forces are evaluated.
  virtual void follow(const SharedMotion& motion) = 0;
  /// Comes after the forces have been evaluated; completes the responses of those that share the unknowns.
  /// @param responses  of all two-body forces, in the order of the mechanism
  virtual void condense(std::span<ForceResponse> responses) = 0;
  /// Accepts the step; the forces have not accepted it yet.
  virtual void accept_step() {}
};

}  // namespace hersey::mbd
