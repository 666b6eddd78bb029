// Flexible bodies in motion: rigid limit, conservation, vibration, centrifugal stretch, a slider-crank.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "flexible_beam.h"
#include "hersey/mbd/mechanism_builder.h"
#include "hersey/solver/equilibrium.h"
#include "hersey/solver/linearise.h"
#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace flexible_motion_test {

using Eigen::VectorXd;

constexpr double kPi = std::numbers::pi;

/// Holds the beam's root on ground.
void clamp(MechanismBuilder& b, const FlexibleBodyIds& beam) {
  b.add_joint(
      {.name = "clamp", .type = JointType::fixed, .inboard = b.frame_of(b.ground()), .outboard = beam.frames[0]});
}

std::vector<double> frequencies_of(Mechanism& m, const solver::State& state) {
  std::vector<double> found;
  for (const solver::Mode& mode : solver::find_modes(solver::linearise(m, state, 0)).modes)
    if (mode.frequency > 1) found.push_back(mode.frequency);
  return found;
}

TEST_CASE("FlexibleBeam_HasTheFrequenciesOfSlenderBeams") {
  // Euler and Bernoulli's beam, of slenderness 100 over the thinner side: shear and rotary inertia take 1e-3 and less.
  test::Beam beam{.size = {1, 0.01, 0.02}, .cells = {24, 1, 1}, .tip = true};
  beam.modes = 6;
  beam.material.poisson_ratio = 0;
  const double speed = std::sqrt(beam.material.youngs_modulus / beam.material.density) * 0.01 / std::sqrt(12.0);
  const auto exact = [&](double root) { return root * root * speed / (2 * kPi); };
  MechanismBuilder builder_of_clamped;
  clamp(builder_of_clamped, beam.add_to(builder_of_clamped));
  const auto clamped = builder_of_clamped.finalise();
  std::vector<double> found = frequencies_of(*clamped, test::start(*clamped));
  CHECK(found[0] == doctest::Approx(exact(1.875104)).epsilon(3e-3));
  MechanismBuilder loose;
  (void)beam.add_to(loose);
  const auto free = loose.finalise();
  found = frequencies_of(*free, test::start(*free));
  CHECK(found[0] == doctest::Approx(exact(4.730041)).epsilon(3e-3));
  MechanismBuilder hinged;
  const FlexibleBodyIds ids = beam.add_to(hinged);
  hinged.add_joint({.name = "pin",
                    .type = JointType::revolute,
                    .inboard = hinged.frame_of(hinged.ground()),
                    .outboard = ids.frames[0]});
  hinged.add_joint({.name = "sleeve",
                    .type = JointType::planar,
                    .inboard = hinged.add_frame({.name = "rail", .body = hinged.ground(), .X_BF = beam.frame_at(1)}),
                    .outboard = ids.frames[1],
                    .axis = {0, 1, 0}});
  // Pinned and clamped along y; along z clamped and free, twice as stiff as along y.
  const auto pinned = hinged.finalise();
  found = frequencies_of(*pinned, test::start(*pinned));
  CHECK(found[0] == doctest::Approx(2 * exact(1.875104)).epsilon(3e-3));
  CHECK(found[1] == doctest::Approx(exact(3.926602)).epsilon(3e-3));
}

TEST_CASE("FlexibleBeam_HasTheFrequenciesOfItsMesh") {
  // The reference cantilever's mesh of hexahedra with 20 nodes is verified elsewhere; here modes against more modes.
  test::Beam beam{.cells = {10, 2, 2}, .tip = true};
  const auto lowest = [&](int modes) {
    beam.modes = modes;
    MechanismBuilder b;
    clamp(b, beam.add_to(b));
    const auto m = b.finalise();
    return frequencies_of(*m, test::start(*m));
  };
  const std::vector<double> some = lowest(8), many = lowest(20);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(some[i] >= many[i] * (1 - 1e-9));  // Rayleigh: fewer shapes are never softer
    CHECK(some[i] == doctest::Approx(many[i]).epsilon(2e-3));
  }
}

