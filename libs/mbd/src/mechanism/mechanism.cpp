#include "hersey/mbd/mechanism.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hersey/core/contract.h"
#include "hersey/core/stopwatch.h"
#include "mechanism/mechanism_parts.h"
#include "tree/tree_builder.h"

namespace hersey::mbd {

using solver::Stage;
using solver::State;

MechanismParts::MechanismParts(MechanismSpec given)
    : spec(std::move(given)),
      tree(build_tree(spec)),
      motion(tree, spec.gravity),
      inertia(tree),
      directions(tree.columns.size()),
      relatives(spec.forces.size()),
      responses(spec.forces.size()) {
  for (const LoadSpec& load : spec.loads) loads.emplace_back(load, spec.frames[load.frame.index].body, tree);
  for (const DriveSpec& drive : spec.drives) {
    const int column = column_of(tree, drive.coordinate);
    drives.push_back(
        {column, q_of(column), DriveMotion(drive, initial_value(drive.coordinate), initial_rate(drive.coordinate))});
  }
  for (const CouplingSpec& coupling : spec.couplings) couplings.emplace_back(coupling, tree);
  for (const CoordinateSpringSpec& spring : spec.springs) spring_columns.push_back(column_of(tree, spring.coordinate));
  for (const MechanismSpec::CoordinateForce& force : spec.coordinate_forces)
    coordinate_force_columns.push_back(column_of(tree, force.coordinate));
  for (const MechanismSpec::Shared& shared : spec.shared) {
    shared_columns.emplace_back();
    for (const CoordinateRef& coordinate : shared.coordinates)
      shared_columns.back().push_back(column_of(tree, coordinate));
  }
  add_elastic_bodies();
  find_deforming_surfaces();
  release_redundant_rows();
  make_patterns();
  timing.force.assign(spec.forces.size(), 0);
  timing.elastic.assign(elastics.size(), 0);
}

void MechanismParts::add_elastic_bodies() {
  nq = tree.nq;
  nv = tree.nv;
  for (const MechanismSpec::Elastic& elastic : spec.elastics) {
    elastics.emplace_back(elastic, tree, nq, nv);
    nq += elastics.back().own_count();
    nv += elastics.back().own_count();
  }
}

double MechanismParts::initial_value(const CoordinateRef& coordinate) const {
  const std::vector<double>& initial = spec.joints[coordinate.joint.index].initial;
  return initial.empty() ? 0.0 : initial[coordinate.value];
}

double MechanismParts::initial_rate(const CoordinateRef& coordinate) const {
  const std::vector<double>& initial = spec.joints[coordinate.joint.index].initial_rate;
  return initial.empty() ? 0.0 : initial[coordinate.value];
}

Mechanism::Mechanism(MechanismSpec spec) : parts_(std::make_unique<MechanismParts>(std::move(spec))) {}
Mechanism::~Mechanism() = default;

Mechanism::Index Mechanism::nq() const { return parts_->nq; }
Mechanism::Index Mechanism::nv() const { return parts_->nv; }
Mechanism::Index Mechanism::nlambda() const { return parts_->nlambda(); }
const MechanismSpec& Mechanism::spec() const { return parts_->spec; }
const MechanismTiming& Mechanism::timing() const { return parts_->timing; }

std::vector<JointId> Mechanism::closing_joints() const {
  std::vector<JointId> ids;
  for (const Closure& closure : parts_->tree.closures) ids.push_back({closure.joint});
  return ids;
}

void Mechanism::retract(const Eigen::VectorXd& q0, const Eigen::VectorXd& dq, Eigen::VectorXd& q) const {
  q.resize(q0.size());
  for (const Link& link : parts_->tree.links) {
    if (link.motion == Motion::ball) {
      const Eigen::Vector4d p = q0.segment<4>(link.first_q);
      const Eigen::Quaterniond R =
          (Eigen::Quaterniond(p[0], p[1], p[2], p[3]) * rotation_exp(dq.segment<3>(link.first_v))).normalized();
      q.segment<4>(link.first_q) << R.w(), R.x(), R.y(), R.z();
    } else if (link.columns == 1) {
      q[link.first_q] = q0[link.first_q] + dq[link.first_v];
    }
  }
  const Index own = parts_->nv - parts_->tree.nv;
  q.tail(own) = q0.tail(own) + dq.segment(parts_->tree.nv, own);
}

Eigen::VectorXd Mechanism::difference(const Eigen::VectorXd& q0, const Eigen::VectorXd& q,
                                      const std::vector<Index>& counted) const {
  Eigen::VectorXd dq = Eigen::VectorXd::Zero(nv());
  const auto at = [](const Link& link, const Eigen::VectorXd& of) {
    const Eigen::Vector4d p = of.segment<4>(link.first_q);
    return Eigen::Quaterniond(p[0], p[1], p[2], p[3]);
  };
  for (const Link& link : parts_->tree.links) {
    if (link.motion == Motion::ball) {
      dq.segment<3>(link.first_v) = rotation_log(at(link, q0).conjugate() * at(link, q));
    } else if (link.columns == 1) {
      const double way = q[link.first_q] - q0[link.first_q];
      const bool is_any = link.motion == Motion::revolute && std::ranges::find(counted, link.first_v) == counted.end();
      dq[link.first_v] = is_any ? std::remainder(way, 2 * std::numbers::pi) : way;
    }
  }
  const Index own = parts_->nv - parts_->tree.nv;
  dq.tail(own) = q.tail(own) - q0.tail(own);
  return dq;
}

std::vector<Mechanism::Index> Mechanism::revolutions() const {
  std::vector<Index> components;
  for (const Link& link : parts_->tree.links)
    if (link.columns == 1 && link.motion == Motion::revolute) components.push_back(link.first_v);
  return components;
}

std::vector<Mechanism::Index> Mechanism::driven_coordinates() const {
  std::vector<Index> components;
  for (const Link& link : parts_->tree.links)
    for (const DriveSpec& drive : parts_->spec.drives)
      if (link.columns == 1 && drive.coordinate.joint.index == link.joint && drive.coordinate.value == link.value)
        components.push_back(link.first_v);
  return components;
}

std::vector<Mechanism::Index> Mechanism::sprung_coordinates() const {
  const MechanismParts& m = *parts_;
  std::vector<Index> components;
  for (std::size_t i = 0; i < m.spec.springs.size(); ++i)
    if (m.spec.springs[i].stiffness != 0) components.push_back(m.spring_columns[i]);
  for (std::size_t i = 0; i < m.spec.coordinate_forces.size(); ++i)
    if (m.spec.coordinate_forces[i].force->is_store()) components.push_back(m.coordinate_force_columns[i]);
  return components;
}

void Mechanism::increment_rate(const Eigen::VectorXd& dq, const Eigen::VectorXd& v, Eigen::VectorXd& rate) const {
  rate = v;
  for (const Link& link : parts_->tree.links) {
    if (link.motion != Motion::ball) continue;
    const Matrix3 T = rotation_exp_tangent(dq.segment<3>(link.first_v));
    rate.segment<3>(link.first_v) = T.inverse() * v.segment<3>(link.first_v);
  }
}

void Mechanism::assemble(const State& state, const Stage& stage, Eigen::VectorXd& residual, Eigen::VectorXd& scale,
                         SparseMatrix* tangent) {
  MechanismParts& m = *parts_;
  const Stopwatch all(m.timing.total);
  const Index n = nv() + nlambda();
  residual.setZero(n);
  scale.setZero(n);
  if (tangent) {
    if (tangent->rows() != n || tangent->nonZeros() != m.pattern.nonZeros()) *tangent = m.pattern;
    std::fill_n(tangent->valuePtr(), tangent->nonZeros(), 0.0);
  }
  m.motion.update(state);
  if (tangent) compute_directions(m.tree, m.motion, stage, m.directions);
  Assembly assembly{m.tree, m.motion, stage, m.directions, residual, scale, tangent};
  const bool is_apart = stage.holds_inertia;
  if (!is_apart) m.inertia.add(assembly);
  m.for_each_elastic([&](ElasticAssembly& elastic) { elastic.prepare(assembly, state); });
  m.evaluate_two_body_forces(assembly, state);
  if (!is_apart) m.for_each_elastic([&](ElasticAssembly& elastic) { elastic.add(assembly, m.spec.gravity); });
  for (Load& load : m.loads) load.add(assembly, state);
  m.add_coordinate_springs(assembly, state);
  m.add_coordinate_forces(assembly, state);
  m.add_two_body_forces(assembly);
  m.add_closures(assembly, state);
  m.add_couplings(assembly, state);
  m.add_drives(assembly, state);
  if (is_apart) m.add_inertia_and_elasticity(assembly, state);
  m.floor_scales(scale);
}

/// Inertia forces and elastic bodies at the velocities with which the step began, which no increment moves.
void MechanismParts::add_inertia_and_elasticity(Assembly& assembly, const State& state) {
  State other = state;
  other.v = v_begun;
  Stage stage = assembly.stage;
  stage.c = 0;
  motion.update(other);
  if (assembly.tangent) compute_directions(tree, motion, stage, directions);
  Assembly apart{tree, motion, stage, directions, assembly.residual, assembly.scale, assembly.tangent};
  inertia.add(apart);
  for_each_elastic([&](ElasticAssembly& elastic) {
    elastic.prepare_again(apart, other);
    elastic.add(apart, spec.gravity);
  });
}

void MechanismParts::add_coordinate_springs(Assembly& assembly, const State& state) const {
  for (std::size_t i = 0; i < spec.springs.size(); ++i) {
    const CoordinateSpringSpec& spring = spec.springs[i];
    const int k = spring_columns[i];
    const double elastic = spring.stiffness * (state.q[q_of(k)] - spring.free_position);
    const double viscous = spring.damping * state.v[k];
    assembly.add_residual(k, elastic + viscous, std::abs(elastic) + std::abs(viscous));
    if (assembly.tangent)
      assembly.add_tangent(k, k, assembly.stage.k * spring.stiffness + assembly.stage.c * spring.damping);
  }
}

void MechanismParts::add_coordinate_forces(Assembly& assembly, const State& state) const {
  for (std::size_t i = 0; i < spec.coordinate_forces.size(); ++i) {
    const int k = coordinate_force_columns[i];
    const CoordinateEffort effort = spec.coordinate_forces[i].force->evaluate(state.t, state.q[q_of(k)], state.v[k]);
    assembly.add_residual(k, -effort.value, std::abs(effort.value));
    if (assembly.tangent)
      assembly.add_tangent(k, k, -assembly.stage.k * effort.by_position - assembly.stage.c * effort.by_rate);
  }
}

ForceResponse closure_response(const Closure& closure, const Pose& X_AB, const Eigen::VectorXd& lambda,
                               bool with_derivative) {
  ForceResponse response;
  for (std::size_t i = 0; i < closure.rows.size(); ++i) {
    const double l = lambda[closure.first_row + static_cast<int>(i)];
    response.W_B_A -= l * closure.rows[i].wrench(X_AB);
    if (with_derivative) response.dW_dX -= l * closure.rows[i].wrench_derivative(X_AB);
  }
  return response;
}

/// Scales of positional rows. A cut compares positions in ground, whose round-off is that of their distance from the
/// origin.
double MechanismParts::closure_length(const Closure& closure, const Pose& X_WA) const {
  return closure.first_row < 6 * static_cast<int>(tree.cuts.size()) ? std::max(tree.length, X_WA.r.norm())
                                                                    : tree.length;
}

void MechanismParts::add_closures(Assembly& assembly, const State& state) const {
  const bool has_stiffness = assembly.tangent != nullptr && !assembly.is_of_inertia_alone();
  for (const Closure& closure : tree.closures) {
    const Pose X_WA = motion.pose(closure.pair.a);
    const Pose X_AB = X_WA.inverse() * motion.pose(closure.pair.b);
    add_pair_force(assembly, closure.pair, closure_response(closure, X_AB, state.lambda, has_stiffness));
    for (std::size_t i = 0; i < closure.rows.size(); ++i) {
      const ConstraintRow& row = closure.rows[i];
      const int at = nv + closure.first_row + static_cast<int>(i);
      const bool positional = row.kind == ConstraintRow::Kind::position;
      assembly.add_residual(at, row.value(X_AB), positional ? closure_length(closure, X_WA) : 1.0);
      if (!assembly.tangent) continue;
      const Vector6 w = moved_force(X_WA, row.wrench(X_AB));
      for (const SignedColumn& col : closure.pair.columns) {
        assembly.add_tangent(col.column, at, col.sign * motion.J(col.column).dot(w));
        assembly.add_tangent(at, col.column, col.sign * assembly.directions[col.column].J.dot(w));
      }
    }
  }
}

double MechanismParts::coupling_scale(const Coupling& coupling, const State& state) const {
  const bool linear = tree.links[tree.columns[coupling.output()].link].motion == Motion::prismatic;
  return std::max(linear ? tree.length : 1.0, coupling.magnitude(state));
}

void MechanismParts::add_couplings(Assembly& assembly, const State& state) const {
  for (std::size_t i = 0; i < couplings.size(); ++i) {
    const Coupling& coupling = couplings[i];
    const Index row = nv + row_of_coupling(i);
    const double lambda = state.lambda[row_of_coupling(i)];
    assembly.add_residual(row, coupling.value(state), coupling_scale(coupling, state));
    coupling.visit_rates(state, [&](int column, double rate) {
      assembly.add_residual(column, lambda * rate, std::abs(lambda * rate));
      if (!assembly.tangent) return;
      assembly.add_tangent(column, row, rate);
      assembly.add_tangent(row, column, assembly.stage.k * rate);
    });
    if (!assembly.tangent) continue;
    coupling.visit_curvatures(state, [&](int column, double curvature) {
      assembly.add_tangent(column, column, assembly.stage.k * lambda * curvature);
    });
  }
}

void MechanismParts::add_drives(Assembly& assembly, const State& state) const {
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const BoundDrive& drive = drives[i];
    const Index row = nv + row_of_drive(i);
    const double lambda = state.lambda[row_of_drive(i)];
    const double asked = drive.motion.position(state.t);
    const bool angle = tree.links[tree.columns[drive.column].link].motion != Motion::prismatic;
    assembly.add_residual(drive.column, lambda, std::abs(lambda));
    assembly.add_residual(row, state.q[drive.q] - asked, std::max(angle ? 1.0 : tree.length, std::abs(asked)));
    if (!assembly.tangent) continue;
    assembly.add_tangent(drive.column, row, 1.0);
    assembly.add_tangent(row, drive.column, assembly.stage.k);
  }
}

