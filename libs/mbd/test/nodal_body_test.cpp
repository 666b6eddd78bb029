// Bodies with a displacement of every node: against modal bodies with every mode, statics, derivatives, convergence.
#include "hersey/mbd/nodal_body.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "elastic_large_displacement.h"
#include "flexible_beam.h"
#include "hersey/fem/load_vectors.h"
#include "hersey/mbd/mechanism_builder.h"
#include "hersey/solver/equilibrium.h"
#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace nodal_body_test {

constexpr double kNewton = 1e-9;  // m: Newton's tolerance, over 1e-9 of the forces

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A beam hinged at its root and pushed at its tip, in ground's axes; where the tip is at the end.
Vector3 pushed(const test::Beam& beam) {
  MechanismBuilder b;
  const FlexibleBodyIds ids = beam.add_to(b);
  b.add_joint({.name = "hinge",
               .type = JointType::revolute,
               .inboard = b.frame_of(b.ground()),
               .outboard = b.add_frame({.name = "root", .body = ids.bodies[0], .X_BF = beam.frame_at(0)}),
               .initial = {0.3}});
  LoadTerm term;
  term.direction << 0, 0, 0, 300, 2000, 500;
  term.magnitude = std::make_shared<test::Quadratic>(0, 1, 0);
  term.variables = {{.kind = Variable::Kind::time, .coordinate = {}}};
  b.add_load({.name = "push", .frame = ids.frames[1], .axes = LoadAxes::ground, .terms = {term}});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  test::run(*m, state, 0.2, 400);
  return m->frame_motion(state, ids.frames[1]).X_WF.r;
}

TEST_CASE("NodalBody_MovesAsTheModalBodyWithEveryVibration") {
  // 12 free nodes have 36 vibrations; averages leave 48 of 60. Both integrate alike, so only Newton's tolerance is
  // between them.
  for (const fem::Connection connection : {fem::Connection::rigid, fem::Connection::average}) {
    test::Beam beam{.cells = {4, 1, 1}, .tip = true, .connection = connection};
    beam.modes = 100;
    beam.damping = {.mass = 3, .stiffness = 1e-5};
    beam.material.youngs_modulus = 2e9;
    const Vector3 modal = pushed(beam);
    beam.nodal = true;
    const Vector3 nodal = pushed(beam);
    beam.modes = 0;
    beam.nodal = false;
    CHECK((pushed(beam) - modal).norm() > 1e-6);  // the vibrations have an effect
    CHECK((nodal - modal).norm() < kNewton);
  }
}

TEST_CASE("NodalBodyWithFilmModes_MovesAsTheModalBodyWithEveryVibration") {
  // Coordinates for the answers to pressures on one side are only other coordinates: nothing else may change.
  for (const fem::Connection connection : {fem::Connection::rigid, fem::Connection::average}) {
    test::Beam beam{.cells = {4, 1, 1}, .tip = true, .connection = connection};
    beam.modes = 100;
    beam.damping = {.mass = 3, .stiffness = 1e-5};
    beam.material.youngs_modulus = 2e9;
    const Vector3 modal = pushed(beam);
    beam.nodal = beam.contact = true;
    const auto body = beam.all_nodes();
    CHECK(body->coordinate_count() > 3);
    CHECK(body->coordinate_count() < 12);
    CHECK((pushed(beam) - modal).norm() < kNewton);
  }
}

TEST_CASE("NodalBody_SagsLikeItsMesh") {
  test::Beam beam{.cells = {6, 2, 2}, .tip = true, .connection = fem::Connection::average};
  beam.nodal = true;
  const Vector3 g{0, -9.81, 4};
  MechanismBuilder b;
  b.set_gravity(g);
  const FlexibleBodyIds ids = beam.add_to(b);
  b.add_joint(
      {.name = "clamp", .type = JointType::fixed, .inboard = b.frame_of(b.ground()), .outboard = ids.frames[0]});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  const solver::EquilibriumSummary summary = solver::find_equilibrium(*m, state);
  REQUIRE_MESSAGE(summary.solved(), summary.message);

  const fem::ElasticBody body = beam.elastic();
  const fem::FrameSupports supports = fem::frame_supports(
      body.mesh, {{"root", beam.frame_at(0).r, body.mesh.node_sets.at("x0"), fem::Connection::average, {}}});
  fem::ConstrainedStiffness constrained(body.K, body.m, supports.fixed_dofs, supports.C);
  REQUIRE(constrained.factorise().solved());
  const VectorXd u = constrained.solve(fem::gravity_load(body, g));
  Vector6 tip = fem::frame_motion(body.mesh, {"tip", beam.frame_at(1).r, body.mesh.node_sets.at("x1"), {}, {}}) * u;
  const Vector3 found = m->frame_motion(state, ids.frames[1]).X_WF.r - beam.frame_at(1).r;
  // The body's axes rotate as it sags: of second order.
  CHECK((found - tip.tail<3>()).norm() < 1e-5 * tip.tail<3>().norm());
}

