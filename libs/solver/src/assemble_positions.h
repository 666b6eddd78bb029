#pragma once

#include <Eigen/Dense>

#include "hersey/solver/equations.h"
#include "hersey/solver/initialise_options.h"

namespace hersey::solver {

/// Result of closing the constraints.
struct ClosureResult {
  bool closed = false;
  int iterations = 0;
  double residual = 0;  ///< largest constraint residual relative to its scale
};

/// Closes Phi(q, t) = 0 by damped Gauss-Newton (Levenberg-Marquardt) with small increments, moving `state.q`.
///
/// The damping falls with the residual, so that convergence is quadratic. If the constraints cannot be satisfied, it
/// ends at the least violation, which is a measure of the misfit.
/// @param mobility  weight of each velocity component in the increment, 0: fixed; shape (nv)
/// @cost sparse: one Cholesky factorisation of shape (nlambda, nlambda) per iteration.
[[nodiscard]] ClosureResult close_constraints(Equations& equations, State& state, const Eigen::VectorXd& mobility,
                                              const InitialiseOptions& options);

/// Disturbs `state` by up to a tenth of a radian or of the size in every mobile coordinate: a remedy for an initial
/// guess with a stretched mechanism, at which no direction reduces the residual.
void disturb(const Equations& equations, State& state, const Eigen::VectorXd& mobility);

}  // namespace hersey::solver
