#pragma once

#include <string>

#include "hersey/core/outcome.h"
#include "hersey/solver/equations.h"

namespace hersey::solver {

struct EquilibriumOptions {
  double rtol = 1e-10;       ///< out-of-balance force of every row, relative to the terms it balances
  int max_iterations = 500;  ///< Newton iterations
  /// Search for a steady motion instead of rest: the state keeps its velocities, for example those of drives of
  /// constant speed, and all other coordinates are at rest. Stability is then not checked; the modes show it.
  bool steady_motion = false;
};

/// Stability of an equilibrium: stable if small motions about it return to it.
enum class EquilibriumKind { stable, neutral, unstable };

/// Outcome of `find_equilibrium`. If it is not solved the state is unchanged. If it is solved but not stable, the
/// message says so.
struct [[nodiscard]] EquilibriumSummary : Outcome {
  int iterations = 0;
  double residual = 0;    ///< largest row residual relative to its tolerance
  std::string worst_row;  ///< name of the row with `residual`
  EquilibriumKind kind = EquilibriumKind::stable;
  std::string
      softest;  ///< name of the coordinate that moves most in the motion of least stiffness; empty if no motion is free
};

/// Finds the static equilibrium under the forces at state.t, r(q, 0, 0, lambda) = 0 and Phi(q) = 0, starting from the
/// consistent `state`. Newton's method with a multiple of the mass matrix added to the stiffness, (K + mu M) dq + G^T
/// lambda = -r: a large mu gives a small step in the direction of the forces, as in overdamped motion; mu = 0 is
/// Newton's method. mu decreases with the residual and increases if a step overshoots, so that the method descends to a
/// stable equilibrium even under full loads and converges quadratically. Theory manual eq. (integrator.25). If it
/// fails, as for very slender beams, the load is increased in steps (integrator.26). With `steady_motion` r(q, v, 0,
/// lambda) = 0, eq. (beams.8), is solved by Newton's method, eq. (integrator.34), and if that halts, by following the
/// motion without inertia, eq. (integrator.35).
[[nodiscard]] EquilibriumSummary find_equilibrium(Equations& equations, State& state,
                                                  const EquilibriumOptions& options = {});

}  // namespace hersey::solver
