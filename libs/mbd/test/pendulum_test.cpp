#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/mbd/mechanism_builder.h"
#include "mechanisms_pendulum.h"
#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace pendulum_test {

constexpr double kPi = std::numbers::pi;
constexpr double g = 9.81, L = 1.0;

/// IFToMM A01: a point mass on a massless rod, released level; angle from hanging. `closed` models it as a free body
/// whose pivot is a closing joint instead.
std::unique_ptr<Mechanism> pendulum(bool closed, double amplitude = 0.5 * kPi) {
  MechanismBuilder b;
  b.set_gravity({0, -g, 0});
  // A little inertia about the free body's own centre keeps its rotation determined; in the pivot it adds to m L^2.
  const double J = closed ? 0.1 : 0.0;
  const BodyId bob = b.add_body({.name = "bob", .mass = 1, .inertia = Matrix3::Identity() * J});
  const FrameId pivot = b.add_frame({.name = "pivot", .body = bob, .X_BF = {Matrix3::Identity(), {0, L, 0}}});
  if (closed)
    b.add_joint({.name = "flight",
                 .type = JointType::free,
                 .inboard = b.frame_of(b.ground()),
                 .outboard = b.frame_of(bob),
                 .initial = {L * std::sin(amplitude), -L * std::cos(amplitude), 0, 0, 0, amplitude}});
  b.add_joint({.name = "pivot",
               .type = JointType::revolute,
               .inboard = b.frame_of(b.ground()),
               .outboard = pivot,
               .initial = closed ? std::vector<double>{} : std::vector<double>{amplitude}});
  return b.finalise();
}

TEST_CASE("Pendulum_FollowsEllipticSolution") {
  // IFToMM A01 over 20 s instead of 2000 s, to the benchmark's error of 1e-3 of the length. Phase error of the method:
  // t omega (omega dt)^2/12 ~ 20 * 3 * 1e-5 / 12 = 5e-5.
  const auto m = pendulum(false);
  solver::State state = test::start(*m);
  const verification::Pendulum exact{0.5 * kPi, std::sqrt(g / L)};
  CHECK(exact.period() == doctest::Approx(2.36784194757624).epsilon(1e-13));  // digits of the reference
  double worst = 0;
  test::run(*m, state, 20, 20000, 1.0, [&](const solver::State& s) {
    const Vector3 r = m->frame_motion(s, m->spec().body_frames[1]).X_WF.r;
    const double angle = exact.angle(s.t);
    worst = std::max(worst, (r - L * Vector3(std::sin(angle), -std::cos(angle), 0)).norm());
  });
  MESSAGE("largest position error ", worst);
  CHECK(worst < 1e-4);  // as said above
}

TEST_CASE("PendulumOver2000Seconds_MatchesTheBenchmark") {
  // IFToMM A01 in full: 845 periods, 4000 outputs. Phase error as above: 2000 * 3 * (1.3e-3)^2 / 12 = 8e-4 at 0.4 ms.
  const auto m = pendulum(false);
  solver::State state = test::start(*m);
  const verification::Pendulum exact{0.5 * kPi, std::sqrt(g / L)};
  solver::GeneralizedAlpha integrator({.spectral_radius = 1.0});
  constexpr int outputs = 4000, steps = 1250;
  double worst = 0;
  bool converged = true;
  for (int output = 1; output <= outputs && converged; ++output) {
    const double t0 = 0.5 * (output - 1);
    for (int i = 1; i <= steps && converged; ++i)
      converged = integrator.step(*m, state, t0 + 0.5 * i / steps - state.t).solved();
    worst = std::max(worst, 2 * L * std::abs(std::sin(0.5 * (state.q[0] - exact.angle(state.t)))));
  }
  REQUIRE(converged);
  MESSAGE("largest position error ", worst);
  CHECK(worst < 1e-3);  // as said above
  // The benchmark's own figure for the end.
  // The benchmark's own measure.
  CHECK(std::hypot(std::sin(state.q[0]) + 0.8146030686, -std::cos(state.q[0]) + 0.5800188278) < 1e-3);
}

/// Errors of angle, rate and pivot force at t = 1 s.
Vector3 errors_at_one_second(bool closed, int steps, double spectral_radius) {
  const auto m = pendulum(closed);
  solver::State state = test::start(*m);
  test::run(*m, state, 1.0, steps, spectral_radius);
  const double inertia = L * L + (closed ? 0.1 : 0.0);
  const verification::Pendulum exact{0.5 * kPi, std::sqrt(g * L / inertia)};
  const double angle = exact.angle(1), rate = exact.rate(1);
  const double acceleration = -exact.omega0 * exact.omega0 * std::sin(angle);
  const Vector3 up(-std::sin(angle), std::cos(angle), 0), along(std::cos(angle), std::sin(angle), 0);
  // Reaction of ground on the bob: m (a - g).
  const Vector3 force = L * (acceleration * along + rate * rate * up) + Vector3(0, g, 0);
  const Observation observation = m->observe(state);
  const FrameMotion& bob = observation.bodies[1];
  return {std::atan2(bob.X_WF.R(1, 0), bob.X_WF.R(0, 0)) - angle, bob.omega.z() - rate,
          (observation.joints.back().force - force).norm()};
}

