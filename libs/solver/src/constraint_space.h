#pragma once

#include <Eigen/Dense>

#include "hersey/solver/equations.h"

namespace hersey::solver {

/// Returns an orthonormal basis Z of the motions that the constraints allow at `state`, G Z = 0 with rows and columns
/// of G divided by their scales; shape (nv, number of free motions). @cost O(nv^3)
[[nodiscard]] Eigen::MatrixXd free_directions(Equations& equations, const State& state);

}  // namespace hersey::solver
