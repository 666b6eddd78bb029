#pragma once

#include <Eigen/Dense>

#include "hersey/solver/equations.h"
#include "hersey/solver/sparse_lu.h"

namespace hersey::solver {

/// Inertia of a motion relative to those of the coordinates in it: below, it has none.
inline constexpr double kNoInertia = 1e-12;

/// 1/sqrt(m_k) of the diagonal of an inertia matrix: coordinates of unit inertia. Those without inertia get the largest
/// of the others' scales.
[[nodiscard]] Eigen::VectorXd inertia_scales(const Eigen::VectorXd& diagonal);

/// S = [M G^T; G D], M of nv rows, as in `solve_kkt` but with any upper left block, scaled to unit inertia and rows of
/// unit length and factorised once: for several right-hand sides; `solve_bordered` is for one.
class SparseKkt {
 public:
  /// @pre S outlives the object
  SparseKkt(const Equations::SparseMatrix& S, Eigen::Index nv);

  /// True if all pivots of the elimination say that no motion is without inertia.
  [[nodiscard]] bool sound() const;

  /// True if every motion that the rows allow has inertia. The condition estimate decreases with the length of a chain
  /// and is then not conclusive; the criterion is the least inertia in the null space, 1/|A|, by a few powers of A: y
  /// -> x,  M x + G^T l = y,  G x = 0.
  [[nodiscard]] bool all_motions_have_inertia(Eigen::Index nv) const;

  /// Solves S x = b, refined; false where that leaves more than round-off.
  /// @pre the matrix could be factorised
  [[nodiscard]] bool solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;

 private:
  const Equations::SparseMatrix& S_;
  Eigen::VectorXd scale_;
  SparseLu lu_;
  bool factorised_ = false;
};

}  // namespace hersey::solver