TEST_CASE("PositionsVelocitiesAndMultipliers_AreOfOrderTwo") {
  // Two-sided: an order above 2.05 means the test left the asymptotic range. The start's transient has decayed:
  // 0.6^400.
  for (bool closed : {false, true}) {
    CAPTURE(closed);
    const Vector3 coarse = errors_at_one_second(closed, 400, 0.6), fine = errors_at_one_second(closed, 800, 0.6);
    for (int i = 0; i < 3; ++i) {
      CAPTURE(i);
      CHECK(std::abs(std::log2(coarse[i] / fine[i]) - 2.0) < 0.05);
    }
    MESSAGE("errors at 800 steps: ", fine.transpose());
  }
}

TEST_CASE("VariableSteps_KeepOrderTwo") {
  // Steps that alternate by a factor of 2: without rescaling of the algorithmic acceleration this is of order 1.
  const auto error = [](int pairs) {
    const auto m = pendulum(true);
    solver::State state = test::start(*m);
    solver::GeneralizedAlpha integrator({.spectral_radius = 0.6});
    for (int i = 0; i < pairs; ++i)
      for (double share : {1.0 / 3, 2.0 / 3}) REQUIRE(integrator.step(*m, state, share / pairs).solved());
    const verification::Pendulum exact{0.5 * kPi, std::sqrt(g / 1.1)};
    return std::abs(m->observe(state).bodies[1].omega.z() - exact.rate(1));
  };
  CHECK(std::abs(std::log2(error(1600) / error(3200)) - 2.0) < 0.05);
}

TEST_CASE("FirstStep_IsAsAccurateAsTheOthers") {
  // A start from vdot = 0 makes an error dt^2 (1/2 - beta) vdot in the first step: order 2 overall would hide it, a
  // single step does not. Locally the method is of third order in position.
  const auto error = [](double dt) {
    const auto m = pendulum(true);
    solver::State state = test::start(*m);
    solver::GeneralizedAlpha integrator({.spectral_radius = 0.6, .rtol = 1e-12});
    REQUIRE(integrator.step(*m, state, dt).solved());
    const verification::Pendulum exact{0.5 * kPi, std::sqrt(g / 1.1)};
    const FrameMotion bob = m->observe(state).bodies[1];
    return std::abs(std::atan2(bob.X_WF.R(1, 0), bob.X_WF.R(0, 0)) - exact.angle(dt));
  };
  CHECK(std::log2(error(0.02) / error(0.01)) > 2.8);
}

/// Largest energy error in the first and in the second half of 100 s, relative to the largest kinetic energy.
std::pair<double, double> energy_errors(bool closed, double spectral_radius) {
  const auto m = pendulum(closed, 2.5);
  solver::State state = test::start(*m);
  const Observation start = m->observe(state);
  const double E0 = start.kinetic_energy + start.potential_energy, swing = E0 + g * L;
  double early = 0, late = 0;
  test::run(*m, state, 100, 20000, spectral_radius, [&](const solver::State& s) {
    const Observation observation = m->observe(s);
    const double error = std::abs(observation.kinetic_energy + observation.potential_energy - E0) / swing;
    (s.t < 50 ? early : late) = std::max(s.t < 50 ? early : late, error);
  });
  MESSAGE("relative energy error ", early, ", then ", late);
  return {early, late};
}

TEST_CASE("EnergyOfLongRuns_DoesNotDriftAtSpectralRadiusOne") {
  // The error oscillates, ~ (omega dt)^2/12 with omega up to 6 rad/s in the swing; it must not drift.
  const auto [early, late] = energy_errors(false, 1.0);
  CHECK(early < 0.03 * 0.03);
  CHECK(late < 1.1 * early);
}

TEST_CASE("EnergyOfLongRuns_LeaksLittleThroughMildDissipation") {
  // Dissipation is of order (omega dt)^3 per radian: 42 periods at omega dt = 0.015 and less than 1e-3 of the energy.
  const auto [early, late] = energy_errors(true, 0.9);
  CHECK(early < 1e-3);  // as said above
  CHECK(late < 1e-3);   // as said above
}

// The energies used to check a step equal those observed, for point masses, too.
TEST_CASE("EnergyViewOfAPendulum_EqualsTheObservation") {
  for (const bool closed : {false, true}) {
    CAPTURE(closed);
    const auto m = pendulum(closed);
    solver::State state = test::start(*m);
    test::run(*m, state, 0.4, 40);
    const Observation observation = m->observe(state);
    EnergyView view;
    m->view_energy(state, false, view);
    double kinetic = 0;
    for (const double of_link : view.kinetic) kinetic += of_link;
    CHECK(observation.kinetic_energy > 1);
    // The same products, summed otherwise: round-off.
    CHECK(kinetic == doctest::Approx(observation.kinetic_energy).epsilon(1e-12));
    CHECK(view.potential == doctest::Approx(observation.potential_energy).epsilon(1e-12));
  }
}

TEST_CASE("SpectralRadiusOne_IsRefusedWithConstraints") {
  const auto m = pendulum(true);
  solver::State state = test::start(*m);
  solver::GeneralizedAlpha integrator({.spectral_radius = 1.0});
  CHECK_THROWS_WITH_AS((void)integrator.step(*m, state, 1e-3), doctest::Contains("spectral_radius"), InputError);
}

}  // namespace pendulum_test
}  // namespace hersey::mbd
