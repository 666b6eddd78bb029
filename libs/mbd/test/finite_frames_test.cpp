// Bodies of finite strain with several frames: which frame carries the axes does not matter at any rotation.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "elastic_large_displacement.h"
#include "flexible_beam.h"
#include "hersey/fem/finite_strain.h"
#include "hersey/fem/load_vectors.h"
#include "hersey/mbd/mechanism_builder.h"
#include "hersey/solver/equilibrium.h"
#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace finite_frames_test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

test::Beam strip(bool tip_first, int cells = 10) {
  test::Beam beam{.size = {1, 0.05, 0.05}, .cells = {cells, 1, 1}, .tip = true};
  beam.tip_first = tip_first;
  beam.material.youngs_modulus = 2e9;
  beam.nodal = true;
  beam.strain = Strain::finite;
  return beam;
}

/// A strip clamped or hinged at its root, with a force at its tip, in ground's axes.
struct SupportedStrip {
  std::unique_ptr<Mechanism> mechanism;
  FrameId tip;
  ElasticId elastic;

  SupportedStrip(const test::Beam& beam, JointType joint, const Vector3& force, double moment, bool is_let_go = false) {
    MechanismBuilder b;
    b.set_gravity({0, -9.81, 0});
    const std::shared_ptr<NodalBody> body = beam.all_nodes();
    if (is_let_go) body->start_undeformed();
    const FlexibleBodyIds ids = b.add_flexible_body("strip", {beam.tip_first ? "root" : "tip"}, body);
    const std::size_t root = beam.tip_first ? 1 : 0;
    const FrameId at_root = beam.tip_first
                                ? ids.frames[1]
                                : b.add_frame({.name = "root", .body = ids.bodies[root], .X_BF = beam.frame_at(0)});
    tip = beam.tip_first ? b.add_frame({.name = "end", .body = ids.bodies[0], .X_BF = beam.frame_at(beam.size.x())})
                         : ids.frames[1];
    elastic = ids.elastic;
    b.add_joint({.name = "root", .type = joint, .inboard = b.frame_of(b.ground()), .outboard = at_root});
    LoadTerm term;
    term.direction << 0, 0, moment, force;
    term.magnitude = test::constant(1);
    term.variables = {{.kind = Variable::Kind::time, .coordinate = {}}};
    b.add_load({.name = "push", .frame = tip, .axes = LoadAxes::ground, .terms = {term}});
    mechanism = b.finalise();
  }
};

TEST_CASE("FiniteStrainBetweenFrames_IsTheSameFromEitherFrame") {
  // A force across and a moment rotate the tip by 1.4 rad.
  std::array<Pose, 2> tip;
  for (const bool tip_first : {false, true}) {
    SupportedStrip supported(strip(tip_first), JointType::fixed, {0, 400, 60}, 1500);
    solver::State state = test::start(*supported.mechanism);
    const solver::EquilibriumSummary summary = solver::find_equilibrium(*supported.mechanism, state);
    REQUIRE_MESSAGE(summary.solved(), summary.message);
    tip[tip_first] = supported.mechanism->frame_motion(state, supported.tip).X_WF;
  }
  const double angle = std::acos(tip[0].R(0, 0));
  MESSAGE("tip rotated by ", angle, " rad");
  CHECK(angle > 1.2);
  // Two equilibria of one mesh, each to 1e-10 of what its rows balance.
  CHECK((tip[0].r - tip[1].r).norm() < 1e-8);
  CHECK((tip[0].R - tip[1].R).norm() < 1e-8);
}

