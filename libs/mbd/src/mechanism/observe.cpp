// Observation of a mechanism: motion, joint coordinates, reactions, efforts, powers, energies.
#include <algorithm>
#include <cmath>

#include "hersey/mbd/mechanism.h"
#include "mechanism/mechanism_parts.h"

namespace hersey::mbd {
namespace {

/// Returns the wrench of inertia forces and weight of a body about ground's origin, in ground's axes.
/// @param A  its acceleration; the weight is in it as that of ground
Vector6 inertia_forces(const BodySpec& body, const Pose& X_WB, const Vector6& V, const Vector6& A) {
  const Matrix3& R = X_WB.R;
  const Vector3 c = X_WB * body.com, omega = V.head<3>(), alpha = A.head<3>();
  const Vector3 f = body.mass * (A.tail<3>() + alpha.cross(c) + omega.cross(V.tail<3>() + omega.cross(c)));
  const auto times_inertia = [&](const Vector3& u) -> Vector3 { return R * (body.inertia * (R.transpose() * u)); };
  Vector6 W;
  W << times_inertia(alpha) + omega.cross(times_inertia(omega)) + c.cross(f), f;
  return W;
}

/// Values and rates of a joint that is not in the tree, read off its frames' relative motion.
void measure_joint(JointType type, const Vector3& axis, const RelativeMotion& relative, JointObservation& observation) {
  const Matrix3 axes = joint_axes(axis);
  const Matrix3& R = relative.X_AB.R;
  const Vector3& r = relative.X_AB.r;
  const Vector3 omega = relative.V_AB_A.head<3>(), v = relative.V_AB_A.tail<3>() + omega.cross(r);
  int count = 0;
  const auto add = [&](double position, double rate) {
    observation.position[count] = position;
    observation.rate[count++] = rate;
  };
  observation.position.resize(degrees_of_freedom(type));
  observation.rate.resize(degrees_of_freedom(type));
  const std::vector<JointKind::Step>& chain = kind_of(type).chain;
  // Rotation about a, measured by u. With a second axis b the first rotation moves b, and the second moves a of the
  // inboard frame relative to the outboard one.
  const auto add_rotation = [&](const Vector3& a, const Vector3& b, bool is_second) {
    const Vector3 u = is_second ? Vector3(R.transpose() * b) : Vector3(R * b);
    const double angle = std::atan2(a.cross(b).dot(u), b.dot(u));
    add(is_second ? -angle : angle, is_second ? (R * a).dot(omega) : a.dot(omega));
  };
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const Vector3 a = direction(chain[k].along, axes);
    switch (chain[k].motion) {
      case Motion::prismatic:
        add(a.dot(r), a.dot(v));
        break;
      case Motion::revolute: {
        const bool is_second = k > 0 && chain[k - 1].motion == Motion::revolute;
        const bool is_first = k + 1 < chain.size() && chain[k + 1].motion == Motion::revolute;
        const Along other = is_second ? chain[k - 1].along : is_first ? chain[k + 1].along : Along::t1;
        add_rotation(a, direction(other, axes), is_second);
        break;
      }
      case Motion::ball: {
        const Vector3 phi = rotation_log(Eigen::Quaterniond(R)), rate = R.transpose() * omega;
        for (int i = 0; i < 3; ++i) add(phi[i], rate[i]);
        break;
      }
      case Motion::screw:  // never without a chain of its own
      case Motion::none:
        break;
    }
  }
}

}  // namespace

double kinetic_energy_of(const Link& link, const Pose& X_WL, const Vector6& V) {
  const Vector3 omega = X_WL.R.transpose() * V.head<3>();
  const Vector3 v = V.tail<3>() + V.head<3>().cross(X_WL * link.com);
  return 0.5 * (link.mass * v.squaredNorm() + omega.dot(link.inertia * omega));
}

