// Joints that couple rotations and translations, and couplings between joints, against closed forms.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "hersey/mbd/mechanism_builder.h"
#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace coupling_test {

constexpr double kNewton = 1e-8;  // Newton's tolerance is 1e-9 of the forces

constexpr double kPi = std::numbers::pi;

JointId hinge(MechanismBuilder& b, const char* name, BodyId body, double initial = 0) {
  return b.add_joint({.name = name,
                      .type = JointType::revolute,
                      .inboard = b.frame_of(b.ground()),
                      .outboard = b.frame_of(body),
                      .initial = {initial}});
}

BodyId wheel(MechanismBuilder& b, const char* name, double J) {
  return b.add_body({.name = name, .mass = 1, .inertia = Vector3(J, J, J).asDiagonal()});
}

void torque_about_z(MechanismBuilder& b, BodyId body, double torque) {
  b.add_load({.name = "torque",
              .frame = b.frame_of(body),
              .axes = LoadAxes::ground,
              .terms = {{(Vector6() << 0, 0, 1, 0, 0, 0).finished(), test::constant(torque), {}}}});
}

TEST_CASE("CardanJoint_RotatesUnevenlyByTheClosedForm") {
  // Shafts at an angle beta through the centre of the cross: tan(out) = cos(beta) tan(in). Their bearings hold the
  // centre already, so the cross's three positions are redundant.
  const double beta = 0.5;
  MechanismBuilder b;
  const BodyId in = wheel(b, "in", 0.1), out = wheel(b, "out", 0.2);
  const JointId input = hinge(b, "input", in);
  b.add_joint({.name = "output",
               .type = JointType::revolute,
               .inboard = b.add_frame({.name = "f", .body = b.ground(), .X_BF = test::pose({beta, 0, 0}, {0, 0, 0})}),
               .outboard = b.frame_of(out)});
  const JointId cross = b.add_joint(
      {.name = "cross", .type = JointType::universal, .inboard = b.frame_of(in), .outboard = b.frame_of(out)});
  b.add_drive(
      {.name = "motor", .coordinate = {input, 0}, .kind = DriveSpec::Kind::speed, .function = test::constant(10)});
  const auto m = b.finalise();
  REQUIRE(m->redundancies().size() == 1);
  CHECK(m->redundancies()[0].positions == 3);
  solver::State state = test::start(*m);
  double worst = 0, worst_pose = 0;
  test::run(*m, state, 0.5, 500, 0.8, [&](const solver::State& s) {
    const Observation observation = m->observe(s);
    const double phi = observation.joints[0].position[0], psi = observation.joints[1].position[0];
    worst = std::max(worst, std::abs(std::cos(phi) * std::sin(psi) - std::cos(beta) * std::sin(phi) * std::cos(psi)));
    // The angles read off the closing joint are those that lead from one shaft to the other.
    const JointValues& angles = observation.joints[cross.index].position;
    const Pose across = joint_pose(JointType::universal, {0, 0, 1}, {angles.data(), 2});
    worst_pose = std::max(worst_pose, (observation.bodies[1].X_WF.R * across.R - observation.bodies[2].X_WF.R).norm());
  });
  // Constraints are satisfied to round-off of their terms.
  CHECK(worst < 1e-11);
  CHECK(worst_pose < 1e-11);
}

TEST_CASE("NutOnAScrew_FallsByTheClosedForm") {
  // m g h = (J + m h^2) q'' with h the travel per radian; the screw in the tree, or closing a loop.
  const double mass = 2, J = 0.03, lead = 0.2, h = lead / (2 * kPi), g = 9.81;
  for (bool closing : {false, true}) {
    CAPTURE(closing);
    MechanismBuilder b;
    b.set_gravity({0, 0, -g});
    const BodyId nut = b.add_body({.name = "nut", .mass = mass, .inertia = Vector3(J, J, J).asDiagonal()});
    if (closing)
      b.add_joint({.name = "guide",
                   .type = JointType::cylindrical,
                   .inboard = b.frame_of(b.ground()),
                   .outboard = b.frame_of(nut),
                   .initial = {0, 0}});
    const JointId screw = b.add_joint({.name = "screw",
                                       .type = JointType::screw,
                                       .inboard = b.frame_of(b.ground()),
                                       .outboard = b.frame_of(nut),
                                       .lead = lead});
    const auto m = b.finalise();
    CHECK(m->nv() - m->nlambda() == 1);
    solver::State state = test::start(*m);
    test::run(*m, state, 1, 100, 0.8);
    const double acceleration = -mass * g * h / (J + mass * h * h);
    const Observation observation = m->observe(state);
    CHECK(observation.joints[screw.index].position[0] ==
          doctest::Approx(0.5 * acceleration).epsilon(1e-8));  // several revolutions
    CHECK(observation.bodies[1].X_WF.r.z() == doctest::Approx(0.5 * acceleration * h).epsilon(kNewton));
    CHECK(std::abs(acceleration) > 4 * kPi);
  }
}

