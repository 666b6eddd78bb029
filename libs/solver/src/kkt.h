#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "hersey/solver/equations.h"

namespace hersey::solver {

/// Rows of `G` that depend on others, found by rank-revealing QR of the normalised rows.
struct RankAnalysis {
  Eigen::Index rank = 0;
  std::vector<Eigen::Index> involved;  ///< rows of every dependency, ascending; empty at full rank
};
[[nodiscard]] RankAnalysis analyse_rank(const Eigen::MatrixXd& G);

/// Solves  M vdot + G^T lambda = -h,  G vdot = -gamma  in the null space of G.
struct AccelerationSolution {
  Eigen::VectorXd vdot, lambda;
  std::vector<Eigen::Index> undetermined;  ///< components along which a motion without inertia is left; empty: solved
};
/// @pre G has full row rank; M is symmetric positive semidefinite
[[nodiscard]] AccelerationSolution solve_kkt(const Eigen::MatrixXd& M, const Eigen::MatrixXd& G,
                                             const Eigen::VectorXd& h, const Eigen::VectorXd& gamma);

/// Assembles at dt = 0 and vdot = lambda = 0 until condensed unknowns are solved to 1e-10: forces h and mass matrix M.
/// Returns what went wrong, or nothing.
[[nodiscard]] std::string assemble_forces(Equations& equations, const State& state, Eigen::VectorXd& h,
                                          Eigen::MatrixXd& M);

}  // namespace hersey::solver