void MechanismParts::floor_scales(Eigen::VectorXd& scale) const {
  // A row with next to no load of its own (a planar mechanism's transverse rows) is measured against its largest
  // companion of the same unit, three decades down: otherwise it would have to be solved to the round-off of nothing.
  constexpr double fraction = 1e-3;
  double force = 0, torque = 0;
  for (int k = 0; k < tree.nv; ++k) {
    double& largest = tree.links[tree.columns[k].link].motion == Motion::prismatic ? force : torque;
    largest = std::max(largest, scale[k]);
  }
  for (int k = tree.nv; k < nv; ++k) force = std::max(force, scale[k]);
  // All rows of one unit may be next to nothing (forces through the only axis of rotation): the remainder is the
  // round-off of the other unit's terms with the mechanism's arms.
  constexpr double round_off = 1e-6;
  torque = std::max(torque, round_off / fraction * force * tree.length);
  force = std::max(force, round_off / fraction * torque / tree.length);
  for (int k = 0; k < tree.nv; ++k) {
    const bool linear = tree.links[tree.columns[k].link].motion == Motion::prismatic;
    scale[k] = std::max(scale[k], fraction * (linear ? force : torque));
  }
  for (int k = tree.nv; k < nv; ++k) scale[k] = std::max(scale[k], fraction * force);
}

