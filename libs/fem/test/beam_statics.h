#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "hersey/fem/beam.h"
#include "hersey/solver/sparse_lu.h"
#include "hersey/solver/symmetric_factor.h"

/// Beams at rest: exact solutions of bending, twist and buckling stand against the elements' own forces and stiffness.
namespace hersey::fem::test {

/// Straight elements between nodes, all of one stiffness.
struct BeamBody {
  struct Piece {
    int a = 0, b = 0;  ///< nodes
    BeamElement element;
  };
  std::vector<Vector3> nodes;
  std::vector<Piece> pieces;
};

/// From each node to the next; the section's z-axis is the part of `up` across the element.
inline BeamBody beam_body(const std::vector<Vector3>& nodes, const BeamStiffness& stiffness, const Vector3& up) {
  BeamBody body{.nodes = nodes, .pieces = {}};
  for (int i = 1; i < static_cast<int>(nodes.size()); ++i) {
    const Vector3 along = nodes[i] - nodes[i - 1];
    BeamElement element{.length = along.norm(), .stiffness = stiffness};
    element.frame.col(0) = along.normalized();
    element.frame.col(1) = up.cross(along).normalized();
    element.frame.col(2) = element.frame.col(0).cross(element.frame.col(1));
    body.pieces.push_back({i - 1, i, element});
  }
  return body;
}

/// Positions of the nodes, and rotations of the material around them from the undeformed state.
using BeamState = std::vector<Pose>;

/// Positions of the undeformed nodes without rotations.
inline BeamState undeformed(const BeamBody& body) {
  BeamState state;
  for (const Vector3& node : body.nodes) state.push_back({Matrix3::Identity(), node});
  return state;
}

/// Moves poses by small twists (6 of each) in their own axes.
inline void move(BeamState& state, const Eigen::VectorXd& twists) {
  for (std::size_t a = 0; a < state.size(); ++a) {
    const auto first = 6 * static_cast<Eigen::Index>(a);
    const Matrix3 R = state[a].R;
    state[a].r += R * twists.segment<3>(first + 3);
    state[a].R = (Eigen::Quaterniond(R) * rotation_exp(twists.segment<3>(first))).normalized().toRotationMatrix();
  }
}

/// Elastic forces of an element between two poses at rest.
inline BeamMotionResponse beam_response(const BeamElement& element, const Pose& X_a, const Pose& X_b) {
  return fem::beam_response(element, BeamMotion{X_a, X_b}, 0);
}

/// Force and moment on a node that keep their directions in space.
struct BeamLoad {
  int node = 0;
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
};

/// Inner minus outer forces and their derivative, on the unknowns (6 nodes) that are not fixed.
class BeamBalance {
 public:
  BeamBalance(const BeamBody& body, const std::vector<int>& fixed, const std::vector<BeamLoad>& loads)
      : body_(body), loads_(loads), free_index_(6 * body.nodes.size(), 0) {
    for (const int dof : fixed) free_index_[dof] = -1;
    for (int& p : free_index_)
      if (p == 0) p = size_++;
  }

  /// At `state` under a share of the loads.
  void evaluate(const BeamState& state, double share) {
    residual = Eigen::VectorXd::Zero(size_);
    entries_.clear();
    for (const BeamBody::Piece& piece : body_.pieces) add(piece, state);
    for (const BeamLoad& load : loads_) add(load, state[load.node].R, share);
    tangent.resize(size_, size_);
    tangent.setFromTriplets(entries_.begin(), entries_.end());
  }

