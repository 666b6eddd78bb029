// Energies and forces for the monitor of the energy of steps, and the work between two states: theory manual,
// integrator.29 to integrator.31.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "hersey/mbd/energy_view.h"
#include "hersey/mbd/mechanism.h"
#include "mechanism/mechanism_parts.h"

namespace hersey::mbd {
namespace {

/// The twist that takes B from one pose to another, at A's origin in A's axes: its rotation, and the shift of the point
/// of B that lies half-way, so that a constant wrench does the work of its force and its torque.
Vector6 twist_between(const Pose& from, const Pose& to) {
  const Vector3 rotation = rotation_log(Eigen::Quaterniond(to.R * from.R.transpose()));
  Vector6 xi;
  xi << rotation, (to.r - from.r) - rotation.cross(0.5 * (from.r + to.r));
  return xi;
}

/// Returns the work of the mean of two efforts over a displacement; its uncertainty follows from their difference.
StepWork of_mean(double first, double last, double way) {
  return {0.5 * (first + last) * way, 0.5 * std::abs((last - first) * way)};
}

/// Simpson's rule over two and four parts of a step.
struct Simpson {
  double two = 0, four = 0;
  void add(int point, double value) {
    constexpr double of_two[] = {1.0 / 6, 0, 4.0 / 6, 0, 1.0 / 6};
    constexpr double of_four[] = {1.0 / 12, 4.0 / 12, 2.0 / 12, 4.0 / 12, 1.0 / 12};
    two += of_two[point] * value;
    four += of_four[point] * value;
  }
  /// A force that jumps within the step leaves an error of at most twice what both rules differ by (integrator.31).
  [[nodiscard]] StepWork work() const { return {four, 2 * std::abs(four - two)}; }
};

void io_each(Archive& archive, std::string_view name, std::vector<Eigen::VectorXd>& list) {
  archive.each(name, list, [](Archive& a, Eigen::VectorXd& values) { a.io("values", values); });
}

}  // namespace

void EnergyView::persist(Archive& archive) {
  archive.io("t", t), archive.io("q", q), archive.io("v", v);
  archive.io("kinetic", kinetic), archive.io("potential", potential), archive.io("springs", springs);
  archive.io("functions", functions), archive.io("strain", strain), archive.io("elastic_kinetic", elastic_kinetic);
  archive.io("pressures", pressures), archive.io("drive_efforts", drive_efforts);
  archive.io("coordinate_efforts", coordinate_efforts);
  io_each(archive, "loads", load_generalised);
  archive.each("forces", forces, [](Archive& a, ForceView& force) {
    a.io("stored", force.stored), a.io("lost", force.lost), a.io("wrench", force.W);
    a.io("rotation", force.X_AB.R), a.io("place", force.X_AB.r), a.io("shapes", force.s), a.io("shape_forces", force.Q);
  });
}

void MechanismParts::view_loads(const TreeMotion& at, const solver::State& state,
                                std::vector<Eigen::VectorXd>& generalised) {
  generalised.resize(loads.size());
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const std::vector<int>& path = tree.path[loads[i].link()];
    const Vector6 W = loads[i].wrench(at, state);
    generalised[i].resize(static_cast<Index>(path.size()));
    for (std::size_t k = 0; k < path.size(); ++k) generalised[i][static_cast<Index>(k)] = at.J(path[k]).dot(W);
  }
}

void MechanismParts::view_stores(const solver::State& state, EnergyView& view) {
  view.kinetic.assign(tree.links.size(), 0);
  view.potential = 0;
  for (std::size_t l = 1; l < tree.links.size(); ++l) {
    const Link& link = tree.links[l];
    if (link.mass == 0 && link.inertia.isZero(0)) continue;
    const Pose& X_WL = motion.X(static_cast<int>(l));
    view.kinetic[l] = kinetic_energy_of(link, X_WL, motion.V(static_cast<int>(l)));
    view.potential -= link.mass * spec.gravity.dot(X_WL * link.com);
  }
  view.springs.resize(spec.springs.size());
  for (std::size_t i = 0; i < spec.springs.size(); ++i) {
    const double stretch = state.q[q_of(spring_columns[i])] - spec.springs[i].free_position;
    view.springs[i] = 0.5 * spec.springs[i].stiffness * stretch * stretch;
  }
  view.functions.resize(spec.coordinate_forces.size());
  view.coordinate_efforts.resize(spec.coordinate_forces.size());
  for (std::size_t i = 0; i < spec.coordinate_forces.size(); ++i) {
    const CoordinateForce& force = *spec.coordinate_forces[i].force;
    const int k = coordinate_force_columns[i];
    view.functions[i] = force.stored_energy(state.q[q_of(k)]);
    view.coordinate_efforts[i] = force.evaluate(state.t, state.q[q_of(k)], state.v[k]).value;
  }
  view.strain.resize(elastics.size());
  view.elastic_kinetic.resize(elastics.size());
  view.pressures.assign(elastics.size(), 0);
  for (std::size_t i = 0; i < elastics.size(); ++i) {
    const ElasticEnergy energy = elastics[i].body().energy(elastics[i].motion(), spec.gravity);
    view.strain[i] = energy.strain;
    view.elastic_kinetic[i] = energy.kinetic;
    view.potential += energy.potential;
    for (const ElasticLoad& load : energy.loads) view.pressures[i] += load.power;
  }
}