void Mechanism::constraints(const State& state, Eigen::VectorXd& phi, Eigen::VectorXd& scale, SparseMatrix* jacobian) {
  MechanismParts& m = *parts_;
  phi.setZero(nlambda());
  scale.setOnes(nlambda());
  if (jacobian) *jacobian = m.constraint_pattern;
  m.motion.update_positions(state);
  for (const Closure& closure : m.tree.closures) {
    const Pose X_WA = m.motion.pose(closure.pair.a);
    const Pose X_AB = X_WA.inverse() * m.motion.pose(closure.pair.b);
    for (std::size_t i = 0; i < closure.rows.size(); ++i) {
      const ConstraintRow& row = closure.rows[i];
      const Index at = closure.first_row + static_cast<Index>(i);
      phi[at] = row.value(X_AB);
      if (row.kind == ConstraintRow::Kind::position) scale[at] = m.closure_length(closure, X_WA);
      if (!jacobian) continue;
      const Vector6 w = moved_force(X_WA, row.wrench(X_AB));
      for (const SignedColumn& col : closure.pair.columns)
        jacobian->coeffRef(at, col.column) = col.sign * m.motion.J(col.column).dot(w);
    }
  }
  for (std::size_t i = 0; i < m.couplings.size(); ++i) {
    const Index at = m.row_of_coupling(i);
    phi[at] = m.couplings[i].value(state);
    scale[at] = m.coupling_scale(m.couplings[i], state);
    if (jacobian)
      m.couplings[i].visit_rates(state, [&](int column, double rate) { jacobian->coeffRef(at, column) += rate; });
  }
  for (std::size_t i = 0; i < m.drives.size(); ++i) {
    const BoundDrive& drive = m.drives[i];
    const Index at = m.row_of_drive(i);
    const double asked = drive.motion.position(state.t);
    phi[at] = state.q[drive.q] - asked;
    const bool angle = m.tree.links[m.tree.columns[drive.column].link].motion != Motion::prismatic;
    scale[at] = std::max(angle ? 1.0 : m.tree.length, std::abs(asked));
    if (jacobian) jacobian->coeffRef(at, drive.column) = 1.0;
  }
}

