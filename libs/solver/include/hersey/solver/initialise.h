#pragma once

#include <string>
#include <vector>

#include "hersey/solver/equations.h"

namespace hersey::solver {

struct InitialiseOptions {
  double rtol = 1e-12;      ///< constraint residual relative to the lengths it compares
  int max_iterations = 50;  ///< Newton iterations of the assembly
  /// Velocity components the assembly should leave as they are if the constraints allow it: what the user prescribed.
  std::vector<Equations::Index> held;
};

enum class InitialiseStatus { consistent, cannot_assemble, redundant, undetermined, domain_error };

/// Outcome of `initialise`. Unless `status` is `consistent` the state is unchanged.
struct InitialiseSummary {
  InitialiseStatus status = InitialiseStatus::cannot_assemble;
  int iterations = 0;                     ///< of the position assembly
  double residual = 0;                    ///< largest constraint residual relative to its scale
  std::vector<std::string> redundant;     ///< rows that constrain a motion constrained already, by name
  std::vector<std::string> undetermined;  ///< velocity components whose acceleration nothing determines, by name
  std::string message;                    ///< empty when consistent

  [[nodiscard]] bool consistent() const { return status == InitialiseStatus::consistent; }
};

/// Makes `state` consistent with the constraints at state.t: positions by Newton's method with increments of smallest
/// norm, velocities by projection, accelerations and multipliers from
///
///     [ M  G^T ] [ vdot   ]   [ -h     ]
///     [ G  0   ] [ lambda ] = [ -gamma ],
///
/// theory manual eq. (integrator.9). Ends with begin_step / accept_step of zero length, so that condensed unknowns hold
/// their instantaneous solution.
///
/// Constraints that say the same thing twice, and coordinates without inertia that nothing holds, are reported by name.
/// @cost O(n^3) once, n = nv + nlambda.
[[nodiscard]] InitialiseSummary initialise(Equations& equations, State& state, const InitialiseOptions& options = {});

}  // namespace hersey::solver