void Mechanism::view_energy(const solver::State& state, bool is_trial, EnergyView& view) {
  MechanismParts& m = *parts_;
  m.motion.update(state);
  if (!is_trial) m.read_elastic_bodies(state);
  view.t = state.t;
  view.q = state.q, view.v = state.v;
  m.view_stores(state, view);
  m.view_loads(m.motion, state, view.load_generalised);
  view.drive_efforts.resize(m.drives.size());
  for (std::size_t i = 0; i < m.drives.size(); ++i) view.drive_efforts[i] = -state.lambda[m.row_of_drive(i)];
  const std::vector<ForceResponse>& acting = is_trial || m.accepted.empty() ? m.responses : m.accepted;
  view.forces.resize(m.spec.forces.size());
  for (std::size_t i = 0; i < m.spec.forces.size(); ++i) {
    const RelativeMotion relative = is_trial ? m.relatives[i] : m.relative_motion(i, state.t);
    const TwoBodyForce& force = *m.spec.forces[i].force;
    ForceView& observed = view.forces[i];
    observed.stored = force.stored_energy(relative);
    observed.lost = force.lost_power(relative);
    observed.W = acting[i].W_B_A;
    observed.Q = acting[i].Q;
    observed.X_AB = relative.X_AB;
    observed.s = relative.s;
  }
}

Eigen::VectorXd MechanismParts::way_between(const EnergyView& from, const EnergyView& to) const {
  Eigen::VectorXd way(nv);
  for (const Link& link : tree.links) {
    if (link.motion == Motion::ball) {
      const auto at = [&](const Eigen::VectorXd& q) {
        return Eigen::Quaterniond(q[link.first_q], q[link.first_q + 1], q[link.first_q + 2], q[link.first_q + 3]);
      };
      way.segment<3>(link.first_v) = rotation_log(at(from.q).conjugate() * at(to.q));
    } else if (link.columns == 1) {
      way[link.first_v] = to.q[link.first_q] - from.q[link.first_q];
    }
  }
  way.tail(nv - tree.nv) = to.q.tail(nv - tree.nv) - from.q.tail(nv - tree.nv);
  return way;
}

// At the ends the forces that acted there are used; between them functions are evaluated along a path that is straight
// in the coordinates.
void MechanismParts::work_of_functions(const EnergyView& from, const EnergyView& to, const Eigen::VectorXd& way,
                                       const Retract& retract, WorkBetween& work) {
  std::vector<Simpson> of_loads(loads.size()), of_functions(spec.coordinate_forces.size());
  if (of_loads.empty() && of_functions.empty()) return;
  const auto along = [&](std::size_t load, const Eigen::VectorXd& generalised) {
    const std::vector<int>& path = tree.path[loads[load].link()];
    double sum = 0;
    for (std::size_t k = 0; k < path.size(); ++k) sum += generalised[static_cast<Index>(k)] * way[path[k]];
    return sum;
  };
  const double dt = to.t - from.t;
  solver::State between;
  between.v = way / dt;
  std::vector<Eigen::VectorXd> generalised;
  if (!loads.empty() && !aside) aside.emplace(tree, spec.gravity);
  for (int point = 0; point <= 4; ++point) {
    const bool is_end = point == 0 || point == 4;
    const EnergyView& end = point == 0 ? from : to;
    if (!is_end) {
      between.t = from.t + 0.25 * point * dt;
      retract(from.q, 0.25 * point * way, between.q);
    }
    if (!is_end && !loads.empty()) {
      aside->update_positions(between);
      view_loads(*aside, between, generalised);
    }
    for (std::size_t i = 0; i < loads.size(); ++i)
      of_loads[i].add(point, along(i, is_end ? end.load_generalised[i] : generalised[i]));
    for (std::size_t i = 0; i < of_functions.size(); ++i) {
      const CoordinateForce& force = *spec.coordinate_forces[i].force;
      if (force.is_store()) continue;
      const int k = coordinate_force_columns[i];
      const double effort =
          is_end ? end.coordinate_efforts[i] : force.evaluate(between.t, between.q[q_of(k)], between.v[k]).value;
      of_functions[i].add(point, effort * way[k]);
    }
  }
  for (const Simpson& load : of_loads) work.loads.push_back(load.work());
  for (const Simpson& function : of_functions) work.functions.push_back(function.work());
}