/// Frames that rotate, move and deform the body as machines do: 20 rad/s, 10 m/s, strains of 1e-4.
ElasticMotion brisk_motion(const NodalBody& body) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&](double rotation, double shift) {
    Vector6 v;
    for (Index i = 0; i < 6; ++i) v[i] = (i < 3 ? rotation : shift) * uniform(random);
    return v;
  };
  ElasticMotion motion;
  const Pose base = test::pose({0.7, -1.2, 0.4}, {0.5, 2, -1});
  for (int i = 0; i < body.frame_count(); ++i) {
    ElasticFrame frame;
    frame.X_WF = base * body.rest_pose(i) * pose_exp(i == 0 ? Vector6::Zero() : vector(1e-4, 1e-4));
    frame.V = vector(20, 10);
    frame.A = vector(1000, 500);
    motion.frames.push_back(frame);
  }
  return motion;
}

/// Derivative of the settled forces by finite differences of positions, velocities or accelerations.
enum class Moved { position, velocity, acceleration };
MatrixXd differences(NodalBody& body, const ElasticMotion& motion, Moved what, double unit) {
  const Index n = 6 * body.frame_count();
  MatrixXd derivative(n, n);
  for (Index i = 0; i < n; ++i) {
    const auto at = [&](double step) {
      ElasticMotion moved = motion;
      ElasticFrame& frame = moved.frames[static_cast<std::size_t>(i / 6)];
      if (what == Moved::position) frame.X_WF = frame.X_WF * pose_exp(step * Vector6::Unit(i % 6));
      if (what == Moved::velocity) frame.V[i % 6] += step;
      if (what == Moved::acceleration) frame.A[i % 6] += step;
      ElasticResponse response;
      for (int repeat = 0; repeat < 3; ++repeat) body.evaluate(moved, false, response);
      return response.force;
    };
    derivative.col(i) = (at(unit) - at(-unit)) / (2 * unit);
  }
  return derivative;
}

TEST_CASE("NodalBody_DerivativesOfItsCondensedForcesMatchFiniteDifferences") {
  // Their answer is sought among few columns, which are nearly all of it.
  test::Beam beam{.size = {0.3, 0.05, 0.03}, .cells = {4, 1, 1}, .tip = true};
  const std::shared_ptr<NodalBody> body = beam.all_nodes();
  ElasticMotion motion = brisk_motion(*body);
  const double dt = 2e-4;
  body->begin_step(motion, dt);
  motion.stage = {.dt = dt, .k = 1, .c = 2 / dt, .m = 4 / (dt * dt)};
  ElasticResponse response;
  for (int repeat = 0; repeat < 3; ++repeat) body->evaluate(motion, true, response);
  CHECK(body->internal_residual() < 1e-9);  // Newton's tolerance of the nodes
  const auto whole = [&](const MatrixXd& K, const MatrixXd& C, const MatrixXd& M) {
    return MatrixXd(K + motion.stage.c * C + motion.stage.m * M);
  };
  const MatrixXd exact =
      whole(differences(*body, motion, Moved::position, 1e-9), differences(*body, motion, Moved::velocity, 1e-4),
            differences(*body, motion, Moved::acceleration, 1e-1));
  const MatrixXd J = whole(response.K, response.C, response.M);
  // Relative error of a Newton increment with and without the response of the nodes.
  const auto wrong = [&](const MatrixXd& tangent) {
    return (tangent.partialPivLu().solve(exact) - MatrixXd::Identity(12, 12)).eigenvalues().cwiseAbs().maxCoeff();
  };
  const double with_nodes = wrong(J);
  motion.stage.k = 0;  // the nodes are looked at, not moved
  body->evaluate(motion, true, response);
  const double without = wrong(whole(response.K, response.C, response.M));
  MESSAGE("wrong share of an increment ", with_nodes, ", without the nodes' answer ", without);
  CHECK(with_nodes < 1e-6);  // what the answer sought among few columns leaves, of order omega dt squared
  CHECK(without > 0.1);
}

/// Displacement of the middle of a cantilever's end under forces on the nodes there, rotating about z.
Vector3 bent(const test::Beam& beam, const Vector3& force, double omega = 0) {
  MechanismBuilder b;
  const std::shared_ptr<NodalBody> body = beam.all_nodes();
  const FlexibleBodyIds ids = b.add_flexible_body("beam", {}, body);
  const JointId hinge = b.add_joint({.name = "hinge",
                                     .type = JointType::revolute,
                                     .inboard = b.frame_of(b.ground()),
                                     .outboard = ids.frames[0],
                                     .initial = {0.0},
                                     .initial_rate = {omega}});
  b.add_drive(
      {.name = "brake", .coordinate = {hinge, 0}, .kind = DriveSpec::Kind::speed, .function = test::constant(omega)});
  const std::vector<int>& end = body->mesh_body().mesh.node_sets.at("x1");
  const auto share = 1 / static_cast<double>(end.size());
  NodalLoad load{
      .name = "push", .axes = LoadAxes::ground, .forces = Eigen::Matrix3Xd::Zero(3, body->mesh_body().node_count())};
  for (const int node : end) load.forces.col(node) = share * force;
  b.add_nodal_load(ids.elastic, load, test::constant(1));
  const auto m = b.finalise();
  const solver::State state = test::start(*m);
  const VectorXd u = body->displacements(m->observe(state).elastics[0].motion, {});
  CHECK(body->internal_residual() < 1e-9);  // Newton's tolerance of the nodes
  Vector3 tip = Vector3::Zero();
  for (const int node : end) tip += share * u.segment<3>(3 * node);
  return tip;
}

