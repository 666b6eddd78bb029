#pragma once

#include <limits>

#include "hersey/core/outcome.h"
#include "hersey/fem/constrained_stiffness.h"

namespace hersey::fem {

struct VibrationOptions {
  int count = 20;                                            ///< number of modes wanted, rigid ones included
  double highest = std::numeric_limits<double>::infinity();  ///< highest angular frequency: all modes up to it, if they
                                                             ///< are fewer [rad/s]
  double rtol = 1e-7;  ///< residual of a mode; the squared frequency is then accurate to about rtol^2
};

/// Natural modes in ascending order of frequency.
struct [[nodiscard]] Vibration : Outcome {
  Eigen::VectorXd omega;  ///< angular frequencies [rad/s]; 0 for motions without strain
  Eigen::MatrixXd
      shapes;      ///< (3 n, modes), with M-norm 1, the largest component positive; zero at fixed degrees of freedom
  int rigid = 0;   ///< number of rigid motions among the modes
  int solves = 0;  ///< number of blocks of right-hand sides solved
};

/// Computes modes K phi = omega^2 M phi of a body with `fixed_dofs` at rest, or of a free body, by block Lanczos
/// iteration on (K - sigma M)^-1 M, (elastic.12). A block contains all modes of a multiple frequency up to its size,
/// such as the six zeros of a free body. sigma lies below all frequencies, at an estimate that depends on no unit.
///
/// @param constraints C of C u = 0, ties of the mesh included; not given: the ties alone
/// @see Grimes, Lewis, Simon (1994), SIAM J. Matrix Anal. Appl. 15, 228. @verified_by vibration_test.cpp
[[nodiscard]] Vibration natural_modes(const ElasticBody& body, const std::vector<int>& fixed_dofs,
                                      const VibrationOptions& options = {},
                                      const Eigen::SparseMatrix<double>& constraints = {});

}  // namespace hersey::fem
