#include "tree/tree_motion.h"

#include <cstring>

namespace hersey::mbd {
namespace {

/// Bit for bit: 0 and -0 give different motions.
bool are_same(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

}  // namespace

TreeMotion::TreeMotion(const Tree& tree, const Vector3& gravity)
    : tree_(tree),
      X_(tree.links.size()),
      V_(tree.links.size(), Vector6::Zero()),
      A_(tree.links.size(), Vector6::Zero()),
      J_(tree.columns.size(), Vector6::Zero()) {
  A_[0] << Vector3::Zero(), -gravity;
}

void TreeMotion::update_pose(int l, const solver::State& state) {
  const Link& link = tree_.links[l];
  const Pose X_WF = X_[link.parent] * link.X_PF;
  Pose& X_WM = X_[l];
  const double* q = state.q.data() + link.first_q;
  Vector6* J = J_.data() + link.first_v;
  switch (link.motion) {
    case Motion::revolute: {
      X_WM.R = X_WF.R * Eigen::AngleAxisd(q[0], link.axis).toRotationMatrix();
      X_WM.r = X_WF.r;
      const Vector3 axis_W = X_WF.R * link.axis;
      J[0] << axis_W, X_WF.r.cross(axis_W);
      break;
    }
    case Motion::prismatic: {
      const Vector3 axis_W = X_WF.R * link.axis;
      X_WM.R = X_WF.R;
      X_WM.r = X_WF.r + q[0] * axis_W;
      J[0] << Vector3::Zero(), axis_W;
      break;
    }
    case Motion::screw: {
      const Vector3 axis_W = X_WF.R * link.axis;
      X_WM.R = X_WF.R * Eigen::AngleAxisd(q[0], link.axis).toRotationMatrix();
      X_WM.r = X_WF.r + link.travel * q[0] * axis_W;
      J[0] << axis_W, X_WF.r.cross(axis_W) + link.travel * axis_W;
      break;
    }
    case Motion::ball: {
      X_WM.R = X_WF.R * Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
      X_WM.r = X_WF.r;
      for (int c = 0; c < 3; ++c) J[c] << X_WM.R.col(c), X_WM.r.cross(X_WM.R.col(c));
      break;
    }
    case Motion::none:
      X_WM = X_WF;
      break;
  }
}

bool TreeMotion::is_at(const solver::State& state) const {
  return is_whole_ && are_same(q_, state.q) && are_same(v_, state.v) && are_same(vdot_, state.vdot);
}

void TreeMotion::update(const solver::State& state) {
  if (is_at(state)) return;
  update_positions(state);
  update_velocities(state);
  update_accelerations(state);
  q_ = state.q, v_ = state.v, vdot_ = state.vdot;
  is_whole_ = true;
}

void TreeMotion::update(const solver::State& state, const std::vector<int>& links) {
  is_whole_ = false;
  for (const int l : links) {
    update_pose(l, state);
    move(l, state);
  }
}

void TreeMotion::update_positions(const solver::State& state) {
  is_whole_ = false;
  for (int l = 1; l < static_cast<int>(tree_.links.size()); ++l) update_pose(l, state);
}

void TreeMotion::move(int l, const solver::State& state) {
  const Link& link = tree_.links[l];
  V_[l] = V_[link.parent];
  for (int k = link.first_v; k < link.first_v + link.columns; ++k) V_[l] += J_[k] * state.v[k];
}

void TreeMotion::update_velocities(const solver::State& state) {
  is_whole_ = false;
  for (int l = 1; l < static_cast<int>(tree_.links.size()); ++l) move(l, state);
}

void TreeMotion::update_accelerations(const solver::State& state, bool zero_vdot) {
  is_whole_ = false;
  for (std::size_t l = 1; l < tree_.links.size(); ++l) {
    const Link& link = tree_.links[l];
    // Each column rotates with its link: Jdot = V x J, and V x (V - V_parent) = -V x V_parent.
    A_[l] = A_[link.parent] + cross_motion(V_[l], V_[l] - V_[link.parent]);
    if (zero_vdot) continue;
    for (int k = link.first_v; k < link.first_v + link.columns; ++k) A_[l] += J_[k] * state.vdot[k];
  }
}

RelativeMotion TreeMotion::relative(const Pair& pair) const {
  const Pose X_WA = pose(pair.a);
  RelativeMotion motion;
  motion.X_AB = X_WA.inverse() * pose(pair.b);
  const Matrix6 to_A = motion_transform(X_WA.inverse());
  const Vector6 &V_a = V_[pair.a.link], V_ab = V_[pair.b.link] - V_a;
  motion.V_AB_A = to_A * V_ab;
  motion.A_AB_A = to_A * (A_[pair.b.link] - A_[pair.a.link] - cross_motion(V_a, V_ab));  // (mechanisms.29)
  return motion;
}

}  // namespace hersey::mbd
