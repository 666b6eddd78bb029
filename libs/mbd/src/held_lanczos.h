#pragma once

#include <Eigen/Dense>
#include <functional>

namespace hersey::mbd {

struct LanczosModes {
  Eigen::VectorXd theta;    ///< largest eigenvalues, descending
  Eigen::MatrixXd vectors;  ///< M-orthonormal, one column each
};

/// The `count` largest eigenvalues of an operator S that is self-adjoint in the inner product x^T M y, by Lanczos'
/// method with every vector orthogonalised against all before it; starts anew with more vectors until the largest
/// residual is below 1e-10 of its eigenvalue. Eigenvalues that are 0 count as none: fewer columns come back.
/// @param apply  S x
/// @param mass   M x
[[nodiscard]] LanczosModes largest_modes(Eigen::Index size, int count,
                                         const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
                                         const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& mass);

}  // namespace hersey::mbd
