// Conservation laws for all mechanisms: momentum, energy and power, and independence of the observer.
#include <doctest/doctest.h>

#include <cmath>

#include "hersey/mbd/mechanism_builder.h"
#include "mechanisms_top.h"
#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace conservation_test {

using Eigen::VectorXd;

TEST_CASE("SymmetricTop_FollowsTorqueFreeRotation") {
  const verification::SymmetricTop exact{0.3, 0.5, {0.8, -0.4, 3.0}};
  const auto run = [&](int steps, double& momentum_error) {
    MechanismBuilder b;
    const BodyId top =
        b.add_body({.name = "top", .mass = 2, .inertia = Vector3(exact.A, exact.A, exact.C).asDiagonal()});
    b.add_joint({.name = "flight",
                 .type = JointType::free,
                 .inboard = b.frame_of(b.ground()),
                 .outboard = b.frame_of(top),
                 .initial = {1, 2, 3, 0, 0, 0},
                 .initial_rate = {0.1, 0.2, 0.3, exact.omega.x(), exact.omega.y(), exact.omega.z()}});
    const auto m = b.finalise();
    solver::State state = test::start(*m);
    test::run(*m, state, 4, steps, 0.9);
    const FrameMotion observation = m->observe(state).bodies[top.index];
    const Vector3 H =
        observation.X_WF.R *
        Vector3(exact.A, exact.A, exact.C).cwiseProduct(observation.X_WF.R.transpose() * observation.omega);
    const Vector3 H0(exact.A * exact.omega.x(), exact.A * exact.omega.y(), exact.C * exact.omega.z());
    momentum_error = (H - H0).norm() / H0.norm();
    // Free flight, which steps have exactly but for round-off.
    CHECK((observation.X_WF.r - Vector3(1.4, 2.8, 4.2)).norm() < 1e-10);
    return rotation_log(Eigen::Quaterniond(exact.orientation(4).transpose() * observation.X_WF.R)).norm();
  };
  double momentum_coarse = 0, momentum_fine = 0;
  const double coarse = run(800, momentum_coarse), fine = run(1600, momentum_fine);
  MESSAGE("orientation error ", fine, " rad, momentum error ", momentum_fine);
  CHECK(std::abs(std::log2(coarse / fine) - 2) < 0.05);
  CHECK(momentum_fine < 1e-4);  // 1600 steps, second order
  CHECK(std::abs(std::log2(momentum_coarse / momentum_fine) - 2) < 0.1);
}

/// Two bodies floating in space, joined and pushed by internal forces only.
TEST_CASE("InternalForces_ConserveMomentum") {
  MechanismBuilder b;
  Matrix3 J;
  J << 0.11, 0.01, 0.02, 0.01, 0.13, -0.015, 0.02, -0.015, 0.09;
  std::vector<BodyId> bodies;
  for (const char* name : {"one", "two", "three"})
    bodies.push_back(b.add_body({.name = name, .mass = 1.5, .com = {0.1, 0, 0.05}, .inertia = J}));
  const auto at = [&](BodyId id, const Vector3& r) {
    return b.add_frame({.name = "f", .body = id, .X_BF = test::pose({0.1, 0.2, -0.3}, r)});
  };
  b.add_joint({.name = "hinge",
               .type = JointType::spherical,
               .inboard = at(bodies[0], {0.3, 0, 0}),
               .outboard = at(bodies[1], {-0.2, 0.1, 0}),
               .initial = {0.2, 0.4, -0.3},
               .initial_rate = {1, -2, 0.5}});
  b.add_force("spring", at(bodies[1], {0.1, 0.3, 0}), at(bodies[2], {0, 0.2, 0.4}),
              std::make_shared<SpringDamper>(50, 1, 0.1));
  b.add_force("bushing", at(bodies[0], {0.1, 0.3, 0}), at(bodies[2], {0, 0.2, 0.4}),
              std::make_shared<test::FullBushing>());
  const auto m = b.finalise();
  CHECK(m->nv() == 6 + 3 + 6);  // two automatic free joints
  solver::State state = test::start(*m);
  // Theory: d/dt of the momentum about a fixed point vanishes. The accelerations give it exactly, without integration.
  Vector6 rate = Vector6::Zero();
  const Observation observation = m->observe(state);
  double size = 0;
  for (BodyId id : bodies) {
    const FrameMotion& f = observation.bodies[id.index];
    const Vector3 c = f.X_WF.R * Vector3(0.1, 0, 0.05);
    const Vector3 a = f.a + f.alpha.cross(c) + f.omega.cross(f.omega.cross(c));
    const Matrix3 I = f.X_WF.R * J * f.X_WF.R.transpose();
    rate.tail<3>() += 1.5 * a;
    rate.head<3>() += I * f.alpha + f.omega.cross(I * f.omega) + 1.5 * (f.X_WF.r + c).cross(a);
    size = std::max(size, 1.5 * a.norm());
  }
  CHECK(size > 1);
  CHECK(rate.norm() < 1e-11 * size);  // round-off of accelerations
}

