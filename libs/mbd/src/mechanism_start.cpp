// Where a mechanism starts, and which of its constraints are redundant there and wherever it can go.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mechanism_impl.h"
#include "redundancy.h"

namespace hersey::mbd {

solver::State Mechanism::Implementation::initial_state() const {
  solver::State state;
  state.q.setZero(nq);
  state.v.setZero(nv);
  state.vdot.setZero(nv);
  state.lambda.setZero(nlambda());
  for (const Link& link : tree.links) {
    const JointSpec* joint = link.joint >= 0 ? &spec.joints[link.joint] : nullptr;
    const bool placed = joint && !joint->initial.empty(), moving = joint && !joint->initial_rate.empty();
    if (link.motion == Motion::ball) {
      Eigen::Quaterniond R_IO = Eigen::Quaterniond::Identity();
      if (placed) R_IO = rotation_exp(Vector3::Map(joint->initial.data() + link.value));
      const Eigen::Quaterniond R = link.reversed ? R_IO.conjugate() : R_IO;
      state.q.segment<4>(link.first_q) << R.w(), R.x(), R.y(), R.z();
      if (!moving) continue;
      // Reversed, the ball's velocity is that of I relative to O, in I's axes.
      const Vector3 omega = Vector3::Map(joint->initial_rate.data() + link.value);
      state.v.segment<3>(link.first_v) = link.reversed ? Vector3(-(R_IO * omega)) : omega;
    } else if (link.columns == 1) {
      if (placed) state.q[link.first_q] = joint->initial[link.value];
      if (moving) state.v[link.first_v] = joint->initial_rate[link.value];
    }
  }
  return state;
}

std::vector<Mechanism::Index> Mechanism::Implementation::given_coordinates() const {
  std::vector<Index> given;
  for (const Link& link : tree.links)
    if (link.joint >= 0 && !spec.joints[link.joint].initial.empty() && !is_deformation(link.joint))
      for (int c = 0; c < link.columns; ++c) given.push_back(link.first_v + c);
  return given;
}

bool Mechanism::Implementation::is_deformation(int joint) const {
  return std::find(spec.deforming.begin(), spec.deforming.end(), JointId{joint}) != spec.deforming.end();
}

std::vector<Mechanism::Index> Mechanism::Implementation::elastic_coordinates() const {
  std::vector<Index> stiff;
  for (const Link& link : tree.links)
    if (link.joint >= 0 && is_deformation(link.joint))
      for (int c = 0; c < link.columns; ++c) stiff.push_back(link.first_v + c);
  const std::vector<Index> internal = internal_coordinates();
  stiff.insert(stiff.end(), internal.begin(), internal.end());
  return stiff;
}

std::vector<Mechanism::Index> Mechanism::Implementation::internal_coordinates() const {
  std::vector<Index> internal(static_cast<std::size_t>(nv - tree.nv));
  std::iota(internal.begin(), internal.end(), tree.nv);
  return internal;
}

void Mechanism::Implementation::release_redundant_rows() {
  const solver::State start = initial_state();
  const std::vector<int> rows = redundant_rows(tree, motion, start, given_coordinates());
  if (rows.empty()) return;
  drop_rows(tree, rows);
  for (const Closure& closure : tree.closures) {
    if (closure.dropped.empty()) continue;
    Redundancy redundancy{{closure.joint}, {}, 0, 0};
    for (const ConstraintRow& row : closure.dropped)
      ++(row.kind == ConstraintRow::Kind::position ? redundancy.positions : redundancy.orientations);
    for (const SignedColumn& column : closure.pair.columns) {
      const JointId id{tree.links[tree.columns[column.column].link].joint};
      if (id.index < 0 || id.index == closure.joint) continue;
      if (std::find(redundancy.loop.begin(), redundancy.loop.end(), id) == redundancy.loop.end())
        redundancy.loop.push_back(id);
    }
    redundancy.loop.push_back({closure.joint});
    redundancies.push_back(std::move(redundancy));
  }
}

double Mechanism::Implementation::opening_of(const Closure& closure) const {
  const Pose X_AB = motion.pose(closure.pair.a).inverse() * motion.pose(closure.pair.b);
  double worst = 0;
  for (const std::vector<ConstraintRow>* rows : {&closure.rows, &closure.dropped})
    for (const ConstraintRow& row : *rows) {
      const double scale = row.kind == ConstraintRow::Kind::position ? tree.length : 1.0;
      worst = std::max(worst, std::abs(row.value(X_AB)) / scale);
    }
  return worst;
}

/// A redundant row holds by itself; if it does not, the loop is not the one it was taken for.
void Mechanism::Implementation::watch_dropped_rows() {
  constexpr double tolerance = 1e-5;
  for (const Redundancy& redundancy : redundancies) {
    const Closure& closure = tree.closures[tree.joints[redundancy.joint.index].closure];
    const double opening = opening_of(closure);
    if (opening <= tolerance) continue;
    came_apart = fmt::format(
        "joint {}: constraints that followed from others at the start have opened by {:.2g} of the mechanism's size; "
        "free a motion in its loop instead, for example with a spherical or cylindrical joint",
        spec.joints[redundancy.joint.index].name, opening);
  }
}

const std::vector<Redundancy>& Mechanism::redundancies() const { return impl_->redundancies; }

}  // namespace hersey::mbd