FrameMotion MechanismParts::frame_motion(const Attachment& frame) const {
  FrameMotion observation;
  observation.X_WF = motion.pose(frame);
  const Vector3& r = observation.X_WF.r;
  const Vector6& V = motion.V(frame.link);
  const Vector6 A = motion.A(frame.link) - motion.A(0);  // without the weight
  observation.omega = V.head<3>();
  observation.v = V.tail<3>() + observation.omega.cross(r);
  observation.alpha = A.head<3>();
  // d/dt of the point's velocity v + omega x r, with rdot = v + omega x r.
  observation.a = A.tail<3>() + observation.alpha.cross(r) + observation.omega.cross(observation.v);
  return observation;
}

void MechanismParts::observe_joint_coordinates(const solver::State& state, Observation& observation) const {
  for (std::size_t j = 0; j < spec.joints.size(); ++j) {
    const JointSpec& joint = spec.joints[j];
    const JointIndices& indices = tree.joints[j];
    JointObservation& o = observation.joints[j];
    if (indices.value_count == 0) {
      const Pair pair{tree.frames[joint.inboard.index], tree.frames[joint.outboard.index], {}};
      measure_joint(joint.type, joint.axis, motion.relative(pair), o);
      continue;
    }
    o.position.resize(indices.value_count);
    o.rate.resize(indices.value_count);
    for (int i = 0; i < indices.value_count; ++i) {
      const auto [l, c] = indices.values[i];
      const Link& link = tree.links[l];
      if (link.motion != Motion::ball) {
        o.position[i] = state.q[link.first_q];
        o.rate[i] = state.v[link.first_v];
        continue;
      }
      const Eigen::Vector4d p = state.q.segment<4>(link.first_q);
      const Eigen::Quaterniond R(p[0], p[1], p[2], p[3]);
      const Vector3 omega = state.v.segment<3>(link.first_v);
      o.position[i] = rotation_log(link.reversed ? R.conjugate() : R)[c];
      o.rate[i] = link.reversed ? -(R * omega)[c] : omega[c];
    }
  }
  for (const OwnMotion& own : tree.own_motions) {
    if (own.weights.empty()) continue;
    double& rotation = observation.joints[own.joint].position[2];
    rotation = own.offset;
    for (const auto& [link, weight] : own.weights) rotation += weight * state.q[tree.links[link].first_q];
  }
}

void MechanismParts::observe_efforts(const solver::State& state, Observation& observation) {
  for (std::size_t i = 0; i < drives.size(); ++i) {
    observation.drive_efforts.push_back(-state.lambda[row_of_drive(i)]);
    observation.drive_powers.push_back(observation.drive_efforts.back() * state.v[drives[i].column]);
  }
  for (std::size_t i = 0; i < couplings.size(); ++i)
    observation.coupling_efforts.push_back(-state.lambda[row_of_coupling(i)]);
  for (Load& load : loads) observation.load_powers.push_back(load.wrench(motion, state).dot(motion.V(load.link())));
  for (std::size_t i = 0; i < spec.springs.size(); ++i) {
    const CoordinateSpringSpec& s = spec.springs[i];
    const int k = spring_columns[i];
    const double stretch = state.q[q_of(k)] - s.free_position;
    observation.spring_powers.push_back(-(s.stiffness * stretch + s.damping * state.v[k]) * state.v[k]);
    observation.spring_energy += 0.5 * s.stiffness * stretch * stretch;
    observation.damper_power += s.damping * state.v[k] * state.v[k];
  }
  for (std::size_t i = 0; i < spec.coordinate_forces.size(); ++i) {
    const int k = coordinate_force_columns[i];
    const CoordinateForce& force = *spec.coordinate_forces[i].force;
    observation.coordinate_force_efforts.push_back(force.evaluate(state.t, state.q[q_of(k)], state.v[k]).value);
    observation.coordinate_force_powers.push_back(observation.coordinate_force_efforts.back() * state.v[k]);
    observation.spring_energy += force.stored_energy(state.q[q_of(k)]);
  }
  const bool evaluates = accepted.empty();
  for (std::size_t i = 0; i < spec.forces.size(); ++i) {
    const RelativeMotion relative = relative_motion(i, state.t);
    if (evaluates) spec.forces[i].force->evaluate(relative, false, responses[i]);
    const ForceResponse& response = evaluates ? responses[i] : accepted[i];
    observation.force_wrenches.push_back(response.W_B_A);
    observation.force_powers.push_back(response.W_B_A.dot(relative.V_AB_A) + response.Q.dot(relative.s_rate));
    observation.spring_energy += spec.forces[i].force->stored_energy(relative);
    observation.kinetic_energy += spec.forces[i].force->kinetic_energy(relative);
    observation.damper_power += spec.forces[i].force->lost_power(relative);
  }
}

