#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/solver/linearise.h"

namespace hersey::solver {

/// Stiffness and damping of chosen coordinates, with all others following them.
struct ReducedCoefficients {
  Eigen::MatrixXd K;  ///< shape (chosen, chosen)
  Eigen::MatrixXd C;  ///< likewise
};

/// Returns the coefficients of the forces that harmonic motions of the chosen coordinates meet while no force acts on
/// the others: those of a bearing as its journal sees them, for example, while its pads follow. Theory manual eqs.
/// (pads.4), (pads.5).
/// @param linear  small motions about a state
/// @param chosen  velocity components, whose motions must be free and independent; their own inertia is left out
/// @param omega  angular frequency [rad/s], >= 0; at 0 the limit of slow motions
/// @cost O(free^3)
[[nodiscard]] ReducedCoefficients reduce(const Linearisation& linear, const std::vector<Equations::Index>& chosen,
                                         double omega);

}  // namespace hersey::solver
