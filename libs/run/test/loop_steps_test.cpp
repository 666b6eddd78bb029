#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/model/build.h"
#include "hersey/run/simulation.h"
#include "hersey/solver/generalized_alpha.h"
#include "mechanisms_pendulum.h"
#include "small_rig.h"
#include "start/start.h"
#include "time_stepping/time_stepper.h"

namespace hersey::run {
namespace loop_steps_test {

/// A driven crank rocks a lever: hinges, three constraints of the loop redundant. `closing` is the last joint, `pin`
/// that between crank and coupler, `side` -1 for the mirror image.
std::string four_bar(const std::string& pin, const std::string& closing, int side = 1) {
  const std::string s = side < 0 ? "-" : "";
  const auto at = [&](const std::string& x) { return s + x + " 0 0 mm"; };
  return R"(hersey: 1
gravity: 0 -9.81 0 m/s^2
bodies:
  ground: {frames: {pivot: {origin: )" +
         at("80") + R"(}}}
  crank: {mass: 0.2 kg, centre_of_mass: )" +
         at("20") + R"(, inertia: {xx: 1e-5 kg.m^2, yy: 4e-5 kg.m^2, zz: 4e-5 kg.m^2}, frames: {pin: {origin: )" +
         at("40") + R"(}}}
  coupler: {mass: 0.6 kg, centre_of_mass: )" +
         at("100") + R"(, inertia: {xx: 2e-5 kg.m^2, yy: 2e-3 kg.m^2, zz: 2e-3 kg.m^2}, frames: {middle: {origin: )" +
         at("100") + R"(}}}
  rocker: {mass: 0.3 kg, centre_of_mass: )" +
         at("50") + R"(, inertia: {xx: 1e-5 kg.m^2, yy: 2.6e-4 kg.m^2, zz: 2.6e-4 kg.m^2}, frames: {end: {origin: )" +
         at("100") + R"(}}}
joints:
  main: {type: revolute, between: [ground, crank], axis: z, initial: {rotation: 0 deg}}
  pin: {type: )" +
         pin + ", between: [crank.pin, coupler], axis: z, guess: {rotation: " + s + R"(80 deg}}
  pivot: {type: revolute, between: [ground.pivot, rocker], axis: z, guess: {rotation: )" +
         s + R"(100 deg}}
  closing: {type: )" +
         closing + R"(, between: [coupler.middle, rocker.end]}
drives:
  motor: {joint: main, coordinate: rotation, speed: )" +
         s + R"(60 rpm}
simulation: {duration: 0.5 s, step: {tolerance: 1e-6, largest: 0.2 s}}
)";
}

const std::string kHinges = four_bar("revolute", "revolute, axis: z");

/// Six equal rods on six hinges, each perpendicular to the one before: a loop with one freedom and one redundant
/// constraint.
const std::string kBricard = R"(hersey: 1
gravity: 0 -9.81 0 m/s^2
bodies:
  ground: {frames: {last: {origin: 0 0 1 m}}}
  rod1: {mass: 1 kg, centre_of_mass: 0.5 0 0 m, inertia: {xx: 0.002 kg.m^2, yy: 0.084 kg.m^2, zz: 0.084 kg.m^2}, frames: {end: {origin: 1 0 0 m}}}
  rod2: {mass: 1 kg, centre_of_mass: 0 -0.5 0 m, inertia: {xx: 0.084 kg.m^2, yy: 0.002 kg.m^2, zz: 0.084 kg.m^2}, frames: {end: {origin: 0 -1 0 m}}}
  rod3: {mass: 1 kg, centre_of_mass: 0 0 0.5 m, inertia: {xx: 0.084 kg.m^2, yy: 0.084 kg.m^2, zz: 0.002 kg.m^2}, frames: {end: {origin: 0 0 1 m}}}
  rod4: {mass: 1 kg, centre_of_mass: -0.5 0 0 m, inertia: {xx: 0.002 kg.m^2, yy: 0.084 kg.m^2, zz: 0.084 kg.m^2}, frames: {end: {origin: -1 0 0 m}}}
  rod5: {mass: 1 kg, centre_of_mass: 0 0.5 0 m, inertia: {xx: 0.084 kg.m^2, yy: 0.002 kg.m^2, zz: 0.084 kg.m^2}, frames: {end: {origin: 0 1 0 m}}}
joints:
  j0: {type: revolute, between: [ground, rod1], axis: y}
  j1: {type: revolute, between: [rod1.end, rod2], axis: z}
  j2: {type: revolute, between: [rod2.end, rod3], axis: x}
  j3: {type: revolute, between: [rod3.end, rod4], axis: y}
  j4: {type: revolute, between: [rod4.end, rod5], axis: z}
  j5: {type: revolute, between: [rod5.end, ground.last], axis: x}
simulation: {duration: 1 s, step: {tolerance: 1e-6, largest: 0.2 s}}
)";

/// A free body whose pivot closes a loop.
const std::string kPendulumOnAJoint = R"(hersey: 1
gravity: 0 -9.81 0 m/s^2
bodies:
  bob: {mass: 1 kg, inertia: {xx: 0.1 kg.m^2, yy: 0.1 kg.m^2, zz: 0.1 kg.m^2}, frames: {top: {origin: 0 1 0 m}}}
joints:
  flight: {type: free, between: [ground, bob], initial: {position: 1 0 0 m, orientation: 0 0 90 deg}}
  pivot: {type: spherical, between: [ground, bob.top]}
simulation: {duration: 1 s, step: {tolerance: 1e-6, largest: 0.2 s}}
)";

struct Steps {
  bool completes = false;
  std::string message;
  int steps = 0, rejected = 0;
  int later = 0;  ///< steps behind a tenth of a second: the first is a guess, and they grow by 1.3 at a time
  double shortest = 1;
  solver::State end;
  mbd::Observation observation;
};

Steps step_through(const std::string& text, double radius, double tolerance,
                   const std::string& integrator = "generalized_alpha") {
  const model::Model model = rig(text, {"simulation.spectral_radius=" + std::to_string(radius),
                                        "simulation.step.tolerance=" + std::to_string(tolerance * 1e12) + "e-12",
                                        "simulation.integrator=" + integrator});
  model::Machine machine = model::build(model);
  Steps result;
  result.end = starting_state(model, machine);
  TimeStepper steps(model, machine);
  steps.plan(result.end, machine.mechanism->observe(result.end));
  // Far more steps than any of these takes: time stepping with ever shorter steps ends, too.
  for (; !steps.is_at_end() && result.steps < 20000; ++result.steps) {
    const TimeStep step = steps.take(result.end);
    result.message = step.message;
    if (!step.solved()) return result;
    if (result.end.t < 0.1) continue;
    ++result.later;
    result.shortest = std::min(result.shortest, step.dt);
  }
  result.completes = steps.is_at_end();
  result.rejected = steps.rejected_steps();
  result.observation = machine.mechanism->observe(result.end);
  return result;
}

/// Errors of angle, rate and force of the pendulum at t = 1 s.
Vector3 pendulum_errors(const mbd::Observation& observation) {
  const verification::Pendulum exact{0.5 * std::numbers::pi, std::sqrt(9.81 / 1.1)};
  const double angle = exact.angle(1), rate = exact.rate(1);
  const double angular_acceleration = -exact.omega0 * exact.omega0 * std::sin(angle);
  const Vector3 up(-std::sin(angle), std::cos(angle), 0), along(std::cos(angle), std::sin(angle), 0);
  const Vector3 force = angular_acceleration * along + rate * rate * up + Vector3(0, 9.81, 0);
  return {std::abs(observation.joints[0].position[5] - angle), std::abs(observation.joints[0].rate[5] - rate),
          (observation.joints[1].force - force).norm()};
}

// Once "the tolerance is exceeded with the smallest step", or no end, at 0.9 and above.
TEST_CASE("ClosedLoops_CompleteAtEverySpectralRadius") {
  for (const std::string& text : {kHinges, kBricard, kPendulumOnAJoint}) {
    for (const double tolerance : {1e-4, 1e-7}) {
      const Steps usual = step_through(text, 0.8, tolerance);
      REQUIRE(usual.completes);
      for (const double radius : {0.0, 0.5, 0.9, 0.95, 0.99, 1.0}) {
        CAPTURE(text.substr(text.find("joints"), 80));
        CAPTURE(radius);
        CAPTURE(tolerance);
        const Steps one = step_through(text, radius, tolerance);
        CAPTURE(one.message);
        CHECK(one.completes);
        // The error of a step, (integrator.11), has the factor 5/12 at 0, 0.102 at 0.8 and 1/12 at 1: steps go as its
        // third root, 1.6 times as many at 0. The rest is where steps fall.
        CHECK(one.later < 1.75 * usual.later);
        CHECK(one.later > 0.85 * usual.later);
        // A few at the start, where the first step is a guess.
        CHECK(one.rejected <= 5);
        // Neither motion passes a near-singular position.
        CHECK(one.shortest > 0.05 / one.steps);
      }
    }
  }
}

TEST_CASE("StepsInLoops_GoAsTheThirdRootOfTheTolerance") {
  for (const std::string& text : {kHinges, kPendulumOnAJoint}) {
    for (const double radius : {0.8, 0.95, 1.0}) {
      CAPTURE(radius);
      const Steps coarse = step_through(text, radius, 1e-6), fine = step_through(text, radius, 1e-9);
      // From both sides.
      CHECK(std::abs(std::log(static_cast<double>(fine.later) / coarse.later) / std::log(1e3) - 1.0 / 3) < 0.02);
    }
  }
}

TEST_CASE("ErrorsInLoops_FollowTheTolerance") {
  for (const double radius : {0.0, 0.8, 0.95, 1.0}) {
    const Vector3 coarse = pendulum_errors(step_through(kPendulumOnAJoint, radius, 1e-6).observation);
    const Vector3 fine = pendulum_errors(step_through(kPendulumOnAJoint, radius, 1e-9).observation);
    for (int i = 0; i < 3; ++i) {
      CAPTURE(radius);
      CAPTURE(i);
      MESSAGE("errors ", coarse[i], " and ", fine[i]);
      // Order two, steps as the third root; at one instant errors of the coarse run have terms of higher order, too.
      CHECK(std::abs(std::log(coarse[i] / fine[i]) / std::log(1e3) - 2.0 / 3) < 0.06);
    }
  }
}

// Constraint violations have no memory, so that any pattern of steps is allowed: with the constraints' own modes, one
// that alternates by 3 amplified them by more than 1 a step.
TEST_CASE("StepsOfAnyPattern_KeepOrderTwoInLoops") {
  const model::Model model = rig(kPendulumOnAJoint);
  const auto errors = [&](double radius, int repetitions) {
    model::Machine machine = model::build(model);
    solver::State state = starting_state(model, machine);
    solver::GeneralizedAlpha integrator({.spectral_radius = radius, .rtol = 1e-9});
    const auto keep = [](const solver::State&, const Eigen::VectorXd&) { return true; };
    for (int i = 0; i < repetitions; ++i)
      for (const double share : {1.0, 3.0, 1.0, 3.0, 1.0, 0.25, 0.25, 0.5})
        REQUIRE(integrator.step(*machine.mechanism, state, share / (10.0 * repetitions), keep).solved());
    return pendulum_errors(machine.mechanism->observe(state));
  };
  for (const double radius : {0.5, 0.95, 1.0}) {
    const Vector3 coarse = errors(radius, 100), fine = errors(radius, 200);
    for (int i = 0; i < 3; ++i) {
      CAPTURE(radius);
      CAPTURE(i);
      MESSAGE("order ", std::log2(coarse[i] / fine[i]), ", error ", fine[i]);
      CHECK(std::abs(std::log2(coarse[i] / fine[i]) - 2) < 0.1);  // the next term: a tenth of the step
    }
  }
}

TEST_CASE("RedundantLoop_TakesTheStepsOfTheLoopWithoutRedundancy") {
  // The same motion in the plane; what acts across it is zero.
  for (const double radius : {0.8, 0.95}) {
    CAPTURE(radius);
    const Steps hinges = step_through(kHinges, radius, 1e-7);
    const Steps free = step_through(four_bar("cylindrical", "spherical"), radius, 1e-7);
    REQUIRE(hinges.completes);
    REQUIRE(free.completes);
    CHECK(hinges.steps == free.steps);
    // Newton's tolerance of 1e-8, by far smaller than the steps' error.
    CHECK((hinges.observation.joints[2].force - free.observation.joints[2].force).norm() <
          1e-7 * hinges.observation.joints[2].force.norm());
  }
}

TEST_CASE("MirroredLoop_TakesTheSameSteps") {
  for (const double radius : {0.8, 0.95}) {
    CAPTURE(radius);
    const Steps one = step_through(kHinges, radius, 1e-7);
    const Steps mirrored = step_through(four_bar("revolute", "revolute, axis: z", -1), radius, 1e-7);
    REQUIRE(one.completes);
    CHECK(one.steps == mirrored.steps);
    const Vector3 force = one.observation.joints[2].force, other = mirrored.observation.joints[2].force;
    // Round-off of positions over the square of the step, over accelerations: 1e-16 / 1e-6.
    CHECK((force - Vector3(-other.x(), other.y(), other.z())).norm() < 1e-8 * force.norm());
  }
}

/// Bricard's loop with its first rod given last.
std::string with_rods_in_another_order() {
  std::string reordered = kBricard;
  const std::size_t first = reordered.find("  rod1:"), second = reordered.find("  rod2:");
  const std::string rod = reordered.substr(first, second - first);
  reordered.erase(first, second - first).insert(reordered.find("joints:"), rod);
  return reordered;
}

TEST_CASE("BodiesInAnotherOrder_TakeTheSameSteps") {
  const std::string reordered = with_rods_in_another_order();
  for (const double radius : {0.8, 0.95}) {
    CAPTURE(radius);
    const Steps one = step_through(kBricard, radius, 1e-7), other = step_through(reordered, radius, 1e-7);
    REQUIRE(one.completes);
    CHECK(one.steps == other.steps);
    // Round-off of sums in another order.
    CHECK((one.observation.joints[2].force - other.observation.joints[2].force).norm() <
          1e-8 * one.observation.joints[2].force.norm());
  }
}

/// Steps of the explicit method.
Steps explicit_steps(const std::string& text, double tolerance) {
  const Steps steps = step_through(text, 0.8, tolerance, "dormand_prince");
  CAPTURE(steps.message);
  REQUIRE(steps.completes);
  return steps;
}

TEST_CASE("ErrorOfExplicitRun_FollowsTheTolerance") {
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    const Steps one = explicit_steps(kPendulumOnAJoint, tolerance);
    const Vector3 errors = pendulum_errors(one.observation);
    CAPTURE(tolerance);
    MESSAGE(one.steps, " steps, errors ", errors.transpose());
    // A few steps, each with the tolerance at most; the force is ten times the angle's error.
    CHECK(errors[0] < 10 * tolerance);
    CHECK(errors[2] < 100 * tolerance);
  }
  // Order eight: a tenth of a thousandth of the error costs 10^(4/8) times the steps, and those of the start.
  CHECK(explicit_steps(kPendulumOnAJoint, 1e-10).steps < 4 * explicit_steps(kPendulumOnAJoint, 1e-6).steps);
  CHECK(10 * explicit_steps(kPendulumOnAJoint, 1e-8).steps < step_through(kPendulumOnAJoint, 0.8, 1e-8).steps);
}

TEST_CASE("ExplicitLoops_EndWhereGeneralizedAlphaTends") {
  // The errors of generalized-alpha go as tolerance^(2/3), a factor of 21.5 between these two.
  const Steps exact = explicit_steps(kBricard, 1e-11);
  const auto difference = [&](double tolerance) {
    const Steps other = step_through(kBricard, 0.8, tolerance);
    REQUIRE(other.completes);
    const mbd::Observation &a = exact.observation, &b = other.observation;
    return (a.joints[2].force - b.joints[2].force).norm() / a.joints[2].force.norm() +
           (exact.end.q - other.end.q).norm() + (exact.end.v - other.end.v).norm();
  };
  const double coarse = difference(1e-6), fine = difference(1e-8);
  MESSAGE("differences ", coarse, ", ", fine);
  CHECK(coarse / fine > 12);
  CHECK(coarse / fine < 40);

  // The drive prescribes the motion of the four-bar linkage: its forces tell. Generalized-alpha's are those of its
  // positions, which a drive of constant speed leaves without error but for that of solution, 1e-8.
  const Vector3 of_explicit = explicit_steps(kHinges, 1e-9).observation.joints[2].force;
  const Vector3 of_alpha = step_through(kHinges, 0.8, 1e-8).observation.joints[2].force;
  CHECK((of_explicit - of_alpha).norm() < 1e-7 * of_explicit.norm());  // ten times the tolerance of solutions
}

TEST_CASE("MirroredAndReorderedExplicitLoops_TakeTheSameSteps") {
  const Steps one = explicit_steps(kHinges, 1e-9);
  const Steps mirrored = explicit_steps(four_bar("revolute", "revolute, axis: z", -1), 1e-9);
  CHECK(one.steps == mirrored.steps);
  const Vector3 force = one.observation.joints[2].force, other = mirrored.observation.joints[2].force;
  // Round-off of accelerations.
  CHECK((force - Vector3(-other.x(), other.y(), other.z())).norm() < 1e-10 * force.norm());

  const Steps given = explicit_steps(kBricard, 1e-9), reordered = explicit_steps(with_rods_in_another_order(), 1e-9);
  CHECK(given.steps == reordered.steps);
  CHECK((given.observation.joints[2].force - reordered.observation.joints[2].force).norm() <
        1e-10 * given.observation.joints[2].force.norm());  // round-off of sums in another order
}

TEST_CASE("ResumedExplicitRun_GoesOnWithTheSameBits") {
  const model::Model model = rig(kBricard, {"simulation.integrator=dormand_prince"});
  const auto go_on = [](Simulation& one) {
    while (one.step().status == Advance::Status::advanced) continue;
    return one.output("joints.j3.rates");
  };
  Simulation simulation(model);
  for (int k = 0; k < 6; ++k) REQUIRE(simulation.step().status == Advance::Status::advanced);
  const Archive::Content saved = simulation.save();
  const std::vector<double> first = go_on(simulation);
  Simulation other(model);
  other.restore(saved);
  CHECK(go_on(other) == first);
}

}  // namespace loop_steps_test
}  // namespace hersey::run
