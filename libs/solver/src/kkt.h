#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/core/outcome.h"
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

/// Solves the same equations, sparse, for square S = [M G^T; G D], D diagonal with entries only in rows that are
/// switched off. Falls back to the dense solution, @cost O(n^3), only where a motion may have no inertia: it is exact
/// or names that motion.
[[nodiscard]] AccelerationSolution solve_kkt(const Equations::SparseMatrix& S, Eigen::Index nv,
                                             const Eigen::VectorXd& h, const Eigen::VectorXd& gamma);

/// Solves S x = b for S as above with any sparse upper left block; false where that leaves more than round-off.
[[nodiscard]] bool solve_bordered(const Equations::SparseMatrix& S, Eigen::Index nv, const Eigen::VectorXd& b,
                                  Eigen::VectorXd& x);

/// Puts the constraint Jacobian G, which a stage with k = 0 leaves out, into the lower left of S.
void fill_jacobian(const Equations::SparseMatrix& G, Eigen::Index nv, Equations::SparseMatrix& S);

/// Returns the free motions without inertia, one per column; S as in solve_kkt. @cost O(n^3)
[[nodiscard]] Eigen::MatrixXd massless_motions(const Equations::SparseMatrix& S, Eigen::Index nv);

/// Solves like solve_kkt with zero accelerations of massless motions. @pre the forces along these vanish
[[nodiscard]] AccelerationSolution solve_kkt_but_massless(const Equations::SparseMatrix& S, Eigen::Index nv,
                                                          const Eigen::VectorXd& h, const Eigen::VectorXd& gamma);

/// True if the rows of G are independent, by sparse QR: cheap; `analyse_rank` finds the dependent rows.
[[nodiscard]] bool has_full_rank(const Equations::SparseMatrix& G);

/// The smallest dx, in the weighted norm, with G dx = -residual, for G of full row rank.
[[nodiscard]] Eigen::VectorXd smallest_increment(const Equations::SparseMatrix& G, const Eigen::VectorXd& residual,
                                                 const Eigen::VectorXd& weight);

/// Assembles at vdot = lambda = 0, over a step of length dt, until condensed unknowns are solved to 1e-10: forces h and
/// S = [M G^T; G D] as in solve_kkt.
[[nodiscard]] Outcome assemble_forces(Equations& equations, const State& state, double dt, Eigen::VectorXd& h,
                                      Equations::SparseMatrix& S);

}  // namespace hersey::solver
