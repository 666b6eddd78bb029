#pragma once

#include <string>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/solver/equations.h"
#include "hersey/solver/initialise_options.h"

namespace hersey::solver {

enum class InitialiseStatus { cannot_assemble, redundant, undetermined, domain_error, consistent };

/// Residual of all constraints of one name if the mechanism cannot be assembled.
struct OpenConstraint {
  std::string name;  ///< name of their rows: "joint right, closing position"
  double size = 0;   ///< Euclidean norm of the residuals of these rows [m; -; unit of a drive]
};

/// Outcome of `initialise`. If it is not solved, the state is unchanged.
struct [[nodiscard]] InitialiseSummary : OutcomeOf<InitialiseStatus, InitialiseStatus::consistent> {
  int iterations = 0;                     ///< iterations of the position assembly
  double residual = 0;                    ///< largest constraint residual relative to its scale
  std::vector<std::string> redundant;     ///< names of rows that depend on other rows
  std::vector<std::string> undetermined;  ///< names of velocity components whose acceleration is not determined
  std::vector<OpenConstraint> open;       ///< residuals at the closest configuration found, the largest first
  std::vector<OpenConstraint> conflict;  ///< residuals with the fixed positions unchanged; empty if these could be kept
};

/// Makes `state` consistent with the constraints at state.t: positions by damped Newton's method with small increments,
/// velocities by projection, accelerations and multipliers from
///
///     [ M  G^T ] [ vdot   ]   [ -h     ]
///     [ G  0   ] [ lambda ] = [ -gamma ],
///
/// theory manual eq. (integrator.22). Ends with begin_step / accept_step of zero length, so that condensed unknowns
/// have their instantaneous solution. Fixed components are not changed if the others can satisfy the constraints;
/// otherwise they are changed as little as possible, in units of position_scales(), from the closest configuration with
/// fixed components. Redundant constraints, undetermined coordinates without inertia, and constraints that cannot be
/// satisfied are reported by name. Motions without inertia but with damping, such as a journal without mass in its
/// film, get the velocity at which the forces along them vanish (integrator.10) and no acceleration.
/// @cost sparse factorisations; O(n^3) once, n = nv + nlambda, only if a fault has to be named.
[[nodiscard]] InitialiseSummary initialise(Equations& equations, State& state, const InitialiseOptions& options = {});

/// Makes the positions of `state` consistent with the constraints at state.t, as `initialise` does first; velocities
/// stay. If it is not solved, the positions are the closest found.
[[nodiscard]] InitialiseSummary assemble_positions(Equations& equations, State& state,
                                                   const InitialiseOptions& options = {});

/// Computes accelerations and multipliers of `state` from its positions and velocities by the same equations; condensed
/// unknowns keep their values at the end of the last step, of length dt. Used at instants at which a drive's
/// acceleration jumps. Returns false and changes nothing if the equations do not determine them.
[[nodiscard]] bool solve_accelerations(Equations& equations, State& state, double dt);

/// Prepares the state for shorter steps. A step over dt leaves velocities that violate the constraints by O(dt^2)
/// (theory manual eq. (integrator.12)), and much shorter steps would correct this violation within their own length.
/// The velocities are projected onto the constraints in the norm of the mass matrix, then accelerations and multipliers
/// are solved. The integrator's history has to be reset afterwards.
/// @param dt  length of the last step [s]
/// @returns false, with the state unchanged, if they are not determined or the state is outside the domain.
[[nodiscard]] bool restart(Equations& equations, State& state, double dt);

}  // namespace hersey::solver