void Mechanism::constraint_rates(const State& state, Eigen::VectorXd& velocity, Eigen::VectorXd& bias) {
  MechanismParts& m = *parts_;
  velocity.setZero(nlambda());
  bias.setZero(nlambda());
  if ((state.vdot.array() == 0).all()) {
    m.motion.update(state);  // often of an assembly at the same state
  } else {
    m.motion.update_positions(state);
    m.motion.update_velocities(state);
    m.motion.update_accelerations(state, true);
  }
  for (const Closure& closure : m.tree.closures) {
    const Pair& pair = closure.pair;
    const RelativeMotion relative = m.motion.relative(pair);
    const Vector6 &V_a = m.motion.V(pair.a.link), &V_b = m.motion.V(pair.b.link);
    // Theory manual eq. (mechanisms.16): the relative acceleration in A's axes.
    const Vector6 A_AB_A = motion_transform(m.motion.pose(pair.a).inverse()) *
                           (m.motion.A(pair.b.link) - m.motion.A(pair.a.link) - cross_motion(V_a, V_b - V_a));
    for (std::size_t i = 0; i < closure.rows.size(); ++i) {
      const ConstraintRow& row = closure.rows[i];
      const Index at = closure.first_row + static_cast<Index>(i);
      velocity[at] = row.wrench(relative.X_AB).dot(relative.V_AB_A);
      bias[at] = row.wrench(relative.X_AB).dot(A_AB_A) +
                 relative.V_AB_A.dot(row.wrench_derivative(relative.X_AB) * relative.V_AB_A);
    }
  }
  for (std::size_t i = 0; i < m.couplings.size(); ++i) {
    const Index at = m.row_of_coupling(i);
    m.couplings[i].visit_rates(state, [&](int column, double rate) { velocity[at] += rate * state.v[column]; });
    bias[at] = m.couplings[i].bias(state);
  }
  for (std::size_t i = 0; i < m.drives.size(); ++i) {
    const BoundDrive& drive = m.drives[i];
    const Index at = m.row_of_drive(i);
    velocity[at] = state.v[drive.column] - drive.motion.velocity(state.t);
    bias[at] = -drive.motion.acceleration(state.t);
  }
}