/// A pendulum of a beam, rigid or elastic, hinged at its root; the hinge's angle at the end.
double swing(const test::Beam* elastic, const test::Beam& beam) {
  MechanismBuilder b;
  b.set_gravity({0, -9.81, 0});
  FrameId root;
  if (elastic != nullptr) {
    const FlexibleBodyIds ids = elastic->add_to(b);
    root = b.add_frame({.name = "root", .body = ids.bodies[0], .X_BF = beam.frame_at(0)});
  } else {
    const BodyId id = b.add_body(beam.rigid("beam"));
    root = b.add_frame({.name = "root", .body = id, .X_BF = beam.frame_at(0)});
  }
  const JointId hinge = b.add_joint({.name = "hinge",
                                     .type = JointType::revolute,
                                     .inboard = b.frame_of(b.ground()),
                                     .outboard = root,
                                     .initial = {0.3}});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  test::run(*m, state, 1.0, 400);
  return m->observe(state).joints[static_cast<std::size_t>(hinge.index)].position[0];
}

TEST_CASE("StiffBeam_SwingsLikeTheRigidOne") {
  test::Beam stiff{.cells = {4, 1, 1}, .tip = true};
  stiff.material.youngs_modulus *= 1e6;
  // m: a millionth of the softness, and Newton's tolerance.
  CHECK(std::abs(swing(&stiff, stiff) - swing(nullptr, stiff)) < 1e-6);
}

/// Errors of energy and angular momentum over revolutions of a free beam that bends and stretches as it spins.
struct SpinErrors {
  double strain = 0, energy = 0, momentum = 0;
  double drift = 0;           ///< of the energy: its mean over the last tenth less that over the first
  double momentum_drift = 0;  ///< the same of the angular momentum about the axis of spin
};

SpinErrors spin(double revolutions, int steps_per_revolution, const Vector3& omega, double spectral_radius,
                bool nodal) {
  test::Beam beam{.size = {1, 0.05, 0.03}, .cells = {nodal ? 4 : 8, 1, 1}, .tip = true, .nodal = nodal};
  beam.material.youngs_modulus = 2e9;  // soft enough to bend
  beam.modes = 4;
  MechanismBuilder b;
  const FlexibleBodyIds ids = beam.add_to(b);
  // Joined at the centre of mass, whose path the integrator meets exactly.
  const FrameId centre =
      b.add_frame({.name = "centre", .body = ids.bodies[0], .X_BF = {Matrix3::Identity(), beam.size / 2}});
  b.add_joint({.name = "flight",
               .type = JointType::free,
               .inboard = b.frame_of(b.ground()),
               .outboard = centre,
               .initial = {0, 0, 0, 0, 0, 0},
               .initial_rate = {0, 0, 0, omega.x(), omega.y(), omega.z()}});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  const ElasticEnergy first = m->observe(state).elastics[0].energy;
  SpinErrors errors;
  int step = 0, early_count = 0, late_count = 0;
  double early = 0, late = 0, spin_early = 0, spin_late = 0;
  test::run(*m, state, revolutions * 2 * kPi / omega.norm(), static_cast<int>(revolutions) * steps_per_revolution,
            spectral_radius, [&](const solver::State&) {
              if (++step % 10 != 0) return;
              const ElasticEnergy now = m->observe(state).elastics[0].energy;
              const double change = now.kinetic + now.strain - first.kinetic - first.strain;
              const Vector3 lost = now.angular_momentum - first.angular_momentum;
              const double along = lost.dot(first.angular_momentum) / first.angular_momentum.squaredNorm();
              if (step <= 0.1 * revolutions * steps_per_revolution) early += change, spin_early += along, ++early_count;
              if (step > 0.9 * revolutions * steps_per_revolution) late += change, spin_late += along, ++late_count;
              errors.strain = std::max(errors.strain, now.strain / first.kinetic);
              errors.energy = std::max(errors.energy, std::abs(change) / first.kinetic);
              errors.momentum = std::max(errors.momentum, lost.norm() / first.angular_momentum.norm());
            });
  errors.drift = (late / late_count - early / early_count) / first.kinetic;
  errors.momentum_drift = spin_late / late_count - spin_early / early_count;
  return errors;
}

