// Light bodies that carry heavy ones: nothing may depend on which body the tree begins with.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "beam_cases.h"
#include "hersey/mbd/bushing.h"
#include "hersey/mbd/mechanism_builder.h"
#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace light_root_test {

constexpr double kPi = std::numbers::pi;

double energy(Mechanism& m, const solver::State& state) {
  const Observation observation = m.observe(state);
  double sum = observation.kinetic_energy + observation.spring_energy;
  for (const ElasticObservation& part : observation.elastics) sum += part.energy.strain;
  return sum;
}

double power(Mechanism& m, const solver::State& state) {
  double sum = 0;
  for (const double load : m.observe(state).load_powers) sum += load;
  return sum;
}

/// A force that acts along the first component, a moment about z.
Vector6 wrench(double moment, double force) { return (Vector6() << 0, 0, moment, force, 0, 0).finished(); }

/// Simo and Vu-Quoc's beam (1986) in free flight, with the small rotary inertia of its section: a force and a moment
/// act suddenly on its first node.
struct FlyingBeam {
  std::unique_ptr<Mechanism> mechanism;
  BeamBodyIds ids;
};
FlyingBeam flying_beam(int elements, bool loosened) {
  MechanismBuilder b;
  if (loosened) b.loosen_beams();
  const test::StraightBeam beam{.length = 10,
                                .elements = elements,
                                .stiffness = {1e4, 1e4, 1e4, 500, 500, 500},
                                .mass_per_length = 1,
                                .inertia_per_length = {0.1, 0.05, 0.05}};
  FlyingBeam flying;
  flying.ids = beam.add_to(b);
  b.add_joint({.name = "plane",
               .type = JointType::planar,
               .inboard = b.frame_of(b.ground()),
               .outboard = flying.ids.frames[0],
               .initial = {6, 0, kPi - std::atan2(8, 6)}});
  b.add_load({.name = "push",
              .frame = flying.ids.frames[0],
              .axes = LoadAxes::ground,
              .terms = {{wrench(-80, 8), test::constant(1), {}}}});
  flying.mechanism = b.finalise();
  return flying;
}

/// Energy and what the loads have done, by the trapezoidal rule over the steps.
struct Balance {
  double energy = 0, work = 0;
};
Balance fly(int elements, double dt, double end, double spectral_radius, bool loosened) {
  const FlyingBeam beam = flying_beam(elements, loosened);
  Mechanism& m = *beam.mechanism;
  solver::State state = test::start(m);
  Balance balance;
  double before = power(m, state);
  test::run(m, state, end, static_cast<int>(std::lround(end / dt)), spectral_radius, [&](const solver::State& s) {
    const double now = power(m, s);
    balance.work += dt * (before + now) / 2;
    before = now;
    balance.energy = energy(m, s);
  });
  return balance;
}

TEST_CASE("LightFirstNodeUnderASuddenMoment_AbsorbsTheWorkDone") {
  // The first node alone rotates at some hundred radians per second, and steps of 20 ms do not resolve it. The method
  // takes unresolved motions out, with a spectral radius of .5 a quarter of the work in four steps; it must add
  // nothing.
  for (const int elements : {4, 8, 16})
    for (const double dt : {2.5e-3, 5e-3, 10e-3, 20e-3})
      for (const double rho : {0.5, 0.9, 1.0}) {
        CAPTURE(elements);
        CAPTURE(dt);
        CAPTURE(rho);
        const Balance loose = fly(elements, dt, 0.08, rho, true);
        CHECK(loose.energy < 1.001 * loose.work);  // the trapezoidal rule's share of the difference
        CHECK(loose.energy > (rho < 0.9 ? 0.7 : rho < 1 ? 0.97 : 0.997) * loose.work);
        if (dt > 5e-3) continue;
        // Counted from that node the energy is that of the work, too, as far as such steps go: the start adds nothing.
        const Balance from_first = fly(elements, dt, 0.08, rho, false);
        CHECK(from_first.energy == doctest::Approx(from_first.work).epsilon(0.03));
      }
}

