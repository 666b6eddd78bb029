#pragma once

#include <string>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/solver/equations.h"
#include "hersey/solver/initialise_options.h"

namespace hersey::solver {

enum class InitialiseStatus { cannot_assemble, redundant, undetermined, domain_error, consistent };

/// What is left open of the constraints of one name where the mechanism cannot be assembled.
struct OpenConstraint {
  std::string name;  ///< of their rows: "joint right, closing position"
  double size = 0;   ///< Euclidean norm of the residuals of these rows [m; -; unit of a drive]
};

/// Outcome of `initialise`. Unless it is solved, the state consistent, that is unchanged.
struct [[nodiscard]] InitialiseSummary : OutcomeOf<InitialiseStatus, InitialiseStatus::consistent> {
  int iterations = 0;                     ///< of the position assembly
  double residual = 0;                    ///< largest constraint residual relative to its scale
  std::vector<std::string> redundant;     ///< rows that constrain a motion constrained already, by name
  std::vector<std::string> undetermined;  ///< velocity components whose motion nothing determines, by name
  std::vector<OpenConstraint> open;       ///< at the closest configuration found, the widest first
  std::vector<OpenConstraint> conflict;   ///< the same with the held positions at rest; empty where these could stay
};

/// Makes `state` consistent with the constraints at state.t: positions by damped Newton's method with small increments,
/// velocities by projection, accelerations and multipliers from
///
///     [ M  G^T ] [ vdot   ]   [ -h     ]
///     [ G  0   ] [ lambda ] = [ -gamma ],
///
/// theory manual eq. (integrator.22). Ends with begin_step / accept_step of zero length, so that condensed unknowns
/// hold their instantaneous solution.
///
/// Held components stay as they are if the others can close the constraints; otherwise they change by the least, in
/// units of position_scales(), from the closest configuration that they allow. Constraints that say the same thing
/// twice, and coordinates without inertia that nothing holds, are reported by name; so is what stays open where the
/// constraints cannot be met. Motions without inertia that damping holds, a journal without mass in its film, get the
/// velocity at which the forces along them vanish (integrator.10), and no acceleration.
/// @cost sparse factorisations; O(n^3) once, n = nv + nlambda, only where something is wrong and has to be named.
[[nodiscard]] InitialiseSummary initialise(Equations& equations, State& state, const InitialiseOptions& options = {});

/// Accelerations and multipliers of `state` from its positions and velocities, by the same equations; condensed
/// unknowns keep what they had at the end of the last step, of length dt. For instants at which a drive's acceleration
/// jumps. False, and nothing changed, if the equations do not determine them.
[[nodiscard]] bool solve_accelerations(Equations& equations, State& state, double dt);

/// Makes the state one from which shorter steps can start: a step over dt leaves velocities across the constraints that
/// differ by O(dt^2) from those the constraints allow (theory manual eq. (integrator.12)), which much shorter steps
/// would take back within their own length. They are taken off with the least change of kinetic energy's measure, then
/// accelerations and multipliers solved. The integrator's history starts anew behind it.
/// @param dt  length of the last step [s]
/// @returns false, the state unchanged, where they are not determined or the state is outside of the domain.
[[nodiscard]] bool restart(Equations& equations, State& state, double dt);

}  // namespace hersey::solver
