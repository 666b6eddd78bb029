// Forces on joint coordinates and drives that start smoothly.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "hersey/mbd/bushing.h"
#include "hersey/mbd/mechanism_builder.h"
#include "simulate.h"
#include "test_mechanisms.h"
#include "tree/drive_motion.h"

namespace hersey::mbd {
namespace coordinate_force_test {

/// A slider of 2 kg along x, its force added by `add`.
template <class Add>
std::unique_ptr<Mechanism> slider(double position, double rate, Add add) {
  MechanismBuilder b;
  const BodyId body = b.add_body({.name = "slider", .mass = 2, .inertia = Matrix3::Identity()});
  const JointId rail = b.add_joint({.name = "rail",
                                    .type = JointType::prismatic,
                                    .inboard = b.frame_of(b.ground()),
                                    .outboard = b.frame_of(body),
                                    .axis = {1, 0, 0},
                                    .initial = {position},
                                    .initial_rate = {rate}});
  add(b, CoordinateRef{rail, 0}, body);
  return b.finalise();
}

TEST_CASE("DryFriction_StopsASliderAfterItsTime") {
  // 6 N on 2 kg: from 3 m/s to rest in 1 s; below the transition speed it creeps, and never reverses.
  const auto m = slider(0, 3, [](MechanismBuilder& b, CoordinateRef x, BodyId) {
    b.add_coordinate_force("friction", x, std::make_shared<JointFriction>(6, 0, 1e-3));
  });
  solver::State state = test::start(*m);
  test::run(*m, state, 0.5, 500, 0.8);
  CHECK(state.v[0] == doctest::Approx(1.5).epsilon(1e-5));  // steps of 1 ms, second order
  const Observation observation = m->observe(state);
  CHECK(observation.coordinate_force_efforts[0] == doctest::Approx(-6).epsilon(1e-6));  // (v_t/v)^2/2 is missing
  CHECK(observation.coordinate_force_powers[0] == doctest::Approx(-9).epsilon(1e-4));   // the speed's own error
  CHECK(observation.joints[0].force.norm() < 1e-7);  // friction acts inside the joint
  test::run(*m, state, 1.2, 700, 0.8);
  // The transition speed, 1e-3 m/s.
  CHECK(std::abs(state.v[0]) < 1e-3);
  CHECK(state.q[0] == doctest::Approx(1.5).epsilon(1e-3));
}

TEST_CASE("ViscousFriction_DecaysExponentially") {
  const auto m = slider(0, 3, [](MechanismBuilder& b, CoordinateRef x, BodyId) {
    b.add_coordinate_force("friction", x, std::make_shared<JointFriction>(0, 4, 1e-3));
  });
  solver::State state = test::start(*m);
  test::run(*m, state, 1, 1000, 0.8);
  CHECK(state.v[0] == doctest::Approx(3 * std::exp(-2.0)).epsilon(1e-5));  // steps of 1 ms, second order
}

TEST_CASE("FunctionSpring_PullsByItsTable") {
  const auto m = slider(0.7, 0, [](MechanismBuilder& b, CoordinateRef x, BodyId) {
    b.add_coordinate_force("spring", x,
                           std::make_shared<FunctionSpring>(std::make_shared<test::Quadratic>(0, 10, 30), 0.2));
  });
  const solver::State state = test::start(*m);
  CHECK(state.vdot[0] == doctest::Approx(-(10 * 0.5 + 30 * 0.25) / 2));
}

TEST_CASE("SpeedController_ReachesItsSpeedUnderLoadWithinItsLimit") {
  const double load = -3, limit = 8, target = 5;
  const auto m = slider(0, 0, [&](MechanismBuilder& b, CoordinateRef x, BodyId body) {
    b.add_coordinate_force("control", x, std::make_shared<SpeedController>(test::constant(target), 6, 9, limit));
    b.add_load({.name = "load",
                .frame = b.frame_of(body),
                .terms = {{(Vector6() << 0, 0, 0, 1, 0, 0).finished(), test::constant(load), {}}}});
  });
  solver::State state = test::start(*m);
  double fastest = 0;
  const auto watch = [&](const solver::State& s) { fastest = std::max(fastest, s.v[0]); };
  test::run(*m, state, 1, 500, 0.8, watch);
  CHECK(state.v[0] == doctest::Approx((limit + load) / 2).epsilon(1e-6));  // saturated until then
  CHECK(m->observe(state).coordinate_force_efforts[0] == doctest::Approx(limit));
  test::run(*m, state, 15, 7000, 0.8, watch);
  // Settled: the motion has decayed like exp(-1.5 t).
  CHECK(state.v[0] == doctest::Approx(target).epsilon(1e-4));
  CHECK(m->observe(state).coordinate_force_efforts[0] == doctest::Approx(-load).epsilon(1e-3));
  CHECK(fastest < 1.25 * target);  // the integral did not wind up during saturation: without, it overshoots by half
}

TEST_CASE("Bushing_CarriesAWeightAndTwist") {
  MechanismBuilder b;
  b.set_gravity({0, 0, -10});
  const BodyId block = b.add_body({.name = "block", .mass = 4, .inertia = Matrix3::Identity()});
  Matrix6 K = Matrix6::Zero(), D = Matrix6::Zero();
  K.diagonal() << 300, 300, 200, 5e3, 5e3, 8e3;
  D.diagonal() << 40, 40, 40, 400, 400, 400;
  b.add_force("mount", b.frame_of(b.ground()), b.frame_of(block), std::make_shared<Bushing>(K, D));
  b.add_load({.name = "twist",
              .frame = b.frame_of(block),
              .terms = {{(Vector6() << 0, 0, 1, 0, 0, 0).finished(), test::constant(240), {}}}});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  test::run(*m, state, 4, 2000, 0.8);
  const Observation observation = m->observe(state);
  CHECK(observation.bodies[1].X_WF.r.z() == doctest::Approx(-40.0 / 8e3).epsilon(1e-6));  // settled
  // A rotation of 1.2 rad: the rotation vector's moment is that of the linear law.
  // Settled: the motion has decayed like exp(-5.9 t).
  CHECK(rotation_log(Eigen::Quaterniond(observation.bodies[1].X_WF.R)).z() == doctest::Approx(1.2).epsilon(1e-6));
}

DriveSpec drive(DriveSpec::Kind kind, double ramp) {
  return {.name = "d",
          .coordinate = {},
          .kind = kind,
          .function = test::time_function([](double t) { return 2 + std::sin(5 * t); },
                                          [](double t) { return 5 * std::cos(5 * t); },
                                          [](double t) { return -25 * std::sin(5 * t); }),
          .ramp = ramp,
          .start = 0.1};
}

TEST_CASE("RampedDrives_StartFromRestAndEndInTheirMotion") {
  constexpr double h = 1e-5;
  for (DriveSpec::Kind kind : {DriveSpec::Kind::position, DriveSpec::Kind::speed, DriveSpec::Kind::acceleration}) {
    CAPTURE(static_cast<int>(kind));
    const double rate0 = kind == DriveSpec::Kind::acceleration ? 0.3 : 0.0;
    DriveMotion motion(drive(kind, 0.4), 0.7, rate0);
    motion.anchor(0.1);
    // Position, velocity and acceleration belong to each other through the ramp and after.
    for (double t : {0.12, 0.17, 0.3, 0.45, 0.8}) {
      CAPTURE(t);
      // Differences of step 1e-5: its square times steep derivatives of the ramp, and round-off over it.
      CHECK(std::abs((motion.position(t + h) - motion.position(t - h)) / (2 * h) - motion.velocity(t)) < 1e-6);
      CHECK(std::abs((motion.velocity(t + h) - motion.velocity(t - h)) / (2 * h) - motion.acceleration(t)) < 1e-4);
    }
    CHECK(std::abs(motion.acceleration(0.1)) < 1e-12);  // no ramp has begun: round-off
    CHECK(motion.velocity(0.1) == doctest::Approx(rate0));
  }
  const DriveMotion position(drive(DriveSpec::Kind::position, 0.4), 0.7);
  CHECK(position.position(0.1) == 0.7);
  CHECK(position.position(0.6) == doctest::Approx(2 + std::sin(3.0)));
}

TEST_CASE("AccelerationDrive_IsIntegratedTwice") {
  DriveMotion motion({.name = "d",
                      .coordinate = {},
                      .kind = DriveSpec::Kind::acceleration,
                      .function = test::time_function([](double t) { return 6 * t; }, [](double) { return 6.0; },
                                                      [](double) { return 0.0; })},
                     0.5, -1);
  for (int i = 1; i <= 10; ++i) motion.anchor(0.1 * i);
  // Quadrature to 1e-13.
  CHECK(motion.position(1.5) == doctest::Approx(0.5 - 1.5 + 1.5 * 1.5 * 1.5).epsilon(1e-13));
  CHECK(motion.velocity(1.5) == doctest::Approx(-1 + 3 * 1.5 * 1.5).epsilon(1e-13));
  CHECK(motion.acceleration(1.5) == 9);
}

}  // namespace coordinate_force_test
}  // namespace hersey::mbd
