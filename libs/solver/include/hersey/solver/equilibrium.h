#pragma once

#include <string>

#include "hersey/core/outcome.h"
#include "hersey/solver/equations.h"

namespace hersey::solver {

struct EquilibriumOptions {
  double rtol = 1e-10;       ///< out-of-balance force of every row, relative to the terms it balances
  int max_iterations = 500;  ///< Newton iterations
  /// Steady motion instead of rest: the state keeps its velocities, of drives that turn at constant speed for example,
  /// and everything else keeps still in its coordinates. Stability is not judged then: modes tell it.
  bool turning = false;
};

/// Whether small motions about an equilibrium come back to it.
enum class EquilibriumKind { stable, neutral, unstable };

/// Outcome of `find_equilibrium`. Unless it is solved the state is unchanged; a solved one that is not stable has a
/// message that says so.
struct [[nodiscard]] EquilibriumSummary : Outcome {
  int iterations = 0;
  double residual = 0;    ///< largest row residual relative to its tolerance
  std::string worst_row;  ///< the row behind `residual`, by name
  EquilibriumKind kind = EquilibriumKind::stable;
  std::string softest;  ///< coordinate that moves most in the motion of least stiffness, by name; empty if none is free
};

/// Rest under the forces at state.t: r(q, 0, 0, lambda) = 0 and Phi(q) = 0, from the consistent `state`.
///
/// Newton's method with a share of the mass matrix added to the stiffness, (K + mu M) dq + G^T lambda = -r: a large mu
/// goes a small way the forces push, as overdamped motion would, mu = 0 is Newton's method. mu falls with the residual,
/// and rises where a step overshoots; so the method slides down to a stable equilibrium, whatever loads are applied
/// at once, and ends quadratically. Theory manual eq. (integrator.25). Where it does not arrive, as with very slender
/// beams, the load is followed from none to all of it (integrator.26). With `turning` r(q, v, 0, lambda) = 0 by
/// Newton's method, eq. (beams.8).
[[nodiscard]] EquilibriumSummary find_equilibrium(Equations& equations, State& state,
                                                  const EquilibriumOptions& options = {});

}  // namespace hersey::solver
