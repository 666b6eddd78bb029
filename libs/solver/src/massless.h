#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/solver/equations.h"

namespace hersey::solver {

/// Outcome of `balance_massless`.
struct [[nodiscard]] MasslessSummary : Outcome {
  std::vector<Equations::Index> undetermined;  ///< components of motions without damping; empty if there are none
};

/// Gives motions without inertia the velocity at which the forces along them vanish, N^T h(q, v, t) = 0, by Newton's
/// method with N^T C N: a journal without mass has the velocity at which its film carries the load (theory manual eq.
/// (integrator.10)). Other motions keep their velocities.
/// @param N  the motions, columns, as `massless_motions` gives them
/// @pre begin_step(state, 0) was called
[[nodiscard]] MasslessSummary balance_massless(Equations& equations, State& state, const Eigen::MatrixXd& N);

}  // namespace hersey::solver