TEST_CASE("FiniteStrainBetweenFrames_IsThatOfTheMesh") {
  // The same mesh by itself, its end face displaced and rotated like the frame: it needs the same forces.
  const test::Beam beam = strip(false);
  const double moment = 1500;
  SupportedStrip supported(beam, JointType::fixed, {0, 400, 60}, moment);
  solver::State state = test::start(*supported.mechanism);
  REQUIRE(solver::find_equilibrium(*supported.mechanism, state).solved());
  Pose tip = supported.mechanism->frame_motion(state, supported.tip).X_WF;
  tip.r += beam.frame_at(0).r;  // ground's origin is the root's

  const fem::ElasticBody body = beam.elastic();
  std::vector<fem::Support> supports;
  for (const int dof : fem::dofs_of(body.mesh.node_sets.at("x0"))) supports.push_back({dof, 0});
  const Pose rest = beam.frame_at(beam.size.x());
  for (const int node : body.mesh.node_sets.at("x1")) {
    const Vector3 x = body.mesh.nodes[static_cast<std::size_t>(node)];
    const Vector3 u = tip.r + tip.R * (x - rest.r) - x;
    for (int k = 0; k < 3; ++k) supports.push_back({3 * node + k, u[k]});
  }
  const VectorXd weight = fem::gravity_load(body, {0, -9.81, 0});
  const auto whole = verification::solve_large_displacement(body, supports, weight, 40);
  REQUIRE(whole.load == 1);
  fem::FiniteStrain strain;
  fem::finite_strain(body, whole.u, strain);
  Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
  for (const int node : body.mesh.node_sets.at("x1")) {
    const Vector3 f = (strain.force - weight).segment<3>(3 * node);
    force += f;
    torque += (body.mesh.nodes[static_cast<std::size_t>(node)] + whole.u.segment<3>(3 * node) - tip.r).cross(f);
  }
  MESSAGE("force ", force.transpose(), ", torque ", torque.transpose());
  // Forces of a mesh whose end is where a solution to 1e-10 has put it: its stiffness amplifies that.
  CHECK((force - Vector3(0, 400, 60)).norm() < 1e-5 * force.norm());
  CHECK((torque - Vector3(0, 0, moment)).norm() < 1e-5 * moment);
}

TEST_CASE("FiniteStrainBetweenFrames_SwingsTheSameFromEitherFrame") {
  // Fast enough that the tip is bent by a third of a radian; both converge onto one path with the square of the step.
  const auto path = [](bool tip_first, int steps) {
    test::Beam beam = strip(tip_first, 4);
    beam.material.youngs_modulus = 5e8;
    SupportedStrip supported(beam, JointType::revolute, {0, -60, 0}, 0, true);
    solver::State state = test::start(*supported.mechanism);
    test::run(*supported.mechanism, state, 0.3, steps);
    return Vector3(supported.mechanism->frame_motion(state, supported.tip).X_WF.r);
  };
  const double coarse = (path(false, 120) - path(true, 120)).norm(), fine = (path(false, 240) - path(true, 240)).norm();
  MESSAGE("apart by ", coarse, " m and ", fine, " m");
  CHECK(fine < 1e-4);  // 240 steps, second order
  CHECK(fine < 0.4 * coarse);
}

TEST_CASE("FiniteStrainOfAStiffBody_MovesItAsSmallStrainDoes") {
  // The path leads from the static answer to the start, and both strains must have the same: the body is bent by 3e-4
  // of its length.
  const auto path = [](Strain strain, double modulus) {
    test::Beam beam = strip(false, 5);
    beam.strain = strain;
    beam.material.youngs_modulus = modulus;
    beam.damping = {.mass = 2, .stiffness = 1e-5};
    SupportedStrip supported(beam, JointType::revolute, {0, -60, 0}, 0);
    solver::State state = test::start(*supported.mechanism);
    test::run(*supported.mechanism, state, 0.05, 250);
    return Vector3(supported.mechanism->frame_motion(state, supported.tip).X_WF.r);
  };
  const Vector3 small = path(Strain::small, 1e11);
  const double bent = (path(Strain::small, 1e13) - small).norm(), apart = (path(Strain::finite, 1e11) - small).norm();
  MESSAGE("bent by ", bent, " m, apart by ", apart, " m");
  CHECK(bent > 1e-5);
  CHECK(apart < 1e-3 * bent);  // strain of the second order
}

TEST_CASE("FiniteStrainBetweenFrames_BalancesPowers") {
  // Let go level and straight: it swings, and its tip, undeformed at the start, swings about the bent strip.
  test::Beam beam = strip(false, 5);
  beam.material.youngs_modulus = 5e8;
  beam.damping = {.mass = 0, .stiffness = 1e-4};
  SupportedStrip supported(beam, JointType::revolute, {0, 0, 0}, 0, true);
  solver::State state = test::start(*supported.mechanism);
  const auto energy = [&](const solver::State& at) { return supported.mechanism->observe(at).elastics[0].energy; };
  const auto stored = [](const ElasticEnergy& e) { return e.kinetic + e.strain + e.potential; };
  const ElasticEnergy first = energy(state);
  double lost = 0, before = first.dissipation, moved = 0;
  const double dt = 0.3 / 400;
  test::run(*supported.mechanism, state, 0.3, 400, 0.95, [&](const solver::State& now) {
    const ElasticEnergy e = energy(now);
    lost += 0.5 * dt * (before + e.dissipation);
    before = e.dissipation;
    moved = std::max(moved, e.kinetic);
    // Newton's tolerance is 1e-9 of the forces.
    CHECK(std::abs(e.kinetic_rate + e.strain_rate + e.dissipation - e.gravity) < 1e-6 * moved / dt);
  });
  const ElasticEnergy last = energy(state);
  MESSAGE("kinetic energy ", last.kinetic, " J, strain ", last.strain, ", lost ", lost, ", unaccounted ",
          stored(last) + lost - stored(first));
  CHECK(last.strain > 1e-4 * last.kinetic);
  CHECK(std::abs(stored(last) + lost - stored(first)) < 1e-5 * last.kinetic);  // 400 steps, second order
}

