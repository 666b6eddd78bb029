#pragma once

#include <Eigen/Dense>
#include <optional>

#include "hersey/solver/equations.h"

namespace hersey::solver {

/// Where a step starts from once what dies out within it has died out.
struct SettledStart {
  Eigen::VectorXd offset;  ///< increment of position that is left of it, shape (nv)
  Eigen::VectorXd v;       ///< velocities then
  Eigen::VectorXd vdot;    ///< accelerations then
};

/// Takes out of the start of a motion what damping lets die out within the first step, dt: a light journal in its film
/// has the acceleration force over mass for a time mass over damping, which a step that does not resolve it must not
/// carry on. Six implicit Euler steps at the positions of `state`, combined by theory manual eq. (integrator.9), leave
/// slow motions as they are to the fifth power of dt and fast ones at the velocity at which forces balance.
///
/// Nothing where there are no such motions, or where they cannot be found.
/// @pre  begin_step(state, dt) was called; it has to be called again before the step
/// @cost up to six solutions of the equations for accelerations by Newton's method
/// @verified_by fast_motions_test.cpp
[[nodiscard]] std::optional<SettledStart> settle_fast_motions(Equations& equations, const State& state, double dt);

}  // namespace hersey::solver
