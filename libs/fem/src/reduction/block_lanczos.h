#pragma once

#include <Eigen/Dense>
#include <functional>

#include "hersey/core/outcome.h"

namespace hersey::fem {

/// Largest eigenpairs of A, self-adjoint in the inner product x^T B y: A x = theta x.
struct LanczosProblem {
  Eigen::Index size = 0;
  Eigen::Index rank = 0;  ///< dimension of the space that A maps into, at most `size`
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> A, B;
};

struct [[nodiscard]] LanczosResult : Outcome {
  Eigen::VectorXd theta;    ///< descending
  Eigen::MatrixXd vectors;  ///< B-orthonormal
  int solves = 0;
};

/// Block Lanczos iteration with full reorthogonalisation. It ends when the `wanted` largest eigenvalues, or all those
/// not below `smallest`, leave a residual ||A x - theta x||_B below `rtol` theta.
[[nodiscard]] LanczosResult block_lanczos(const LanczosProblem& problem, int wanted, double smallest, double rtol);

}  // namespace hersey::fem
