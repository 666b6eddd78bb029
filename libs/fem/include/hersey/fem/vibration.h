#pragma once

#include <limits>

#include "hersey/core/outcome.h"
#include "hersey/fem/constrained_stiffness.h"

namespace hersey::fem {

struct VibrationOptions {
  int count = 20;                                            ///< modes wanted, rigid ones included
  double highest = std::numeric_limits<double>::infinity();  ///< or all up to this angular frequency [rad/s], if fewer
  double rtol = 1e-7;  ///< residual of a mode; the squared frequency is then good to about rtol^2
};

/// Natural modes in ascending order of frequency.
struct [[nodiscard]] Vibration : Outcome {
  Eigen::VectorXd omega;   ///< angular frequencies [rad/s]; 0 for motions that strain nothing
  Eigen::MatrixXd shapes;  ///< (3 n, modes), with M-norm 1, the largest component positive; zero where held
  int rigid = 0;           ///< how many are motions without strain
  int solves = 0;          ///< blocks of right-hand sides solved
};

/// Modes K phi = omega^2 M phi of a body with `held` degrees of freedom at rest, or of a free one, by block Lanczos
/// iteration on (K - sigma M)^-1 M, (elastic.12); a block holds the whole of any multiple frequency up to its size,
/// such as the six zeros of a free body. sigma lies below all frequencies, at an estimate that depends on no unit.
///
/// @param constraints C of C u = 0, ties of the mesh included; not given: those ties alone
/// @see Grimes, Lewis, Simon (1994), SIAM J. Matrix Anal. Appl. 15, 228. @verified_by vibration_test.cpp
[[nodiscard]] Vibration natural_modes(const ElasticBody& body, const std::vector<int>& held,
                                      const VibrationOptions& options = {},
                                      const Eigen::SparseMatrix<double>& constraints = {});

}  // namespace hersey::fem