TEST_CASE("FiniteStrain_DampingIsIndependentOfARotationOfAnEnd") {
  // A body that is bent and rotates rigidly against its first frame dissipates nothing but by further bending: the
  // power of the damping forces in a rigid motion of all nodes is nothing.
  const test::Beam beam = strip(false);
  const fem::ElasticBody body = beam.elastic();
  VectorXd u(body.size()), rotating(body.size());
  const Vector3 omega{0.3, -0.7, 1.1};
  for (Index i = 0; i < body.node_count(); ++i) {
    const Vector3 x = body.mesh.nodes[static_cast<std::size_t>(i)];
    u.segment<3>(3 * i) = Vector3(-0.2 * x.x() * x.x(), 0.5 * x.x() * x.x(), 0.1 * x.x() * x.y());
    rotating.segment<3>(3 * i) = omega.cross(x + u.segment<3>(3 * i));
  }
  fem::FiniteStrain strain, other;
  VectorXd stretching = u;
  fem::finite_strain(body, u, strain, false, &rotating);
  fem::finite_strain(body, u, other, false, &stretching);
  CHECK(strain.rate.norm() < 1e-9 * other.rate.norm());  // round-off of strains that vanish
  CHECK(stretching.dot(other.rate) > 0);
}

TEST_CASE("FiniteStrainBetweenFrames_DerivativesMatchFiniteDifferences") {
  const test::Beam beam = strip(false);
  const std::shared_ptr<NodalBody> body = beam.all_nodes();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&](double rotation, double shift) {
    Vector6 v;
    for (Index i = 0; i < 6; ++i) v[i] = (i < 3 ? rotation : shift) * uniform(random);
    return v;
  };
  ElasticMotion motion;
  motion.frames.resize(2);
  const Pose base = test::pose({0.7, -1.2, 0.4}, {0.5, 2, -1});
  motion.frames[0].X_WF = base;
  motion.frames[1].X_WF = base * body->rest_pose(1) * pose_exp(vector(0.02, 2e-3));
  ElasticResponse response;
  body->begin_step(motion, 0);
  body->evaluate(motion, false, response);
  body->accept_step(motion);  // bent, so that the step's matrix is that of the bent body
  const double dt = 2e-4;
  for (ElasticFrame& frame : motion.frames) frame.V = vector(0.5, 0.2), frame.A = vector(300, 200);
  body->begin_step(motion, dt);
  motion.stage = {.dt = dt, .k = 1, .c = 2 / dt, .m = 4 / (dt * dt)};
  for (int repeat = 0; repeat < 30; ++repeat) body->evaluate(motion, true, response);
  CHECK(body->internal_residual() < 1e-9);  // thirty solutions: its limit
  MatrixXd exact(12, 12);
  for (Index i = 0; i < 12; ++i) {
    const auto at = [&](double step) {
      ElasticMotion moved = motion;
      ElasticFrame& frame = moved.frames[static_cast<std::size_t>(i / 6)];
      frame.X_WF = frame.X_WF * pose_exp(step * Vector6::Unit(i % 6));
      frame.V[i % 6] += motion.stage.c * step;
      frame.A[i % 6] += motion.stage.m * step;
      ElasticResponse there;
      for (int repeat = 0; repeat < 10; ++repeat) body->evaluate(moved, false, there);
      return there.force;
    };
    constexpr double unit = 1e-8;
    exact.col(i) = (at(unit) - at(-unit)) / (2 * unit);
  }
  const MatrixXd J = response.K + motion.stage.c * response.C + motion.stage.m * response.M;
  const double wrong = (J.partialPivLu().solve(exact) - MatrixXd::Identity(12, 12)).eigenvalues().cwiseAbs().maxCoeff();
  MESSAGE("wrong share of an increment ", wrong);
  CHECK(wrong < 0.05);
}

}  // namespace finite_frames_test
}  // namespace hersey::mbd
