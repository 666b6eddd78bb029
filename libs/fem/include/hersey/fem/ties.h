#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// The ties of a mesh where some degrees of freedom are held.
struct TieConstraints {
  Eigen::SparseMatrix<double> C;  ///< (ties, 3 n), C u = 0, independent on the degrees of freedom that are not held
  std::vector<int> pivots;        ///< of each: a degree of freedom that is not held and in no other of these ties
  Eigen::SparseMatrix<double> of_held;  ///< (rows, 3 n): what ties ask of held degrees of freedom alone
};

/// @param held places of degrees of freedom, any order, repetitions allowed
/// @verified_by tie_test.cpp
[[nodiscard]] TieConstraints tie_constraints(const Mesh& mesh, const std::vector<int>& held);

}  // namespace hersey::fem