TEST_CASE("FreeSpinningBeam_KeepsMomentumAndEnergyOver100Revolutions") {
  // The errors of the steps themselves swing with their square; what counts is that they do not grow.
  const SpinErrors e = spin(100, 400, {0, 0, 20}, 1.0, false);
  MESSAGE("strain energy up to ", e.strain, ", energy swings by ", e.energy, " and drifts by ", e.drift,
          ", angular momentum off by ", e.momentum);
  CHECK(e.strain > 1e-4);
  CHECK(std::abs(e.drift) < 1e-6);  // does not grow: what is left of a mean over the steps' own swing
  CHECK(e.momentum < 2e-5);
  // The momentum errs by the order of the steps, no more: at half the step a quarter of it.
  const SpinErrors fine = spin(10, 800, {0, 0, 20}, 1.0, false);
  MESSAGE("angular momentum drifts by ", e.momentum_drift, "; at half the step it is off by ", fine.momentum,
          " and drifts by ", fine.momentum_drift);
  CHECK(e.momentum / fine.momentum > 3.5);
  CHECK(std::abs(e.momentum_drift) < 1e-6);  // does not grow: what is left of a mean over the steps' own swing
  // With dissipation energy is lost and never gained.
  CHECK(spin(5, 200, {0, 0, 20}, 0.9, false).drift < 0);
}

TEST_CASE("FreeSpinningBeamOfNodes_KeepsMomentumAndEnergy") {
  const SpinErrors e = spin(2, 150, {0, 0, 20}, 1.0, true);
  MESSAGE("strain energy up to ", e.strain, ", energy swings by ", e.energy, " and drifts by ", e.drift,
          ", angular momentum off by ", e.momentum);
  CHECK(e.strain > 1e-4);
  CHECK(std::abs(e.drift) < 1e-6);  // does not grow: what is left of a mean over the steps' own swing
  // Let go undeformed it vibrates, and its momentum errs by the steps' order as that of modes does: with half of them a
  // quarter is left, which is below what a body that starts in its static answer has with these.
  const SpinErrors fine = spin(2, 300, {0, 0, 20}, 1.0, true);
  MESSAGE("at half the step angular momentum is off by ", fine.momentum, ", energy swings by ", fine.energy);
  CHECK(e.momentum / fine.momentum > 3.5);
  CHECK(fine.momentum < 5e-6);
  CHECK(spin(2, 100, {0, 0, 20}, 0.9, true).drift < 0);
}

TEST_CASE("SpinningRod_StretchesByTheClosedForm") {
  // u(L) = rho omega^2 L^3/(3 E), nu = 0; the softening by the rod's own stretch is omega^2 L^2 rho/E of it.
  test::Beam rod{.size = {1, 0.02, 0.02}, .cells = {20, 1, 1}, .tip = true};
  rod.material.poisson_ratio = 0;
  rod.modes = 0;
  const double omega = 100;
  MechanismBuilder b;
  const FlexibleBodyIds ids = rod.add_to(b);
  const FrameId root = b.add_frame({.name = "root", .body = ids.bodies[0], .X_BF = rod.frame_at(0)});
  const JointId hub = b.add_joint({.name = "hub",
                                   .type = JointType::revolute,
                                   .inboard = b.frame_of(b.ground()),
                                   .outboard = root,
                                   .initial = {0.0},
                                   .initial_rate = {omega}});
  b.add_drive(
      {.name = "motor", .coordinate = {hub, 0}, .kind = DriveSpec::Kind::speed, .function = test::constant(omega)});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  // The start is undeformed, so the rod swings about its stretch between nothing and twice that: its mean counts.
  const double period = 4 / std::sqrt(rod.material.youngs_modulus / rod.material.density);
  double sum = 0;
  constexpr int steps = 4000;
  test::run(*m, state, 10 * period, steps, 0.9, [&](const solver::State& s) {
    sum += (m->frame_motion(s, ids.frames[1]).X_WF.r - m->frame_motion(s, root).X_WF.r).norm() - 1;
  });
  const double exact = rod.material.density * omega * omega / (3 * rod.material.youngs_modulus);
  MESSAGE("mean stretch over the closed form ", sum / steps / exact);
  CHECK(sum / steps == doctest::Approx(exact).epsilon(1e-2));  // omega^2 L^2 rho/E of it, and the mean of ten periods
}

