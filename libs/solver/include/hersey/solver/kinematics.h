#pragma once

#include <string>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/solver/equations.h"

namespace hersey::solver {

enum class KinematicsStatus { singular, undetermined, cannot_close, solved };

/// Outcome of `solve_kinematics`. If it is not solved, the state is unchanged.
struct [[nodiscard]] KinematicsSummary : OutcomeOf<KinematicsStatus, KinematicsStatus::solved> {
  int iterations = 0;                     ///< iterations for the positions
  double residual = 0;                    ///< largest constraint residual relative to its scale
  std::vector<std::string> undetermined;  ///< names of velocity components that constraints and drives leave free
};

/// Returns the names of velocity components that the constraints leave free at `state`; empty if they prescribe every
/// motion.
[[nodiscard]] std::vector<std::string> free_coordinates(Equations& equations, const State& state);

/// Computes the motion that constraints and drives prescribe at state.t and the forces required for it: positions near
/// state.q from Phi = 0, velocities from G v = -Phi_t, accelerations from G vdot = -gamma, multipliers from G^T lambda
/// = -(M vdot + h); theory manual eq. (integrator.24). Nothing is integrated.
///
/// Ends with begin_step / accept_step of zero length.
/// @pre free_coordinates() is empty at the start of the run
[[nodiscard]] KinematicsSummary solve_kinematics(Equations& equations, State& state);

}  // namespace hersey::solver