/// A soft beam that swings about a hinge at one of its nodes, or flies.
std::unique_ptr<Mechanism> soft_beam(std::optional<std::size_t> hinge, bool loosened, BeamBodyIds& ids) {
  MechanismBuilder b;
  if (loosened) b.loosen_beams();
  b.set_gravity({0.5, -9.81, 1});
  const test::StraightBeam beam{.length = 1,
                                .elements = 4,
                                .stiffness = {3e3, 1e3, 1e3, 1.5, 2, 2.5},
                                .mass_per_length = 0.8,
                                .inertia_per_length = {2e-3, 1e-3, 1e-3}};
  ids = beam.add_to(b);
  const FrameId ground = b.frame_of(b.ground());
  if (hinge)
    b.add_joint({.name = "hinge",
                 .type = JointType::revolute,
                 .inboard = ground,
                 .outboard = ids.frames[*hinge],
                 .initial = {0.3},
                 .initial_rate = {2.0}});
  else
    b.add_joint({.name = "flight",
                 .type = JointType::free,
                 .inboard = ground,
                 .outboard = ids.frames[0],
                 .initial = {0.1, 0.2, 0.3, 0.4, -0.2, 0.3},
                 .initial_rate = {0, -2.5, 0, 3, 0.5, 4}});
  return b.finalise();
}

/// Returns the positions of the beam's ends after a while and the reactions of its joint.
Eigen::VectorXd swing(std::optional<std::size_t> hinge, bool loosened, int steps) {
  BeamBodyIds ids;
  const auto m = soft_beam(hinge, loosened, ids);
  solver::State state = test::start(*m);
  test::run(*m, state, 0.1, steps, 0.9);
  const Observation observation = m->observe(state);
  Eigen::VectorXd ends(9);
  ends << m->frame_motion(state, ids.frames.front()).X_WF.r, m->frame_motion(state, ids.frames.back()).X_WF.r,
      observation.joints.back().force;
  return ends;
}

TEST_CASE("LooseBeam_MovesAsCountedFromItsFirstNode") {
  const std::optional<std::size_t> hinges[] = {std::nullopt, 2U, 4U};
  for (const std::optional<std::size_t>& hinge : hinges) {
    CAPTURE(hinge.value_or(99));
    BeamBodyIds ids;
    const auto from_first = soft_beam(hinge, false, ids), loose = soft_beam(hinge, true, ids);
    // The start is the same: nodes have the positions and velocities that the first one gives them.
    for (const FrameId frame : ids.frames) {
      const FrameMotion a = from_first->frame_motion(from_first->initial_state(), frame),
                        b = loose->frame_motion(loose->initial_state(), frame);
      CHECK((a.X_WF.r - b.X_WF.r).norm() < 1e-15);  // round-off of 1 m
      CHECK((a.X_WF.R - b.X_WF.R).norm() < 1e-15);  // round-off of a rotation
      CHECK((a.v - b.v).norm() < 1e-14);            // of 5 m/s
      CHECK((a.omega - b.omega).norm() < 1e-14);    // likewise
    }
    // Later both differ by the error of the steps, which falls with their square once they resolve the hinge's modes.
    const Eigen::VectorXd coarse = swing(hinge, true, 100) - swing(hinge, false, 100),
                          fine = swing(hinge, true, 200) - swing(hinge, false, 200);
    CHECK(coarse.head(6).norm() < 1e-5);  // of 1 m: second order, 1e-4 of a radian squared per step of 1 ms
    CHECK(fine.head(6).norm() < 0.5 * coarse.head(6).norm());
    CHECK(fine.tail(3).norm() < 5e-3);  // of 10 N: stretch and shear vibrate faster than steps resolve
  }
}