Eigen::VectorXd Mechanism::position_scales() const {
  const Tree& tree = parts_->tree;
  Eigen::VectorXd scales = Eigen::VectorXd::Ones(nv());
  for (const Link& link : tree.links)
    if (link.motion == Motion::prismatic) scales.segment(link.first_v, link.columns).setConstant(tree.length);
  scales.tail(nv() - tree.nv).setConstant(tree.length);
  return scales;
}

void Mechanism::begin_step(const State& start, double dt) {
  MechanismParts& m = *parts_;
  m.v_begun = start.v;
  if (!m.has_stateful_parts()) return;
  const Stopwatch all(m.timing.total);
  m.motion.update(start);
  m.read_elastic_bodies(start);
  m.for_each_elastic([&](ElasticAssembly& elastic) { elastic.body().begin_step(elastic.motion(), dt); });
  const auto begin = [&](std::size_t i) { m.spec.forces[i].force->begin_step(m.relative_motion(i, start.t), dt); };
  m.for_each_force(std::cref(begin));
  for (const MechanismSpec::Shared& shared : m.spec.shared) shared.unknowns->begin_step(dt);
}

bool Mechanism::is_step_consistent() {
  MechanismParts& m = *parts_;
  const Stopwatch all(m.timing.total), forces(m.timing.forces);
  bool is_consistent = true;
  for (std::size_t i = 0; i < m.spec.forces.size(); ++i) {
    const Stopwatch one(m.timing.force[i]);
    is_consistent = m.spec.forces[i].force->is_step_consistent() && is_consistent;
  }
  return is_consistent;
}

