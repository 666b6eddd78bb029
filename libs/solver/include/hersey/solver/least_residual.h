#pragma once

#include <Eigen/Dense>
#include <vector>

namespace hersey::solver {

/// Affine combination of trials of a fixed-point problem x = P(x) whose residual is least.
struct LeastResidual {
  Eigen::VectorXd weights;  ///< of the trials, their sum is 1
  double norm = 0;          ///< of the combined residual
};

/// Combines trials so that the residual, taken to be linear between them, is least: Anderson's method, for such a
/// problem GMRES (Walker and Ni 2011, SIAM J. Numer. Anal. 49, 1715). To be chosen where an evaluation costs much and
/// few motions decay slowly, such as the map of a machine over one of its periods.
/// @param residuals  P(x) - x of each trial, newest first, one at least; of equal size, with entries of comparable
///        magnitude. Older trials whose residuals depend on those of newer ones have the weight 0.
[[nodiscard]] LeastResidual combine_to_least_residual(const std::vector<Eigen::VectorXd>& residuals);

/// Shares g of changes of a residual with which |residual - sum_k g_k change_k| is least. Changes that depend on
/// earlier ones have the share 0.
/// @param changes  of the residual's size
[[nodiscard]] Eigen::VectorXd shares_of_changes(const Eigen::VectorXd& residual,
                                                const std::vector<Eigen::VectorXd>& changes);

}  // namespace hersey::solver
