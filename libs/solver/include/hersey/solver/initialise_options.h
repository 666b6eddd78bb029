#pragma once

#include <vector>

#include "hersey/solver/equations.h"

namespace hersey::solver {

struct InitialiseOptions {
  double rtol = 1e-12;       ///< constraint residual relative to the lengths it compares
  int max_iterations = 100;  ///< iterations of the assembly, from each guess
  /// Velocity components whose positions are kept if the constraints allow it: those prescribed by the user. Otherwise
  /// they change as little as possible.
  std::vector<Equations::Index> fixed;
  /// Velocity components whose velocities are kept likewise; a prescribed position does not prescribe its rate.
  std::vector<Equations::Index> fixed_rates;
  /// Velocity components that move only if the constraints cannot be satisfied otherwise, not even with the fixed
  /// components free: deformations.
  std::vector<Equations::Index> stiff;
  /// Motions without inertia begin with the rates at which no force acts along them; false: with the given ones, for
  /// who seeks a motion in which they keep still.
  bool balances_massless = true;
};

}  // namespace hersey::solver
