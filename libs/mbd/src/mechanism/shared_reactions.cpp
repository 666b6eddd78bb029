#include "mechanism/shared_reactions.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace hersey::mbd {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Basis = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>;

/// The wrench about point p instead of ground's origin.
Vector6 about(const Vector3& p, const Vector6& W) {
  Vector6 moved = W;
  moved.head<3>() -= p.cross(W.tail<3>());
  return moved;
}

/// Takes a scaled wrench about a point to one `arm` lengths behind it.
Matrix6 shift_by(const Vector3& arm) {
  Matrix6 M = Matrix6::Identity();
  M.topRightCorner<3, 3>() = skew(arm);
  return M;
}

/// Onto what does no work on any motion the joint allows.
Matrix6 across_motions(const Tree& tree, const TreeMotion& motion, const JointIndices& indices, const Vector3& p) {
  const Index n =
      std::clamp(indices.value_count, 0, 6);  // a compiler that does not know so warns of copies of any size
  if (n == 0) return Matrix6::Identity();
  Basis motions(6, n);
  for (Index i = 0; i < n; ++i) {
    const ValueIndex& at = indices.values[i];
    Vector6 J = motion.J(tree.links[at.link].first_v + at.component);
    J.tail<3>() += J.head<3>().cross(p);
    J.head<3>() *= tree.length;
    motions.col(i) = J;
  }
  const Eigen::ColPivHouseholderQR<Basis> qr(motions);
  const Matrix6 Q = qr.householderQ();
  const Basis across = Q.rightCols(6 - qr.rank());
  return across * across.transpose();
}

/// Onto the wrenches of a closure's rows, the dropped ones included.
Matrix6 of_closure(const Tree& tree, const Closure& closure, const TreeMotion& motion, const Vector3& p) {
  const Pose X_WA = motion.pose(closure.pair.a);
  const Pose X_AB = X_WA.inverse() * motion.pose(closure.pair.b);
  Basis wrenches(6, static_cast<Index>(closure.rows.size() + closure.dropped.size()));
  Index at = 0;
  for (const std::vector<ConstraintRow>* rows : {&closure.rows, &closure.dropped})
    for (const ConstraintRow& row : *rows) {
      Vector6 W = about(p, force_transform(X_WA) * row.wrench(X_AB));
      W.head<3>() /= tree.length;
      wrenches.col(at++) = W;
    }
  const Eigen::ColPivHouseholderQR<Basis> qr(wrenches);
  const Matrix6 Q = qr.householderQ();
  const Basis range = Q.leftCols(qr.rank());
  return range * range.transpose();
}

/// Bodies that joints connect without ground between them, each named by one of its members.
class Groups {
 public:
  explicit Groups(std::size_t bodies) : parent_(bodies) { std::iota(parent_.begin(), parent_.end(), 0); }

  int of(int body) {
    while (parent_[static_cast<std::size_t>(body)] != body) {
      int& up = parent_[static_cast<std::size_t>(body)];
      up = parent_[static_cast<std::size_t>(up)];
      body = up;
    }
    return body;
  }
  void join(int a, int b) { parent_[static_cast<std::size_t>(of(a))] = of(b); }

 private:
  std::vector<int> parent_;
};

}  // namespace

SharedReactions::SharedReactions(const MechanismSpec& spec, const Tree&, const std::vector<int>& redundant) {
  const auto body_of = [&](FrameId frame) { return spec.frames[frame.index].body.index; };
  Groups groups(spec.bodies.size());
  for (const JointSpec& joint : spec.joints)
    if (body_of(joint.inboard) != 0 && body_of(joint.outboard) != 0)
      groups.join(body_of(joint.inboard), body_of(joint.outboard));
  const auto group_of = [&](const JointSpec& joint) {
    return groups.of(body_of(joint.outboard) != 0 ? body_of(joint.outboard) : body_of(joint.inboard));
  };
  std::vector<char> shares(spec.bodies.size(), 0);
  for (const int j : redundant) shares[group_of(spec.joints[j])] = 1;
  std::vector<int> row(spec.bodies.size(), -1);
  const auto row_of = [&](int body) {
    if (body == 0) return -1;
    if (row[body] < 0) {
      row[body] = static_cast<int>(bodies_.size());
      bodies_.push_back(body);
    }
    return row[body];
  };
  for (std::size_t j = 0; j < spec.joints.size(); ++j) {
    const JointSpec& joint = spec.joints[j];
    if (shares[group_of(joint)] == 0) continue;
    Joint entry;
    entry.index = static_cast<int>(j);
    entry.inboard = row_of(body_of(joint.inboard));
    entry.outboard = row_of(body_of(joint.outboard));
    joints_.push_back(entry);
  }
  lay_out_blocks();
}

