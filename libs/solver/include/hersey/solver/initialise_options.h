#pragma once

#include <vector>

#include "hersey/solver/equations.h"

namespace hersey::solver {

struct InitialiseOptions {
  double rtol = 1e-12;       ///< constraint residual relative to the lengths it compares
  int max_iterations = 100;  ///< iterations of the assembly, from each guess
  /// Velocity components whose positions stay as they are if the constraints allow it: what the user prescribed. Where
  /// they do not, these change as little as closes them.
  std::vector<Equations::Index> held;
  /// The same for velocities: a prescribed position says nothing about its rate.
  std::vector<Equations::Index> held_rates;
  /// Those that should move only if even freeing the held ones does not close the constraints: deformations.
  std::vector<Equations::Index> stiff;
};

}  // namespace hersey::solver