WorkBetween Mechanism::work_between(const EnergyView& from, const EnergyView& to) {
  MechanismParts& m = *parts_;
  WorkBetween work;
  const double dt = to.t - from.t;
  const Eigen::VectorXd way = m.way_between(from, to);
  m.work_of_functions(
      from, to, way, [this](const auto& q0, const auto& dq, auto& q) { retract(q0, dq, q); }, work);
  for (std::size_t i = 0; i < m.drives.size(); ++i)
    work.drives.push_back(of_mean(from.drive_efforts[i], to.drive_efforts[i], way[m.drives[i].column]));
  for (std::size_t i = 0; i < from.pressures.size(); ++i)
    work.pressures.push_back(of_mean(from.pressures[i], to.pressures[i], dt));
  for (std::size_t i = 0; i < m.spec.springs.size(); ++i) {
    const int k = m.spring_columns[i];
    work.lost_in_springs += std::max(0.0, 0.5 * m.spec.springs[i].damping * (from.v[k] + to.v[k]) * way[k]);
  }
  for (std::size_t i = 0; i < from.forces.size(); ++i) {
    const ForceView &first = from.forces[i], &last = to.forces[i];
    const Vector6 xi = twist_between(first.X_AB, last.X_AB);
    StepWork of_force = of_mean(first.W.dot(xi), last.W.dot(xi), 1);
    if (first.s.size() > 0 && first.Q.size() == last.Q.size() && first.Q.size() == first.s.size()) {
      const StepWork of_shapes = of_mean(first.Q.dot(last.s - first.s), last.Q.dot(last.s - first.s), 1);
      of_force.value += of_shapes.value;
      of_force.uncertainty += of_shapes.uncertainty;
    }
    work.forces.push_back(of_force);
    // Velocities at both ends may be those of a vibration that the step does not follow: the damper has then done
    // less than they say (integrator.30).
    const double taken = -of_force.value - (last.stored - first.stored);
    work.lost.push_back(std::max(0.0, std::min(dt * std::min(first.lost, last.lost), taken)));
  }
  return work;
}

LargestEnergyChanges Mechanism::largest_energy_changes(const EnergyView& from, const EnergyView& to) const {
  const MechanismParts& m = *parts_;
  LargestEnergyChanges largest;
  double most = 0;
  const auto offer = [&](std::string& best, double growth, const std::string& name) {
    if (!(growth > most)) return;
    most = growth;
    best = name;
  };
  for (std::size_t b = 1; b < m.spec.bodies.size(); ++b) {
    const auto link = static_cast<std::size_t>(m.tree.bodies[b].link);
    offer(largest.body, to.kinetic[link] - from.kinetic[link], "body " + m.spec.bodies[b].name);
  }
  for (std::size_t i = 0; i < m.elastics.size(); ++i)
    offer(largest.body, to.strain[i] - from.strain[i] + to.elastic_kinetic[i] - from.elastic_kinetic[i],
          "body " + m.elastics[i].name());
  most = 0;
  for (std::size_t i = 0; i < m.spec.springs.size(); ++i)
    offer(largest.force, std::abs(to.springs[i] - from.springs[i]), "spring " + m.spec.springs[i].name);
  for (std::size_t i = 0; i < m.spec.coordinate_forces.size(); ++i)
    offer(largest.force, std::abs(to.functions[i] - from.functions[i]), "spring " + m.spec.coordinate_forces[i].name);
  for (std::size_t i = 0; i < m.spec.forces.size(); ++i)
    offer(largest.force, std::abs(to.forces[i].stored - from.forces[i].stored), "force " + m.spec.forces[i].name);
  return largest;
}

}  // namespace hersey::mbd
