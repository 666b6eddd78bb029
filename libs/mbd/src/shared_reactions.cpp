#include "shared_reactions.h"

#include <Eigen/SparseCore>
#include <span>

#include "hersey/core/contract.h"
#include "hersey/solver/sparse_lu.h"

namespace hersey::mbd {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Basis = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// The wrench about point p instead of ground's origin.
Vector6 about(const Vector3& p, const Vector6& W) {
  Vector6 moved = W;
  moved.head<3>() -= p.cross(W.tail<3>());
  return moved;
}

/// Orthonormal wrenches a joint can transmit, [tau / length; f] about the origin p of its inboard frame.
class ReactionBasis {
 public:
  ReactionBasis(const MechanismSpec& spec, const Tree& tree, const TreeMotion& motion, int joint)
      : length_(tree.length), p_(motion.pose(tree.frames[spec.joints[joint].inboard.index]).r) {
    const JointPlace& place = tree.joints[joint];
    const bool plain = place.value_link.empty() && place.closure >= 0;
    columns_ = plain ? of_closure(tree.closures[place.closure], motion) : across_motions(tree, motion, place);
  }

  [[nodiscard]] Index size() const { return columns_.cols(); }

  /// Components of a wrench at ground's origin.
  [[nodiscard]] VectorXd components(const Vector6& W) const {
    Vector6 scaled = about(p_, W);
    scaled.head<3>() /= length_;
    return columns_.transpose() * scaled;
  }

  /// The wrench at ground's origin of one component, or of all.
  [[nodiscard]] Vector6 wrench(const VectorXd& components) const { return unscaled(columns_ * components); }
  [[nodiscard]] Vector6 column(Index i) const { return unscaled(columns_.col(i)); }

 private:
  [[nodiscard]] Vector6 unscaled(Vector6 W) const {
    W.head<3>() *= length_;
    return about(-p_, W);
  }

  /// What does no work on any motion the joint allows.
  [[nodiscard]] Basis across_motions(const Tree& tree, const TreeMotion& motion, const JointPlace& place) const {
    const auto n = static_cast<Index>(place.value_link.size());
    if (n == 0) return Basis::Identity(6, 6);
    Basis motions(6, n);
    for (Index i = 0; i < n; ++i) {
      const Link& link = tree.links[place.value_link[i]];
      Vector6 J = motion.J(link.first_v + place.value_component[i]);
      J.tail<3>() += J.head<3>().cross(p_);
      J.head<3>() *= length_;
      motions.col(i) = J;
    }
    const Eigen::ColPivHouseholderQR<Basis> qr(motions);
    const Matrix6 Q = qr.householderQ();
    return Q.rightCols(6 - qr.rank());
  }

  [[nodiscard]] Basis of_closure(const Closure& closure, const TreeMotion& motion) const {
    const Pose X_WA = motion.pose(closure.pair.a);
    const Pose X_AB = X_WA.inverse() * motion.pose(closure.pair.b);
    std::vector<ConstraintRow> rows = closure.rows;
    rows.insert(rows.end(), closure.dropped.begin(), closure.dropped.end());
    Basis wrenches(6, static_cast<Index>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Vector6 W = about(p_, force_transform(X_WA) * rows[i].wrench(X_AB));
      W.head<3>() /= length_;
      wrenches.col(static_cast<Index>(i)) = W;
    }
    const Eigen::ColPivHouseholderQR<Basis> qr(wrenches);
    const Matrix6 Q = qr.householderQ();
    return Q.leftCols(qr.rank());
  }

  double length_;
  Vector3 p_;
  Basis columns_;
};

/// x of smallest norm with A x = A x0: x = A^T y, (A A^T) y = A x0. Bodies that can move make A A^T singular along
/// motions on which A x0 has no part; a small shift takes care of them, and refinement of the shift.
VectorXd smallest_equivalent(const Eigen::SparseMatrix<double>& A, const VectorXd& x0) {
  constexpr double shift = 1e-9;
  constexpr int refinements = 4;
  Eigen::SparseMatrix<double> identity(A.rows(), A.rows());
  identity.setIdentity();
  const Eigen::SparseMatrix<double> normal = A * A.transpose();
  const Eigen::SparseMatrix<double> shifted = normal + shift * normal.norm() * identity;
  solver::SparseLu lu;
  lu.analyse(shifted);
  if (!lu.factorise({shifted.valuePtr(), static_cast<std::size_t>(shifted.nonZeros())})) return x0;
  const VectorXd b = A * x0;
  VectorXd x = VectorXd::Zero(x0.size());
  for (int i = 0; i < refinements; ++i) {
    VectorXd y = b - A * x;
    lu.solve({y.data(), static_cast<std::size_t>(y.size())});
    x += A.transpose() * y;
  }
  return x;
}

}  // namespace

void share_reactions(const MechanismSpec& spec, const Tree& tree, const TreeMotion& motion,
                     std::vector<Vector6>& wrenches) {
  const auto body_of = [&](FrameId frame) { return spec.frames[frame.index].body.index; };
  std::vector<ReactionBasis> bases;
  bases.reserve(spec.joints.size());
  Index unknowns = 0;
  for (std::size_t j = 0; j < spec.joints.size(); ++j) {
    bases.emplace_back(spec, tree, motion, static_cast<int>(j));
    unknowns += bases.back().size();
  }
  // Columns: what a unit of each component does to the two bodies it joins, about each body's own origin.
  std::vector<Eigen::Triplet<double>> entries;
  VectorXd x(unknowns);
  Index at = 0;
  for (std::size_t j = 0; j < spec.joints.size(); ++j) {
    const ReactionBasis& basis = bases[j];
    x.segment(at, basis.size()) = basis.components(wrenches[j]);
    for (Index i = 0; i < basis.size(); ++i) {
      const Vector6 W = basis.column(i);
      for (const auto& [frame, sign] : {std::pair{spec.joints[j].outboard, 1.0}, {spec.joints[j].inboard, -1.0}}) {
        const int body = body_of(frame);
        if (body == 0) continue;
        Vector6 seen = about(motion.pose(tree.bodies[body]).r, W);
        seen.head<3>() /= tree.length;
        for (int row = 0; row < 6; ++row) entries.emplace_back(6 * (body - 1) + row, at + i, sign * seen[row]);
      }
    }
    at += basis.size();
  }
  Eigen::SparseMatrix<double> A(6 * (static_cast<Index>(spec.bodies.size()) - 1), unknowns);
  A.setFromTriplets(entries.begin(), entries.end());
  const VectorXd least = smallest_equivalent(A, x);
  at = 0;
  for (std::size_t j = 0; j < spec.joints.size(); ++j) {
    // What the joint cannot transmit (round-off of the solution) stays with it.
    wrenches[j] += bases[j].wrench(least.segment(at, bases[j].size()) - x.segment(at, bases[j].size()));
    at += bases[j].size();
  }
}

}  // namespace hersey::mbd
