#pragma once

#include <Eigen/Dense>
#include <optional>

#include "hersey/solver/equations.h"

namespace hersey::solver {

/// Start of a step after the fast motions have decayed.
struct SettledStart {
  Eigen::VectorXd offset;  ///< increment of position that the fast motions leave, shape (nv)
  Eigen::VectorXd v;       ///< velocities after the decay
  Eigen::VectorXd vdot;    ///< accelerations after the decay
};

/// Removes from the start of a motion the fast motions that damping ends within the first step, dt: a light journal in
/// its film has the acceleration force over mass for a time of mass over damping, and a step that does not resolve it
/// must not extrapolate it. Six implicit Euler steps at the positions of `state`, combined by theory manual eq.
/// (integrator.9), leave slow motions as they are to the fifth power of dt and fast ones at the velocity at which
/// forces balance.
/// @returns nothing if there are no such motions or they cannot be computed
/// @pre  begin_step(state, dt) was called; it has to be called again before the step
/// @cost up to six solutions of the equations for accelerations by Newton's method
/// @verified_by fast_motions_test.cpp
[[nodiscard]] std::optional<SettledStart> settle_fast_motions(Equations& equations, const State& state, double dt);

}  // namespace hersey::solver
