#pragma once

#include <Eigen/Dense>

#include "hersey/solver/equations.h"
#include "hersey/solver/initialise_options.h"

namespace hersey::solver {

/// How far Newton's method came in closing the constraints.
struct ClosureResult {
  bool closed = false;
  int iterations = 0;
  double residual = 0;  ///< largest constraint residual relative to its scale
};

/// Closes Phi(q, t) = 0 by damped Gauss-Newton (Levenberg-Marquardt) with small increments, moving `state.q`.
///
/// The damping falls with the residual, so that the end is quadratic; where the constraints cannot be met it ends where
/// they are met best, so that what is left open is a measure of what does not fit.
/// @param mobility  how readily each velocity component moves, 0: held; shape (nv)
/// @cost sparse: one Cholesky factorisation of shape (nlambda, nlambda) per iteration.
[[nodiscard]] ClosureResult close_constraints(Equations& equations, State& state, const Eigen::VectorXd& mobility,
                                              const InitialiseOptions& options);

/// A configuration near `state`, up to a tenth of a radian or of the size away in every coordinate that is mobile: a
/// way out of a guess in which the mechanism is stretched, from where no direction leads on.
void disturb(const Equations& equations, State& state, const Eigen::VectorXd& mobility);

}  // namespace hersey::solver
