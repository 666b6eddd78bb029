#pragma once

#include <vector>

#include "hersey/mbd/two_body_force.h"
#include "hersey/solver/equations.h"
#include "tree/tree.h"
#include "tree/tree_motion.h"

namespace hersey::mbd {

/// Effect of an increment of one velocity component on the motion at the stage being solved, per column k of the tree
/// (theory manual eq. (mechanisms.10); the parts beyond the rotation with the column are those of (mechanisms.7) and
/// (mechanisms.8)). J~ is the column rotated by the increment so far (balls: J T(dq)) and p, c the parent and child
/// side of its elementary joint:
struct Direction {
  Vector6 J = Vector6::Zero();  ///< k J~: displacement
  Vector6 H = Vector6::Zero();  ///< k V_p x J~ + c J: velocity beyond the rotation with the column
  Vector6 E = Vector6::Zero();  ///< acceleration beyond the rotation with the column
};

/// Output of one assembly: residual, scale and optionally tangent, with the motion at which they are evaluated.
struct Assembly {
  const Tree& tree;
  const TreeMotion& motion;
  const solver::Stage& stage;
  const std::vector<Direction>& directions;  ///< directions of this motion if there is a tangent
  Eigen::VectorXd& residual;
  Eigen::VectorXd& scale;
  solver::Equations::SparseMatrix* tangent;

  /// Adds `force` (and its magnitude) to row `row`.
  void add_residual(Eigen::Index row, double force, double magnitude) {
    residual[row] += force;
    scale[row] += magnitude;
  }
  void add_tangent(Eigen::Index row, Eigen::Index column, double value) { tangent->coeffRef(row, column) += value; }

  /// True if the tangent is a multiple of the mass matrix, as explicit methods and consistent starts need it.
  [[nodiscard]] bool is_of_inertia_alone() const { return stage.k == 0 && stage.c == 0; }
};

/// Magnitude of the terms of J . W.
[[nodiscard]] inline double magnitude(const Vector6& J, const Vector6& W) { return J.cwiseAbs().dot(W.cwiseAbs()); }

void compute_directions(const Tree& tree, const TreeMotion& motion, const solver::Stage& stage,
                        std::vector<Direction>& directions);

/// Composite inertia terms of every subtree.
class InertiaTerms {
 public:
  explicit InertiaTerms(const Tree& tree);

  /// Adds inertia and gravity (theory manual eq. (mechanisms.6)) and their tangent (eq. (mechanisms.11)).
  void add(Assembly& assembly);

 private:
  void gather(const Assembly& assembly);
  void add_tangent(Assembly& assembly) const;

  std::vector<Matrix6> I_, B_;          ///< composite inertia, composite velocity coupling
  std::vector<Vector6> F_, magnitude_;  ///< composite inertia wrench and the size of its parts
};

/// Adds a wrench that frame a's body puts on frame b's, and its negative on a's (theory manual eq. (mechanisms.12)).
/// @param response  as a TwoBodyForce gives it: on b, at a's origin and in a's axes
void add_pair_force(Assembly& assembly, const Pair& pair, const ForceResponse& response);

}  // namespace hersey::mbd