void MechanismParts::observe_reactions(const solver::State& state, Observation& observation) {
  // Balance of each body: what is left of inertia and weight after the known forces comes through its joints
  // (mechanisms.21).
  std::vector<Vector6> need(spec.bodies.size(), Vector6::Zero());
  const auto body_of = [&](FrameId frame) { return spec.frames[frame.index].body.index; };
  for (int b : tree.body_order) {
    const Attachment& at = tree.bodies[b];
    need[b] = inertia_forces(spec.bodies[b], observation.bodies[b].X_WF, motion.V(at.link), motion.A(at.link));
  }
  for (std::size_t i = 0; i < loads.size(); ++i) need[body_of(spec.loads[i].frame)] -= loads[i].wrench(motion, state);
  for (std::size_t i = 0; i < spec.forces.size(); ++i) {
    const Vector6 W = moved_force(motion.pose(tree.forces[i].a), observation.force_wrenches[i]);
    need[body_of(spec.forces[i].b)] -= W;
    need[body_of(spec.forces[i].a)] += W;
  }
  for (std::size_t i = 0; i < elastics.size(); ++i)
    for (std::size_t f = 0; f < spec.elastics[i].frames.size(); ++f)
      need[body_of(spec.elastics[i].frames[f])] +=
          moved_force(motion.pose(elastics[i].frame(f)), observation.elastics[i].wrenches[f]);
  std::vector<Vector6> through(spec.joints.size(), Vector6::Zero());  // on the tree's outer side
  for (const Closure& closure : tree.closures) {
    const Pose X_WA = motion.pose(closure.pair.a);
    const Pose X_AB = X_WA.inverse() * motion.pose(closure.pair.b);
    const Vector6 W = moved_force(X_WA, closure_response(closure, X_AB, state.lambda, false).W_B_A);
    through[closure.joint] = W;
    need[body_of(spec.joints[closure.joint].outboard)] -= W;
    need[body_of(spec.joints[closure.joint].inboard)] += W;
  }
  for (std::size_t i = tree.body_order.size(); i-- > 0;) {
    const int b = tree.body_order[i];
    need[tree.body_parent[b]] += need[b];
  }
  for (std::size_t j = 0; j < spec.joints.size(); ++j)
    if (tree.joints[j].outboard_body >= 0) through[j] = need[tree.joints[j].outboard_body];

  // Drives and springs act inside the joint: a torque about, or a force along, the axis of their coordinate. Where a
  // path leads through the joint the other way they push on its other side.
  const auto take_out = [&](int column, int joint, double effort) {
    const Vector6& J = motion.J(column);
    const Link& link = tree.links[tree.columns[column].link];
    if (link.reversed != tree.joints[joint].reversed) effort = -effort;
    Vector6 W;
    if (link.motion != Motion::prismatic) {
      W << effort * J.head<3>(), Vector3::Zero();
    } else {
      const Vector3 f = effort * J.tail<3>();
      W << motion.X(tree.columns[column].link).r.cross(f), f;
    }
    through[joint] -= W;
  };
  for (std::size_t i = 0; i < drives.size(); ++i)
    take_out(drives[i].column, spec.drives[i].coordinate.joint.index, observation.drive_efforts[i]);
  for (std::size_t i = 0; i < spec.springs.size(); ++i) {
    const CoordinateSpringSpec& s = spec.springs[i];
    const int k = spring_columns[i];
    take_out(k, s.coordinate.joint.index,
             -(s.stiffness * (state.q[q_of(k)] - s.free_position) + s.damping * state.v[k]));
  }
  for (std::size_t i = 0; i < spec.coordinate_forces.size(); ++i)
    take_out(coordinate_force_columns[i], spec.coordinate_forces[i].coordinate.joint.index,
             observation.coordinate_force_efforts[i]);
  for (std::size_t i = 0; i < couplings.size(); ++i)
    couplings[i].visit_rates(state, [&](int column, double rate) {
      take_out(column, tree.links[tree.columns[column].link].joint, observation.coupling_efforts[i] * rate);
    });
  for (std::size_t j = 0; j < spec.joints.size(); ++j)
    if (tree.joints[j].reversed) through[j] = -through[j];  // of the inboard on the outboard body
  if (shared_reactions) shared_reactions->share(spec, tree, motion, through);
  for (std::size_t j = 0; j < spec.joints.size(); ++j) {
    const Pose X_WI = motion.pose(tree.frames[spec.joints[j].inboard.index]);
    const Vector3 f = through[j].tail<3>();
    observation.joints[j].torque = X_WI.R.transpose() * (through[j].head<3>() - X_WI.r.cross(f));
    observation.joints[j].force = X_WI.R.transpose() * f;
  }
}