void Mechanism::accept_step(const State& end) {
  MechanismParts& m = *parts_;
  const Stopwatch all(m.timing.total);
  for (BoundDrive& drive : m.drives) drive.motion.anchor(end.t);
  for (std::size_t i = 0; i < m.spec.coordinate_forces.size(); ++i) {
    const int k = m.coordinate_force_columns[i];
    m.spec.coordinate_forces[i].force->accept_step(end.t, end.q[m.q_of(k)], end.v[k]);
  }
  if (!m.has_stateful_parts() && m.redundancies.empty()) return;
  m.motion.update_positions(end);
  m.watch_dropped_rows();
  if (!m.has_stateful_parts()) return;
  m.motion.update_velocities(end);
  m.motion.update_accelerations(end);
  m.read_elastic_bodies(end);
  m.hand_out_shape_forces(m.responses);
  m.for_each_elastic([&](ElasticAssembly& elastic) { elastic.body().accept_step(elastic.motion()); });
  for (const MechanismSpec::Shared& shared : m.spec.shared) shared.unknowns->accept_step();
  m.accepted.resize(m.spec.forces.size());
  const auto accept = [&](std::size_t i) {
    const RelativeMotion relative = m.relative_motion(i, end.t);
    m.spec.forces[i].force->accept_step(relative);
    // Accelerations may be solved for after the forces have been evaluated, as at a start: inertia forces follow them.
    const ForceResponse& found = m.responses[i];
    m.accepted[i].W_B_A = found.W_B_A + found.dW_dA * (relative.A_AB_A - m.relatives[i].A_AB_A);
    m.accepted[i].Q = m.responses[i].Q;
  };
  m.for_each_force(std::cref(accept));
}

bool Mechanism::has_condensed_unknowns() const {
  bool any = false;
  parts_->for_each_part([&](const auto& /*owner*/, const auto& part) { any = any || part.has_condensed_unknowns(); });
  return any;
}

