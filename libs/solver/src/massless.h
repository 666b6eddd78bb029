#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/solver/equations.h"

namespace hersey::solver {

/// How `balance_massless` went.
struct [[nodiscard]] MasslessSummary : Outcome {
  std::vector<Equations::Index> undetermined;  ///< components of motions that nothing holds; empty: there are none
};

/// Gives motions without inertia the velocity at which the forces along them vanish, N^T h(q, v, t) = 0, by Newton's
/// method with N^T C N: a journal without mass moves as its film lets it (theory manual eq. (integrator.10)). The other
/// motions keep their velocities.
/// @param N  the motions, columns, as `massless_motions` gives them
/// @pre begin_step(state, 0) was called
[[nodiscard]] MasslessSummary balance_massless(Equations& equations, State& state, const Eigen::MatrixXd& N);

}  // namespace hersey::solver
