#pragma once

#include <vector>

#include "hersey/core/spatial.h"
#include "hersey/mbd/two_body_force.h"
#include "hersey/solver/equations.h"
#include "tree/tree.h"

namespace hersey::mbd {

/// Poses, velocities and accelerations of all links of a tree at one state (theory manual eq. (mechanisms.2) to
/// (mechanisms.5)).
///
/// All spatial vectors are taken at ground's origin and in ground's axes. Accelerations are the derivatives of these
/// velocities; ground's is minus gravity, so that inertia forces contain the weight.
class TreeMotion {
 public:
  TreeMotion(const Tree& tree, const Vector3& gravity);

  /// @cost O(number of links); no allocation.
  void update_positions(const solver::State& state);
  void update_velocities(const solver::State& state);
  /// @param zero_vdot  take vdot = 0: accelerations due to velocities (and gravity) alone.
  void update_accelerations(const solver::State& state, bool zero_vdot = false);
  /// All three; nothing where it is at that state already, as an accepted step leaves it for those who look at it.
  void update(const solver::State& state);

  /// Poses and velocities of these links alone, given from ground outwards.
  void update(const solver::State& state, const std::vector<int>& links);

  [[nodiscard]] const Pose& X(int link) const { return X_[link]; }
  [[nodiscard]] const Vector6& V(int link) const { return V_[link]; }
  [[nodiscard]] const Vector6& A(int link) const { return A_[link]; }
  [[nodiscard]] const Vector6& J(int column) const { return J_[column]; }

  [[nodiscard]] Pose pose(const Attachment& f) const { return X_[f.link] * f.X_LF; }

  /// Returns the relative motion of two frames; the caller sets `t` and `dt`.
  [[nodiscard]] RelativeMotion relative(const Pair& pair) const;

 private:
  void update_pose(int l, const solver::State& state);
  void move(int l, const solver::State& state);
  [[nodiscard]] bool is_at(const solver::State& state) const;

  const Tree& tree_;
  std::vector<Pose> X_;
  std::vector<Vector6> V_, A_, J_;
  Eigen::VectorXd q_, v_, vdot_;  // of the state that all links are at, where they are at one
  bool is_whole_ = false;
};

}  // namespace hersey::mbd
