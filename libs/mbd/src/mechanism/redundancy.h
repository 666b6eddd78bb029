#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "hersey/solver/equations.h"
#include "tree/tree.h"
#include "tree/tree_motion.h"

namespace hersey::mbd {

/// Rows of `G` that depend on those before them or on better conditioned ones, ascending. Rows are taken in three
/// sweeps, clearly independent ones first; a row whose independent part is below `tolerance`, or `tolerance` of its
/// largest entry, is dependent.
///
/// Sparse elimination with the largest entry of each row as pivot: linear in the number of loops of a chain.
/// @verified_by redundancy_test.cpp: DependentRows_LeaveAnIndependentSet
[[nodiscard]] std::vector<int> dependent_rows(const Eigen::SparseMatrix<double, Eigen::RowMajor>& G, double tolerance);

/// Returns the closing joints' rows that are redundant in all configurations of the mechanism (theory manual, section
/// "Redundant constraints"); empty where the loops cannot be assembled.
/// @param guess   a state near which the loops close
/// @param fixed    velocity components that assembly should not change
[[nodiscard]] std::vector<int> redundant_rows(const Tree& tree, TreeMotion& motion, const solver::State& guess,
                                              const std::vector<Eigen::Index>& fixed);

/// Takes these rows out of the closures (they stay known as Closure::dropped) and numbers the rest afresh.
void drop_rows(Tree& tree, const std::vector<int>& rows);

}  // namespace hersey::mbd