TEST_CASE("GearPair_SharesTheTorqueByItsRatio") {
  const double J1 = 0.3, J2 = 0.05, ratio = -2.5, torque = 4;
  MechanismBuilder b;
  const BodyId one = wheel(b, "one", J1), two = wheel(b, "two", J2);
  const JointId first = hinge(b, "first", one, 0.2), second = hinge(b, "second", two);
  torque_about_z(b, one, torque);
  b.add_coupling({.name = "mesh",
                  .output = {second, 0},
                  .terms = {{{first, 0}, std::make_shared<test::Quadratic>(-ratio * 0.2, ratio, 0)}}});
  const auto m = b.finalise();
  CHECK(m->name_of_row(2) == "coupling mesh");
  solver::State state = test::start(*m);
  test::run(*m, state, 1, 50, 0.8);
  const double acceleration = torque / (J1 + ratio * ratio * J2);
  const Observation observation = m->observe(state);
  // Constant acceleration, which the method has exactly; Newton's tolerance.
  CHECK(state.q[0] == doctest::Approx(0.2 + 0.5 * acceleration).epsilon(1e-9));
  CHECK(state.q[1] == doctest::Approx(ratio * 0.5 * acceleration).epsilon(1e-9));
  CHECK(observation.coupling_efforts[0] == doctest::Approx(J2 * ratio * acceleration).epsilon(kNewton));
  CHECK(observation.joints[0].torque.norm() <
        1e-8);                                  // gears act inside the joints: ideal bearings feel nothing about z
  CHECK(observation.constraint_drift < 1e-11);  // constraints are satisfied to round-off of their terms
}

TEST_CASE("Differential_AddsUpItsInputs") {
  // cage = (left + right)/2: with the cage fixed, both sides rotate in opposite directions.
  MechanismBuilder b;
  const BodyId left = wheel(b, "left", 0.1), right = wheel(b, "right", 0.3), cage = wheel(b, "cage", 1);
  const JointId l = hinge(b, "l", left), r = hinge(b, "r", right), c = hinge(b, "c", cage);
  const auto half = std::make_shared<test::Quadratic>(0, 0.5, 0);
  b.add_coupling({.name = "gears", .output = {c, 0}, .terms = {{{l, 0}, half}, {{r, 0}, half}}});
  b.add_drive({.name = "brake", .coordinate = {c, 0}, .function = test::constant(0)});
  torque_about_z(b, left, 2);
  const auto m = b.finalise();
  const solver::State state = test::start(*m);
  CHECK(state.vdot[0] == doctest::Approx(2 / 0.4));
  CHECK(state.vdot[1] == doctest::Approx(-2 / 0.4));
}

TEST_CASE("Cam_LiftsItsFollowerByTheRelation") {
  // y = 0.02 (1 - cos 3 theta) at constant speed: force m (y'' + g), torque the force times dy/dtheta.
  const double omega = 8, mass = 1.5;
  MechanismBuilder b;
  b.set_gravity({0, 0, -9.81});
  const BodyId shaft = wheel(b, "shaft", 0.1),
               tappet = b.add_body({.name = "tappet", .mass = mass, .inertia = Matrix3::Identity()});
  const JointId rotation = hinge(b, "rotation", shaft);
  const JointId lift = b.add_joint({.name = "lift",
                                    .type = JointType::prismatic,
                                    .inboard = b.frame_of(b.ground()),
                                    .outboard = b.frame_of(tappet)});
  b.add_drive({.name = "motor",
               .coordinate = {rotation, 0},
               .kind = DriveSpec::Kind::speed,
               .function = test::constant(omega)});
  b.add_coupling({.name = "cam",
                  .output = {lift, 0},
                  .terms = {{{rotation, 0},
                             test::time_function([](double x) { return 0.02 * (1 - std::cos(3 * x)); },
                                                 [](double x) { return 0.06 * std::sin(3 * x); },
                                                 [](double x) { return 0.18 * std::cos(3 * x); })}}});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  // The tolerances are those of the start, which is exact, and of a second later, to second order of the step.
  for (double tolerance : {1e-10, 2e-4}) {
    const Observation observation = m->observe(state);
    const double x = 3 * omega * state.t, lift_rate = 0.06 * std::sin(x);
    const double force = mass * (0.18 * std::cos(x) * omega * omega + 9.81);
    CHECK(observation.coupling_efforts[0] == doctest::Approx(force).epsilon(tolerance));
    CHECK(std::abs(observation.drive_efforts[0] - force * lift_rate) < tolerance * force);
    if (state.t == 0) test::run(*m, state, 1, 4000, 0.8);
  }
}

TEST_CASE("CouplingOfACoordinateToItself_IsRefused") {
  MechanismBuilder b;
  const JointId j = hinge(b, "hinge", wheel(b, "wheel", 1));
  b.add_coupling({.name = "loop", .output = {j, 0}, .terms = {{{j, 0}, test::constant(1)}}});
  CHECK_THROWS_WITH((void)b.finalise(),
                    "couplings.loop: a coordinate that depends on itself; expected an input that is another coordinate "
                    "than the output");
}

}  // namespace coupling_test
}  // namespace hersey::mbd