/// A light body and a heavy one far from it, connected by a joint and a stiff bushing, a torque on the light one;
/// the model file begins with either.
std::unique_ptr<Mechanism> pair_of_bodies(bool light_first, JointType between, bool chooses_roots) {
  MechanismBuilder b;
  if (chooses_roots) b.choose_roots();
  const BodyId light = b.add_body({.name = "light", .mass = 0.1, .inertia = 1e-3 * Matrix3::Identity()});
  const BodyId heavy = b.add_body({.name = "heavy", .mass = 1, .inertia = Matrix3::Identity()});
  const FrameId far = b.add_frame({.name = "far", .body = heavy, .X_BF = {Matrix3::Identity(), {-10, 0, 0}}});
  const FrameId ground = b.frame_of(b.ground()), near = b.frame_of(light);
  const JointType to_ground = between == JointType::planar ? JointType::planar : JointType::free;
  if (light_first) {
    b.add_joint({.name = "j", .type = to_ground, .inboard = ground, .outboard = near});
    b.add_joint({.name = "k", .type = between, .inboard = near, .outboard = far});
  } else {
    std::vector<double> position(degrees_of_freedom(to_ground), 0.0);
    position[0] = 10;
    b.add_joint({.name = "j",
                 .type = to_ground,
                 .inboard = ground,
                 .outboard = b.frame_of(heavy),
                 .initial = std::move(position)});
    b.add_joint({.name = "k", .type = between, .inboard = far, .outboard = near});
  }
  Matrix6 K = Matrix6::Zero();
  K.diagonal() << 1e3, 1e3, 1e3, 1e4, 1e4, 1e4;
  b.add_force("bushing", near, far, std::make_shared<Bushing>(K, Matrix6::Zero()));
  Vector6 torque = wrench(-80, 0);
  if (between == JointType::spherical) torque[0] = 30;
  b.add_load({.name = "torque", .frame = near, .axes = LoadAxes::ground, .terms = {{torque, test::constant(1), {}}}});
  return b.finalise();
}

TEST_CASE("LightBodyAtTheRoot_StartsAsWhereTheHeavyOneIs") {
  // The light body rotates at a thousand radians per second on the bushing: steps of 2 ms do not resolve it.
  for (const double dt : {1e-3, 2e-3}) {
    CAPTURE(dt);
    double energies[2] = {};
    for (const bool light_first : {true, false}) {
      const auto m = pair_of_bodies(light_first, JointType::planar, false);
      solver::State state = test::start(*m);
      test::run(*m, state, 0.02, static_cast<int>(std::lround(0.02 / dt)), 0.9);
      energies[light_first ? 0 : 1] = energy(*m, state);
    }
    // Both start by the error of such steps alike; with steps of 2 ms the one had 733 J.
    CHECK(energies[0] == doctest::Approx(energies[1]).epsilon(0.02));
  }
}

TEST_CASE("LightBody_CarriesNothing") {
  // In a plane the heavy body has a pose of its own and carries the light one by a ball or a hinge.
  for (const JointType between : {JointType::planar, JointType::spherical, JointType::revolute}) {
    CAPTURE(name_of(between));
    Balance balances[2];
    for (const bool light_first : {true, false}) {
      const auto m = pair_of_bodies(light_first, between, true);
      solver::State state = test::start(*m);
      Balance& balance = balances[light_first ? 0 : 1];
      const double dt = 2e-3;
      double before = power(*m, state);
      test::run(*m, state, 0.06, 30, 0.9, [&](const solver::State& s) {
        const double now = power(*m, s);
        balance.work += dt * (before + now) / 2;
        before = now;
      });
      balance.energy = energy(*m, state);
    }
    // The results differ only by the light body's vibration, which the steps do not resolve, counted from the heavy
    // one: a thousandth of the work. Where the light body carries, these steps end in twice the energy, or fail.
    CHECK(balances[0].energy == doctest::Approx(balances[1].energy).epsilon(1e-3));
    CHECK(balances[0].work == doctest::Approx(balances[1].work).epsilon(1e-3));
  }
}

}  // namespace light_root_test
}  // namespace hersey::mbd