TEST_CASE("HangingBeam_SettlesAtItsStaticShape") {
  // Under gravity a cantilever's tip sinks by rho g A L^4/(8 E I): 1e-3 for shear, of the square of its thickness.
  test::Beam beam{.size = {1, 0.02, 0.02}, .cells = {20, 1, 1}, .tip = true};
  beam.material.poisson_ratio = 0;
  MechanismBuilder b;
  b.set_gravity({0, 0, -9.81});
  const FlexibleBodyIds ids = beam.add_to(b);
  clamp(b, ids);
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  const solver::EquilibriumSummary rest = solver::find_equilibrium(*m, state);
  INFO(rest.message);
  REQUIRE(rest.solved());
  CHECK(rest.kind == solver::EquilibriumKind::stable);
  const double sag = 9.81 * 7850 * 0.02 * 0.02 / (8 * 2.1e11 * std::pow(0.02, 4) / 12);
  CHECK(beam.frame_at(1).r.z() - m->frame_motion(state, ids.frames[1]).X_WF.r.z() ==
        doctest::Approx(sag).epsilon(5e-3));
  // The clamp carries the weight and its moment.
  const JointObservation clamp = m->observe(state).joints.back();
  CHECK(clamp.force.z() == doctest::Approx(9.81 * beam.mass()).epsilon(1e-9));  // out of balance by 1e-10
}

/// Crank and slider with a rod that is rigid or elastic; the slider's position after half a revolution.
double slide(bool flexible, double stiffening) {
  test::Beam rod{.size = {0.3, 0.02, 0.02}, .cells = {8, 1, 1}, .tip = true};
  rod.material.youngs_modulus *= stiffening;
  rod.modes = 4;
  MechanismBuilder b;
  const BodyId crank = b.add_body({.name = "crank", .mass = 1, .inertia = Vector3(1e-3, 1e-3, 1e-3).asDiagonal()});
  const BodyId slider = b.add_body({.name = "slider", .mass = 0.5});
  const JointId main = b.add_joint({.name = "main",
                                    .type = JointType::revolute,
                                    .inboard = b.frame_of(b.ground()),
                                    .outboard = b.frame_of(crank),
                                    .initial = {0.5}});
  b.add_drive(
      {.name = "motor", .coordinate = {main, 0}, .kind = DriveSpec::Kind::speed, .function = test::constant(150)});
  BodyId big, small;
  Pose small_at;
  if (flexible) {
    const FlexibleBodyIds ids = rod.add_to(b, "rod");
    big = ids.bodies[0];
    small = ids.bodies[1];
  } else {
    big = small = b.add_body(rod.rigid("rod"));
    small_at = rod.frame_at(0.3);
  }
  b.add_joint({.name = "pin",
               .type = JointType::revolute,
               .inboard = b.add_frame({.name = "pin", .body = crank, .X_BF = {Matrix3::Identity(), {0.1, 0, 0}}}),
               .outboard = b.add_frame({.name = "big", .body = big, .X_BF = rod.frame_at(0)})});
  b.add_joint({.name = "wrist",
               .type = JointType::revolute,
               .inboard = b.add_frame({.name = "small", .body = small, .X_BF = small_at}),
               .outboard = b.frame_of(slider)});
  b.add_joint({.name = "cylinder",
               .type = JointType::prismatic,
               .inboard = b.frame_of(b.ground()),
               .outboard = b.frame_of(slider),
               .axis = {1, 0, 0},
               .initial = {0.39}});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  test::run(*m, state, kPi / 150, 1000, 0.7);
  return m->observe(state).bodies[static_cast<std::size_t>(slider.index)].X_WF.r.x();
}

TEST_CASE("SliderCrank_WithAStiffRodMovesAsWithARigidOne") {
  const double rigid = slide(false, 1), stiff = slide(true, 1e3), elastic = slide(true, 1);
  MESSAGE("slider off by ", elastic - rigid, " m, a thousand times stiffer by ", stiff - rigid, " m");
  CHECK(std::abs(elastic - rigid) > 1e-7);
  CHECK(std::abs(elastic - rigid) < 1e-4);  // m: it is stiff
  CHECK(std::abs(stiff - rigid) < 0.01 * std::abs(elastic - rigid));
}

}  // namespace flexible_motion_test
}  // namespace hersey::mbd