bool Mechanism::needs_tangent() const {
  bool any = false;
  parts_->for_each_part([&](const auto& /*owner*/, const auto& part) { any = any || part.needs_tangent(); });
  return any;
}

double Mechanism::internal_residual() const {
  double worst = 0;
  parts_->for_each_part(
      [&](const auto& /*owner*/, const auto& part) { worst = std::max(worst, part.internal_residual()); });
  return worst;
}

std::string Mechanism::name_of_internal_residual() const {
  std::string name;
  double worst = -1;
  parts_->for_each_part([&](const auto& owner, const auto& part) {
    if (part.internal_residual() <= worst) return;
    worst = part.internal_residual();
    name = fmt::format("{}, {}", owner(), part.name_of_internal_residual());
  });
  return name;
}

bool Mechanism::has_whole_tangent() const {
  bool whole = true;
  for (const auto& f : parts_->spec.forces) whole = whole && f.force->has_tangent();
  return whole;
}

std::string Mechanism::domain_error() const {
  if (!parts_->constraint_violation.empty()) return parts_->constraint_violation;
  std::string first;
  parts_->for_each_part([&](const auto& owner, const auto& part) {
    if (!first.empty()) return;
    if (const std::string text = part.domain_error(); !text.empty()) first = fmt::format("{}: {}", owner(), text);
  });
  return first;
}

State Mechanism::initial_state() const { return parts_->initial_state(); }

std::vector<Mechanism::Index> Mechanism::given_coordinates() const { return parts_->given_coordinates(); }
std::vector<Mechanism::Index> Mechanism::given_rates() const { return parts_->given_rates(); }

std::vector<Mechanism::Index> Mechanism::elastic_coordinates() const { return parts_->elastic_coordinates(); }
std::vector<Mechanism::Index> Mechanism::internal_coordinates() const { return parts_->internal_coordinates(); }

FrameMotion Mechanism::frame_motion(const State& state, FrameId frame) {
  HERSEY_REQUIRE(0 <= frame.index && frame.index < static_cast<int>(parts_->tree.frames.size()), "the frame exists");
  parts_->motion.update(state);
  return parts_->frame_motion(parts_->tree.frames[frame.index]);
}

RelativeMotion Mechanism::relative_motion(const State& state, ForceId force) {
  HERSEY_REQUIRE(0 <= force.index && force.index < static_cast<int>(parts_->tree.forces.size()), "the force exists");
  parts_->motion.update(state);
  parts_->read_elastic_bodies(state);
  return parts_->relative_motion(static_cast<std::size_t>(force.index), state.t);
}

void Mechanism::persist(Archive& archive) {
  MechanismParts& m = *parts_;
  for (std::size_t i = 0; i < m.drives.size(); ++i) {
    const Archive::Group group(archive, "drive " + m.spec.drives[i].name);
    m.drives[i].motion.persist(archive);
  }
  for (const MechanismSpec::CoordinateForce& force : m.spec.coordinate_forces) {
    const Archive::Group group(archive, "coordinate force " + force.name);
    force.force->persist(archive);
  }
  persist_between_bodies(archive);
}

void Mechanism::persist_between_bodies(Archive& archive) {
  MechanismParts& m = *parts_;
  archive.each("accepted_forces", m.accepted, [](Archive& a, ForceResponse& response) {
    a.io("wrench", response.W_B_A);
    a.io("shape_forces", response.Q);
  });
  for (const MechanismSpec::Force& force : m.spec.forces) {
    const Archive::Group group(archive, "force " + force.name);
    force.force->persist(archive);
  }
  for (const MechanismSpec::Shared& shared : m.spec.shared) {
    const Archive::Group group(archive, shared.name);
    shared.unknowns->persist(archive);
  }
  for (ElasticAssembly& elastic : m.elastics) {
    const Archive::Group group(archive, "body " + elastic.name());
    elastic.body().persist(archive);
  }
}

}  // namespace hersey::mbd
