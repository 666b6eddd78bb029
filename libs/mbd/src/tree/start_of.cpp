#include "tree/start_of.h"

#include <algorithm>

#include "tree/tree_motion.h"

namespace hersey::mbd {
namespace {

/// Poses and velocities of a link and of all that carry it.
void follow(TreeMotion& at, const Tree& tree, const solver::State& state, int link) {
  std::vector<int> path;
  for (int l = link; l > 0; l = tree.links[l].parent) path.push_back(l);
  std::reverse(path.begin(), path.end());
  at.update(state, path);
}

/// Gives a body with a free joint of its own the pose and the velocity, about ground's origin, that its frame has.
void set_free_body(const Link& ball, const Pose& X_WB, const Vector6& V, solver::State& state) {
  const int first_q = ball.first_q - 3, first_v = ball.first_v - 3;
  const Eigen::Quaterniond R(X_WB.R);
  state.q.segment<7>(first_q) << X_WB.r, R.w(), R.x(), R.y(), R.z();
  const Vector3 omega = V.head<3>();
  state.v.segment<6>(first_v) << V.tail<3>() + omega.cross(X_WB.r), X_WB.R.transpose() * omega;
}

/// Bodies beyond a cut start where the coordinates of the joints put them: the cuts are closed from the outset.
void set_cut_bodies(const Tree& tree, solver::State& state) {
  TreeMotion at(tree, Vector3::Zero());
  for (const Cut& cut : tree.cuts) {
    const Pair& pair = tree.closures[tree.joints[cut.joint].closure].pair;
    const Attachment &near = cut.reversed ? pair.b : pair.a, &far = cut.reversed ? pair.a : pair.b;
    const Link& ball = tree.links[tree.bodies[cut.body].link];
    follow(at, tree, state, near.link);
    follow(at, tree, state, far.link);
    const Pose X_WB = at.pose(near) * at.pose(far).inverse();
    set_free_body(ball, X_WB, Vector6::Zero(), state);
    follow(at, tree, state, far.link);
    set_free_body(ball, X_WB, at.V(near.link) - at.V(far.link), state);
  }
}

/// Nodes of loose beams start undeformed relative to the first, and move as if they were fixed to it.
void set_loosened_nodes(const MechanismSpec& spec, const Tree& tree, solver::State& state) {
  TreeMotion at(tree, Vector3::Zero());
  for (const Loosened& node : tree.loosened) {
    const JointSpec& joint = spec.joints[node.joint];
    const Attachment& near = tree.frames[(node.reversed ? joint.outboard : joint.inboard).index];
    const Attachment& far = tree.frames[(node.reversed ? joint.inboard : joint.outboard).index];
    follow(at, tree, state, near.link);
    set_free_body(tree.links[far.link], at.pose(near) * far.X_LF.inverse(), at.V(near.link), state);
  }
}

/// Each coordinate as its joint is given it, zero where it is not.
void set_joints(const MechanismSpec& spec, const Tree& tree, solver::State& state) {
  for (const Link& link : tree.links) {
    const JointSpec* joint = link.joint >= 0 ? &spec.joints[link.joint] : nullptr;
    const bool has_initial = joint && !joint->initial.empty(), moving = joint && !joint->initial_rate.empty();
    if (link.motion == Motion::ball) {
      Eigen::Quaterniond R_IO = Eigen::Quaterniond::Identity();
      if (has_initial) R_IO = rotation_exp(Vector3::Map(joint->initial.data() + link.value));
      const Eigen::Quaterniond R = link.reversed ? R_IO.conjugate() : R_IO;
      state.q.segment<4>(link.first_q) << R.w(), R.x(), R.y(), R.z();
      if (!moving) continue;
      // Reversed, the ball's velocity is that of I relative to O, in I's axes.
      const Vector3 omega = Vector3::Map(joint->initial_rate.data() + link.value);
      state.v.segment<3>(link.first_v) = link.reversed ? Vector3(-(R_IO * omega)) : omega;
    } else if (link.columns == 1) {
      if (has_initial) state.q[link.first_q] = joint->initial[link.value];
      if (moving) state.v[link.first_v] = joint->initial_rate[link.value];
    }
  }
}

}  // namespace

solver::State start_of(const MechanismSpec& spec, const Tree& tree) {
  solver::State state;
  state.q.setZero(tree.nq);
  state.v.setZero(tree.nv);
  state.vdot.setZero(tree.nv);
  set_joints(spec, tree, state);
  for (const OwnMotion& own : tree.own_motions)
    state.v.segment(tree.links[own.first_link].first_v, own.velocity.size()) = own.velocity;
  if (!tree.cuts.empty()) set_cut_bodies(tree, state);
  if (!tree.loosened.empty()) set_loosened_nodes(spec, tree, state);
  return state;
}

}  // namespace hersey::mbd
