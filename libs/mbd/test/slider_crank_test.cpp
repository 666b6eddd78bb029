#include <doctest/doctest.h>

#include <cmath>

#include "hersey/mbd/mechanism_builder.h"
#include "mechanisms_slider_crank.h"
#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace slider_crank_test {

struct Model {
  std::unique_ptr<Mechanism> mechanism;
  JointId main, big_end, small_end, guide;
  BodyId slider;
};

/// In space revolute, cylindrical, spherical and prismatic joints leave one motion and no redundancy, dead centres
/// included. `reverse_rod` declares the big end from rod to crank, so that the tree runs through it backwards.
/// `crank_angle` selects the branch of the rod for assembly: along the guide.
Model slider_crank(const verification::SliderCrank& s, bool reverse_rod, double crank_angle = 0) {
  MechanismBuilder b;
  b.set_gravity({0, -s.g, 0});
  const Matrix3 slim = Vector3(0, 1, 1).asDiagonal();
  const BodyId crank = b.add_body(
      {.name = "crank", .mass = s.crank_mass, .com = {s.crank_com, 0, 0}, .inertia = Matrix3::Identity() * 1e-3});
  const BodyId rod =
      b.add_body({.name = "rod", .mass = s.rod_mass, .com = {s.rod_com, 0, 0}, .inertia = slim * s.rod_J});
  const BodyId slider = b.add_body({.name = "slider", .mass = s.slider_mass, .inertia = Matrix3::Identity() * 1e-4});
  const FrameId ground = b.frame_of(b.ground());
  const FrameId pin = b.add_frame({.name = "pin", .body = crank, .X_BF = {Matrix3::Identity(), {s.r, 0, 0}}});
  const FrameId tip = b.add_frame({.name = "tip", .body = rod, .X_BF = {Matrix3::Identity(), {s.L, 0, 0}}});
  Model m;
  m.main = b.add_joint({.name = "main",
                        .type = JointType::revolute,
                        .inboard = ground,
                        .outboard = b.frame_of(crank),
                        .initial = {0},
                        .initial_rate = {s.omega}});
  const FrameId rod_ends[2] = {pin, b.frame_of(rod)};
  m.big_end = b.add_joint({.name = "big_end",
                           .type = JointType::cylindrical,
                           .inboard = rod_ends[reverse_rod ? 1 : 0],
                           .outboard = rod_ends[reverse_rod ? 0 : 1],
                           .initial = {0, reverse_rod ? crank_angle : -crank_angle}});
  m.small_end =
      b.add_joint({.name = "small_end", .type = JointType::spherical, .inboard = tip, .outboard = b.frame_of(slider)});
  m.guide = b.add_joint({.name = "guide",
                         .type = JointType::prismatic,
                         .inboard = ground,
                         .outboard = b.frame_of(slider),
                         .axis = {1, 0, 0},
                         .initial = {s.r + s.L}});
  b.add_drive({.name = "motor",
               .coordinate = {m.main, 0},
               .kind = DriveSpec::Kind::speed,
               .function = test::constant(s.omega)});
  b.add_load({.name = "gas",
              .frame = b.frame_of(slider),
              .axes = LoadAxes::ground,
              .terms = {{(Vector6() << 0, 0, 0, 1, 0, 0).finished(), test::constant(s.push), {}}}});
  m.mechanism = b.finalise();
  m.slider = slider;
  return m;
}