  /// Zeros where the beam is fixed.
  [[nodiscard]] Eigen::VectorXd spread(const Eigen::VectorXd& x) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(free_index_.size()));
    for (std::size_t i = 0; i < free_index_.size(); ++i)
      if (free_index_[i] >= 0) all[static_cast<Eigen::Index>(i)] = x[free_index_[i]];
    return all;
  }

  Eigen::VectorXd residual;
  Eigen::SparseMatrix<double> tangent;

 private:
  void add(const BeamBody::Piece& piece, const BeamState& state) {
    const BeamMotionResponse response = test::beam_response(piece.element, state[piece.a], state[piece.b]);
    const auto at = [&](int i) { return free_index_[6 * (i < 6 ? piece.a : piece.b) + i % 6]; };
    for (int i = 0; i < 12; ++i) {
      if (at(i) < 0) continue;
      residual[at(i)] += response.force[i];
      for (int j = 0; j < 12; ++j)
        if (at(j) >= 0) entries_.emplace_back(at(i), at(j), response.K(i, j));
    }
  }

  // A vector of constant direction in space is R^T m in the node's axes, and rotates with theta as -theta x R^T m.
  void add(const BeamLoad& load, const Matrix3& R, double share) {
    for (const int first : {0, 3}) {
      const Vector3 own = share * R.transpose() * (first == 0 ? load.moment : load.force);
      const Matrix3 rotated = skew(own);
      for (int i = 0; i < 3; ++i) {
        const int row = free_index_[6 * load.node + first + i];
        if (row < 0) continue;
        residual[row] -= own[i];
        for (int j = 0; j < 3; ++j)
          if (const int column = free_index_[6 * load.node + j]; column >= 0)
            entries_.emplace_back(row, column, -rotated(i, j));
      }
    }
  }

  const BeamBody& body_;
  const std::vector<BeamLoad>& loads_;
  int size_ = 0;
  std::vector<int> free_index_;
  std::vector<Eigen::Triplet<double>> entries_;
};

/// Newton's method for one share of the load; false: no equilibrium was found, `state` is of no use.
inline bool equilibrate(BeamBalance& balance, double size, double share, BeamState& state) {
  constexpr double tolerance = 1e-11;       // of the last correction, over the body's size, and in rad
  constexpr double largest_rotation = 1.0;  // rad, of a node in one iteration: beyond, Newton's method is lost
  for (int i = 0; i < 20; ++i) {
    balance.evaluate(state, share);
    solver::SparseLu lu;
    lu.analyse(balance.tangent);
    if (!lu.factorise({balance.tangent.valuePtr(), static_cast<std::size_t>(balance.tangent.nonZeros())})) return false;
    Eigen::VectorXd x = -balance.residual;
    lu.solve({x.data(), static_cast<std::size_t>(x.size())});
    const Eigen::VectorXd correction = balance.spread(x);
    double rotation = 0, moved = 0;
    for (Eigen::Index node = 0; 6 * node < correction.size(); ++node) {
      rotation = std::max(rotation, correction.segment<3>(6 * node).norm());
      moved = std::max(moved, correction.segment<3>(6 * node + 3).norm());
    }
    if (!(rotation < largest_rotation) || !(moved < size)) return false;
    move(state, correction);
    if (std::max(rotation, moved / size) < tolerance) return true;
  }
  return false;
}

/// Equilibrium of a beam whose `fixed` unknowns (indices among 6 nodes) do not move, from `state` on; the load grows in
/// `steps` equal parts, halved where Newton's method fails. The share of the load that was reached: 1 if all goes well.
[[nodiscard]] inline double solve_beam(const BeamBody& body, const std::vector<int>& fixed,
                                       const std::vector<BeamLoad>& loads, BeamState& state, int steps = 10) {
  BeamBalance balance(body, fixed, loads);
  double size = 0, reached = 0, part = 1.0 / steps;
  for (const Vector3& x : body.nodes) size = std::max(size, (x - body.nodes[0]).norm());
  while (reached < 1) {
    // The last part ends on the whole load, not on a sum of parts.
    const double next = reached + part > 1 - 1e-9 ? 1 : reached + part;
    BeamState trial = state;
    if (equilibrate(balance, size, next, trial)) {
      state = trial;
      reached = next;
    } else if ((part /= 2) < 1e-4) {  // so small a part of the load is none
      return reached;
    }
  }
  return reached;
}

/// How many independent motions would release energy at an equilibrium: 0 if it is stable. -1: it is at a point of
/// buckling itself.
[[nodiscard]] inline int unstable_motions(const BeamBody& body, const std::vector<int>& fixed,
                                          const std::vector<BeamLoad>& loads, const BeamState& state) {
  BeamBalance balance(body, fixed, loads);
  balance.evaluate(state, 1);
  // In equilibrium the derivative in turning axes differs from the symmetric second derivative of the energy by
  // round-off.
  const Eigen::SparseMatrix<double> transposed = balance.tangent.transpose();
  const Eigen::SparseMatrix<double> symmetric = (balance.tangent + transposed) / 2;
  solver::SymmetricFactor factor;
  factor.analyse(symmetric);
  const solver::FactorSummary summary = factor.factorise(symmetric);
  return summary.solved() ? summary.negative_pivots : -1;
}

}  // namespace hersey::fem::test
