#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Ties of a mesh some of whose degrees of freedom are fixed.
struct TieConstraints {
  Eigen::SparseMatrix<double> C;  ///< (ties, 3 n), C u = 0, independent on the free degrees of freedom
  std::vector<int> pivots;        ///< for each tie: a free degree of freedom that occurs in no other of these ties
  Eigen::SparseMatrix<double> on_fixed;  ///< (rows, 3 n): conditions of the ties on fixed degrees of freedom alone
};

/// Returns the constraints of the mesh's ties.
/// @param fixed_dofs indices of degrees of freedom, any order, repetitions allowed
/// @verified_by tie_test.cpp
[[nodiscard]] TieConstraints tie_constraints(const Mesh& mesh, const std::vector<int>& fixed_dofs);

}  // namespace hersey::fem