void MechanismParts::observe_drift(const solver::State& state, Observation& observation) const {
  double& drift = observation.constraint_drift;
  for (const Closure& closure : tree.closures) drift = std::max(drift, opening_of(closure));
  for (const Coupling& coupling : couplings)
    drift = std::max(drift, std::abs(coupling.value(state)) / coupling_scale(coupling, state));
  for (const BoundDrive& drive : drives) {
    const double asked = drive.motion.position(state.t);
    const bool linear = tree.links[tree.columns[drive.column].link].motion == Motion::prismatic;
    drift = std::max(drift, std::abs(state.q[drive.q] - asked) / std::max(linear ? tree.length : 1.0, std::abs(asked)));
  }
}

void MechanismParts::observe_energies(Observation& observation) const {
  for (std::size_t l = 1; l < tree.links.size(); ++l) {
    const Link& link = tree.links[l];
    const Pose& X_WL = motion.X(static_cast<int>(l));
    observation.kinetic_energy += kinetic_energy_of(link, X_WL, motion.V(static_cast<int>(l)));
    observation.potential_energy -= link.mass * spec.gravity.dot(X_WL * link.com);
  }
}

void MechanismParts::observe_elastic_bodies(Observation& observation) {
  for (ElasticAssembly& elastic : elastics) {
    ElasticObservation o;
    o.motion = elastic.motion();
    elastic.body().evaluate(o.motion, false, elastic.response());
    for (std::size_t f = 0; f < o.motion.frames.size(); ++f) o.wrenches.push_back(elastic.wrench(f));
    o.energy = elastic.body().energy(o.motion, spec.gravity);
    observation.kinetic_energy += o.energy.kinetic;
    observation.potential_energy += o.energy.potential;
    observation.elastics.push_back(std::move(o));
  }
}

Observation Mechanism::observe(const solver::State& state) {
  MechanismParts& m = *parts_;
  m.motion.update(state);
  Observation observation;
  observation.t = state.t;
  observation.bodies.reserve(m.tree.bodies.size());
  for (const Attachment& body : m.tree.bodies) observation.bodies.push_back(m.frame_motion(body));
  observation.joints.resize(m.spec.joints.size());
  m.observe_joint_coordinates(state, observation);
  m.read_elastic_bodies(state);
  m.observe_efforts(state, observation);
  m.hand_out_shape_forces(m.accepted.empty() ? m.responses : m.accepted);
  m.observe_elastic_bodies(observation);
  m.observe_reactions(state, observation);
  m.observe_energies(observation);
  m.observe_drift(state, observation);
  return observation;
}

}  // namespace hersey::mbd