TEST_CASE("SliderCrank_MatchesClosedFormKinematicsAndReactions") {
  const verification::SliderCrank exact{.push = -1500};
  for (bool reverse_rod : {false, true}) {
    CAPTURE(reverse_rod);
    // At any instant the motion is prescribed, so positions, velocities, accelerations and reactions are exact, without
    // an integrator; only round-off of the solves is left.
    for (double t : {0.0, 0.001, 0.0042, 0.011, 0.0187}) {
      CAPTURE(t);
      Model m = slider_crank(exact, reverse_rod, exact.omega * t);
      solver::State state = m.mechanism->initial_state();
      state.t = t;
      state.q[0] = exact.omega * t;
      const solver::InitialiseSummary summary = solver::initialise(*m.mechanism, state);
      INFO(summary.message);
      REQUIRE(summary.solved());
      const Observation observation = m.mechanism->observe(state);
      const auto answer = exact.at(t);
      const FrameMotion& slider = observation.bodies[m.slider.index];
      const double force = std::abs(exact.push), roundoff = 1e-9;
      CHECK(std::abs(slider.X_WF.r.x() - answer.slider) < roundoff * exact.L);
      CHECK(std::abs(slider.v.x() - answer.slider_v) < roundoff * exact.omega * exact.r);
      CHECK(std::abs(slider.a.x() - answer.slider_a) < roundoff * exact.omega * exact.omega * exact.r);
      CHECK(std::abs(observation.drive_efforts[0] - answer.torque) < roundoff * force * exact.r);
      const auto& joint = observation.joints;
      CHECK((joint[m.main.index].force.head<2>() - answer.main).norm() < roundoff * force);
      CHECK(std::abs(joint[m.main.index].torque.z()) < roundoff * force * exact.r);  // the drive's torque is taken out
      CHECK((joint[m.guide.index].force - Vector3(0, answer.side, 0)).norm() < roundoff * force);
      const double angle = reverse_rod ? -answer.beta : exact.omega * t;  // of the inboard axes
      const Eigen::Vector2d big_end = Eigen::Rotation2Dd(-angle) * (reverse_rod ? -answer.big_end : answer.big_end);
      CHECK((joint[m.big_end.index].force.head<2>() - big_end).norm() < roundoff * force);
      const Eigen::Vector2d small_end = Eigen::Rotation2Dd(answer.beta) * answer.small_end;
      CHECK((joint[m.small_end.index].force.head<2>() - small_end).norm() < roundoff * force);
      // Round-off of the solutions, as above.
      CHECK(joint[m.small_end.index].position[2] == doctest::Approx(answer.beta).epsilon(1e-9).scale(1));
      CHECK(joint[m.small_end.index].rate[2] == doctest::Approx(answer.beta_rate).epsilon(1e-9).scale(exact.omega));
    }
  }
}

TEST_CASE("SliderCrank_IntegratedForACycleStaysOnTheClosedForm") {
  // Positions of a driven mechanism carry no integration error; multipliers are of second order, (omega dt)^2 of the
  // inertia forces with omega dt = 2 pi/360.
  const verification::SliderCrank exact{};
  Model m = slider_crank(exact, false);
  solver::State state = test::start(*m.mechanism);
  double worst_position = 0, worst_torque = 0, largest_torque = 0;
  const double revolution = 2 * std::numbers::pi / exact.omega;
  test::run(*m.mechanism, state, 2 * revolution, 720, 0.8, [&](const solver::State& s) {
    const Observation observation = m.mechanism->observe(s);
    const auto answer = exact.at(s.t);
    worst_position = std::max(worst_position, std::abs(observation.bodies[m.slider.index].X_WF.r.x() - answer.slider));
    worst_torque = std::max(worst_torque, std::abs(observation.drive_efforts[0] - answer.torque));
    largest_torque = std::max(largest_torque, std::abs(answer.torque));
  });
  CHECK(worst_position < 1e-9 * exact.L);  // constraints are satisfied to round-off
  CHECK(worst_torque < 30 * std::pow(2 * std::numbers::pi / 360, 2) * largest_torque);
  MESSAGE("worst relative torque error ", worst_torque / largest_torque);
}

TEST_CASE("ClosingJoints_AreFoundBreadthFirst") {
  const Model m = slider_crank({}, false);
  // Ground reaches crank and slider by joints with initial values; the rod hangs on the crank, its small end closes.
  REQUIRE(m.mechanism->closing_joints().size() == 1);
  CHECK(m.mechanism->closing_joints()[0] == m.small_end);
  CHECK(m.mechanism->nv() == 4);       // main 1, guide 1, big end 2
  CHECK(m.mechanism->nlambda() == 4);  // spherical 3, drive 1
}

}  // namespace slider_crank_test
}  // namespace hersey::mbd