void SharedReactions::lay_out_blocks() {
  std::map<std::pair<int, int>, int> blocks;
  const auto block_of = [&](int row, int column) {
    if (row < 0 || column < 0) return -1;
    return blocks.emplace(std::pair{row, column}, static_cast<int>(blocks.size())).first->second;
  };
  for (Joint& joint : joints_)
    joint.blocks = {block_of(joint.inboard, joint.inboard), block_of(joint.outboard, joint.outboard),
                    block_of(joint.inboard, joint.outboard), block_of(joint.outboard, joint.inboard)};
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * blocks.size());
  for (const auto& [at, block] : blocks)
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) entries.emplace_back(6 * at.first + i, 6 * at.second + j, 0.0);
  const auto n = static_cast<Index>(6 * bodies_.size());
  normal_.resize(n, n);
  normal_.setFromTriplets(entries.begin(), entries.end());
  starts_.resize(blocks.size());
  for (const auto& [at, block] : blocks)
    for (int j = 0; j < 6; ++j)
      starts_[static_cast<std::size_t>(block)][static_cast<std::size_t>(j)] =
          static_cast<int>(&normal_.coeffRef(6 * at.first, 6 * at.second + j) - normal_.valuePtr());
  lu_.analyse(normal_);
}

void SharedReactions::update_geometry(const MechanismSpec& spec, const Tree& tree, const TreeMotion& motion) {
  const auto shift_to = [&](int row, const Vector3& p) {
    if (row < 0) return Matrix6::Identity().eval();
    const Vector3& origin =
        motion.pose(tree.bodies[static_cast<std::size_t>(bodies_[static_cast<std::size_t>(row)])]).r;
    return shift_by((p - origin) / tree.length);
  };
  for (Joint& joint : joints_) {
    const Vector3 p = motion.pose(tree.frames[spec.joints[joint.index].inboard.index]).r;
    const JointIndices& where = tree.joints[joint.index];
    const bool plain = where.value_count == 0 && where.closure >= 0;
    joint.P =
        plain ? of_closure(tree, tree.closures[where.closure], motion, p) : across_motions(tree, motion, where, p);
    joint.to_inboard = shift_to(joint.inboard, p);
    joint.to_outboard = shift_to(joint.outboard, p);
  }
}

void SharedReactions::add_block(const Joint& joint, int block, const Matrix6& value) {
  const int index = joint.blocks[static_cast<std::size_t>(block)];
  if (index < 0) return;
  for (int j = 0; j < 6; ++j) {
    double* const column = normal_.valuePtr() + starts_[static_cast<std::size_t>(index)][static_cast<std::size_t>(j)];
    Eigen::Map<Vector6>(column) += value.col(j);
  }
}

/// A A^T, whose singular part along motions of the bodies, on which A x0 has none, is taken care of by a small shift.
bool SharedReactions::factorise() {
  constexpr double shift = 1e-9;
  std::fill_n(normal_.valuePtr(), normal_.nonZeros(), 0.0);
  for (const Joint& joint : joints_) {
    const Matrix6 in = joint.to_inboard * joint.P, out = joint.to_outboard * joint.P;
    add_block(joint, 0, in * joint.to_inboard.transpose());
    add_block(joint, 1, out * joint.to_outboard.transpose());
    add_block(joint, 2, -in * joint.to_outboard.transpose());
    add_block(joint, 3, -out * joint.to_inboard.transpose());
  }
  normal_.diagonal().array() += shift * normal_.norm();
  return lu_.factorise({normal_.valuePtr(), static_cast<std::size_t>(normal_.nonZeros())});
}

VectorXd SharedReactions::sum(const std::vector<Vector6>& W) const {
  VectorXd total = VectorXd::Zero(normal_.rows());
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Joint& joint = joints_[i];
    if (joint.outboard >= 0) total.segment<6>(6 * joint.outboard) += joint.to_outboard * W[i];
    if (joint.inboard >= 0) total.segment<6>(6 * joint.inboard) -= joint.to_inboard * W[i];
  }
  return total;
}

Vector6 SharedReactions::spread(const Joint& joint, const VectorXd& y) const {
  Vector6 W = Vector6::Zero();
  if (joint.outboard >= 0) W += joint.to_outboard.transpose() * y.segment<6>(6 * joint.outboard);
  if (joint.inboard >= 0) W -= joint.to_inboard.transpose() * y.segment<6>(6 * joint.inboard);
  return joint.P * W;
}

void SharedReactions::share(const MechanismSpec& spec, const Tree& tree, const TreeMotion& motion,
                            std::vector<Vector6>& wrenches) {
  constexpr int refinements = 4;  // of the shift
  update_geometry(spec, tree, motion);
  if (!factorise()) return;
  // x of smallest norm with A x = A x0: x = A^T y, (A A^T) y = A x0.
  std::vector<Vector6> given(joints_.size()), least(joints_.size(), Vector6::Zero());
  const auto origin = [&](const Joint& joint) {
    return motion.pose(tree.frames[spec.joints[joint.index].inboard.index]).r;
  };
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    Vector6 W = about(origin(joints_[i]), wrenches[joints_[i].index]);
    W.head<3>() /= tree.length;
    given[i] = joints_[i].P * W;
  }
  const VectorXd b = sum(given);
  for (int k = 0; k < refinements; ++k) {
    VectorXd y = b - sum(least);
    lu_.solve({y.data(), static_cast<std::size_t>(y.size())});
    for (std::size_t i = 0; i < joints_.size(); ++i) least[i] += spread(joints_[i], y);
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    // The part that the joint cannot transmit (round-off of the solution) is not changed.
    Vector6 change = least[i] - given[i];
    change.head<3>() *= tree.length;
    wrenches[joints_[i].index] += about(-origin(joints_[i]), change);
  }
}

}  // namespace hersey::mbd