TEST_CASE("EnergyChangesByThePowersReported") {
  // Along the motion of the nasty mechanism, d(kinetic + potential + spring energy)/dt equals what loads and drives put
  // in and what springs, dampers and forces take out; their stored energies are taken out of their powers' sum.
  const auto m = test::nasty_mechanism();
  solver::State state = m->initial_state();
  const solver::InitialiseSummary summary = solver::initialise(*m, state);
  INFO(summary.message);
  REQUIRE(summary.solved());
  const auto mechanical = [&](double s) {
    solver::State moved = state;
    moved.t += s;
    m->retract(state.q, s * state.v + 0.5 * s * s * state.vdot, moved.q);
    moved.v = state.v + s * state.vdot;
    const Observation observation = m->observe(moved);
    double strain = 0;
    for (const ElasticObservation& body : observation.elastics) strain += body.energy.strain;
    return observation.kinetic_energy + observation.potential_energy + strain;
  };
  constexpr double step = 1e-4;  // central difference, Richardson's weights: error ~ step^4
  const double slope =
      (8 * (mechanical(step) - mechanical(-step)) - (mechanical(2 * step) - mechanical(-2 * step))) / (12 * step);
  const Observation observation = m->observe(state);
  double power = 0, size = 0;
  for (const ElasticObservation& body : observation.elastics) power -= body.energy.dissipation;
  for (const auto* powers : {&observation.drive_powers, &observation.load_powers, &observation.spring_powers,
                             &observation.force_powers, &observation.coordinate_force_powers})
    for (double p : *powers) {
      power += p;
      size = std::max(size, std::abs(p));
    }
  for (const ElasticLoad& load : observation.elastics[0].energy.loads) power += load.power;
  CHECK(size > 1);
  // The Taylor polynomial leaves the true motion at third order, so kinetic energy is off by step^2 only at the ends.
  CHECK(std::abs(slope - power) < 1e-6 * size);
}

/// A driven arm with a bob on a spring, mounted on ground or on a carriage, in axes with the pose `X_WG`.
VectorXd arm_on_ground(const Pose& X_WG, const Vector3& carriage_velocity, bool carriage) {
  MechanismBuilder b;
  b.set_gravity(X_WG.R * Vector3(0, -9.81, 0));
  const FrameId mount = b.add_frame({.name = "mount", .body = b.ground(), .X_BF = X_WG});
  FrameId base = mount;
  JointId rail;
  if (carriage) {
    const BodyId cart = b.add_body({.name = "cart", .mass = 3, .inertia = Matrix3::Identity()});
    rail = b.add_joint({.name = "rail",
                        .type = JointType::prismatic,
                        .inboard = mount,
                        .outboard = b.frame_of(cart),
                        .axis = carriage_velocity.normalized(),
                        .initial = {0.0}});
    b.add_drive({.name = "tow",
                 .coordinate = {rail, 0},
                 .kind = DriveSpec::Kind::speed,
                 .function = test::constant(carriage_velocity.norm())});
    base = b.frame_of(cart);
  }
  const BodyId arm =
      b.add_body({.name = "arm", .mass = 1, .com = {0.2, 0, 0}, .inertia = Vector3(0.01, 0.1, 0.1).asDiagonal()});
  const BodyId bob = b.add_body({.name = "bob", .mass = 0.5, .inertia = Vector3(0.01, 0.02, 0.03).asDiagonal()});
  const JointId hinge = b.add_joint({.name = "hinge",
                                     .type = JointType::revolute,
                                     .inboard = base,
                                     .outboard = b.frame_of(arm),
                                     .axis = {0, 0.6, 0.8},
                                     .initial = {0.3},
                                     .initial_rate = {2}});
  const JointId ball =
      b.add_joint({.name = "ball",
                   .type = JointType::spherical,
                   .inboard = b.add_frame({.name = "tip", .body = arm, .X_BF = {Matrix3::Identity(), {0.4, 0, 0}}}),
                   .outboard = b.add_frame({.name = "top", .body = bob, .X_BF = {Matrix3::Identity(), {0, 0.3, 0}}}),
                   .initial = {0.1, -0.2, 0.4},
                   .initial_rate = {0.5, 1, -2}});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  test::run(*m, state, 0.5, 100, 0.8);
  const Observation observation = m->observe(state);
  VectorXd answer(1 + 3 + 3 + 3);
  answer << observation.joints[hinge.index].position[0], Vector3::Map(observation.joints[ball.index].position.data()),
      observation.joints[hinge.index].force, observation.joints[ball.index].force;
  return answer;
}

TEST_CASE("Ground_HasNoPreferredOriginAxesOrSpeed") {
  const VectorXd here = arm_on_ground({}, Vector3::Zero(), false);
  // Newton's tolerance is 1e-9 of each row's terms; lever arms to the origin enlarge it by a decade.
  const double tolerance = 1e-7 * here.cwiseAbs().maxCoeff();
  CHECK((arm_on_ground({Matrix3::Identity(), {0, 0, 0}}, {3, -2, 1}, true) - here).cwiseAbs().maxCoeff() < tolerance);
  CHECK((arm_on_ground(test::pose({0.4, -1.1, 0.7}, {2, -3, 1}), Vector3::Zero(), false) - here).cwiseAbs().maxCoeff() <
        tolerance);
}

}  // namespace conservation_test
}  // namespace hersey::mbd