TEST_CASE("NodalBodyOfFiniteStrain_BendsLikeItsMesh") {
  // Deflected by a quarter of its length.
  test::Beam beam{.size = {1, 0.05, 0.05}, .cells = {10, 1, 1}};
  beam.material.youngs_modulus = 2e9;
  const Vector3 force{0, -800, 0};
  const Vector3 small = bent(beam, force);
  beam.strain = Strain::finite;
  const Vector3 finite = bent(beam, force);
  const fem::ElasticBody body = beam.elastic();
  std::vector<fem::Support> supports;
  for (const int dof : fem::dofs_of(body.mesh.node_sets.at("x0"))) supports.push_back({dof, 0});
  VectorXd f = VectorXd::Zero(body.size());
  const std::vector<int>& end = body.mesh.node_sets.at("x1");
  for (const int node : end) f.segment<3>(3 * node) = force / static_cast<double>(end.size());
  const auto whole = verification::solve_large_displacement(body, supports, f);
  REQUIRE(whole.load == 1);
  Vector3 tip = Vector3::Zero();
  for (const int node : end) tip += whole.u.segment<3>(3 * node) / static_cast<double>(end.size());
  MESSAGE("tip ", finite.transpose(), ", the mesh's ", tip.transpose(), ", small strains ", small.transpose());
  CHECK((finite - tip).norm() < 1e-7 * tip.norm());  // two equilibria of one mesh, each to 1e-10 of its size
  CHECK((small - tip).norm() > 0.05 * tip.norm());
}

TEST_CASE("NodalBodyOfFiniteStrain_IsStiffenedBySpin") {
  // Out of its plane of rotation a uniform blade bends like its first mode nearly, omega_f^2 = omega_0^2 + 1.193
  // omega^2 (Southwell's coefficient of the blade hinged at its hub's centre, Leissa 1981).
  test::Beam beam{.size = {1, 0.05, 0.05}, .cells = {10, 1, 1}};
  beam.material.youngs_modulus = 2e9;
  const double omega_0 = 3.51602 * std::sqrt(beam.material.youngs_modulus / beam.material.density / 12) * 0.05;
  const Vector3 force{0, 0, 5};
  beam.strain = Strain::finite;
  const double ratio = bent(beam, force, omega_0).z() / bent(beam, force).z();
  MESSAGE("deflection in rotation over that at rest ", ratio);
  CHECK(ratio == doctest::Approx(1 / (1 + 1.193)).epsilon(0.03));
  beam.strain = Strain::small;
  // Small strains have no stiffening: the difference is of second order.
  CHECK(bent(beam, force, 0.3 * omega_0).z() == doctest::Approx(bent(beam, force).z()).epsilon(1e-3));
}

TEST_CASE("NodalBodyOfFiniteStrain_BalancesPowersAsItSwings") {
  test::Beam beam{.size = {1, 0.05, 0.05}, .cells = {6, 1, 1}};
  beam.material.youngs_modulus = 5e8;
  beam.damping.stiffness = 1e-4;
  beam.nodal = true;
  beam.strain = Strain::finite;
  MechanismBuilder b;
  b.set_gravity({0, -9.81, 0});
  const FlexibleBodyIds ids = beam.add_to(b);
  b.add_joint({.name = "hinge",
               .type = JointType::revolute,
               .inboard = b.frame_of(b.ground()),
               .outboard = b.add_frame({.name = "root", .body = ids.bodies[0], .X_BF = beam.frame_at(0)}),
               .initial = {0.0}});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  const auto stored = [](const ElasticEnergy& e) { return e.kinetic + e.strain + e.potential; };
  const ElasticEnergy first = m->observe(state).elastics[0].energy;
  double lost = 0, before = first.dissipation, moved = 0;
  const double dt = 0.3 / 300;
  test::run(*m, state, 0.3, 300, 0.95, [&](const solver::State& now) {
    const ElasticEnergy e = m->observe(now).elastics[0].energy;
    lost += 0.5 * dt * (before + e.dissipation);
    before = e.dissipation;
    moved = std::max(moved, e.kinetic);
    // Newton's tolerance is 1e-9 of the forces.
    CHECK(std::abs(e.kinetic_rate + e.strain_rate + e.dissipation - e.gravity) < 1e-6 * moved / dt);
  });
  const ElasticEnergy last = m->observe(state).elastics[0].energy;
  MESSAGE("kinetic energy ", last.kinetic, " J, strain ", last.strain, ", lost ", lost, ", unaccounted ",
          stored(last) + lost - stored(first));
  CHECK(last.strain > 1e-4 * last.kinetic);
  CHECK(std::abs(stored(last) + lost - stored(first)) < 1e-5 * last.kinetic);  // 300 steps, second order
}

}  // namespace nodal_body_test
}  // namespace hersey::mbd
