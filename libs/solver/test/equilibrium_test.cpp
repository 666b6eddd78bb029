#include "hersey/solver/equilibrium.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "one_coordinate.h"
#include "several_coordinates.h"

namespace hersey::solver {
namespace equilibrium_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double pi = std::numbers::pi;
constexpr double solved = 1e-9;  // Newton's method continues until it changes nothing; the rows require 1e-10

test::OneCoordinate pendulum() {
  test::OneCoordinate p;
  p.force = [](double q, double, double) { return 9.81 * std::sin(q); };
  p.force_by_q = [](double q, double, double) { return 9.81 * std::cos(q); };
  return p;
}

test::OneCoordinate with_force(double constant, double stiffness, double cubic = 0) {
  test::OneCoordinate p;
  p.force = [=](double q, double, double) { return constant + stiffness * q + cubic * q * q * q; };
  p.force_by_q = [=](double q, double, double) { return stiffness + 3 * cubic * q * q; };
  return p;
}

TEST_CASE("Pendulum_SlidesDownFromAnywhereAndIsStable") {
  for (const double start : {0.3, -1.2, 2.5, 3.14}) {
    CAPTURE(start);
    test::OneCoordinate p = pendulum();
    State state = p.at(start, 4);  // however fast it was
    const EquilibriumSummary found = find_equilibrium(p, state);
    REQUIRE(found.solved());
    CHECK(std::abs(state.q[0]) < solved);
    CHECK(state.v[0] == 0);
    CHECK(found.kind == EquilibriumKind::stable);
    CHECK(found.message.empty());
    CHECK(found.softest == "mass");
    CHECK(p.accepted == 1);  // what depends on the step before begins here
  }
}

TEST_CASE("UnstableEquilibrium_IsReported") {
  test::OneCoordinate p = pendulum();
  State upright = p.at(pi, 0);
  const EquilibriumSummary unstable = find_equilibrium(p, upright);
  REQUIRE(unstable.solved());
  CHECK(upright.q[0] == pi);
  CHECK(unstable.kind == EquilibriumKind::unstable);
  CHECK(unstable.message.find("unstable: the least push along mass") != std::string::npos);
  test::OneCoordinate nothing = with_force(0, 0);
  State anywhere = nothing.at(0.4, 0);
  const EquilibriumSummary neutral = find_equilibrium(nothing, anywhere);
  REQUIRE(neutral.solved());
  CHECK(neutral.kind == EquilibriumKind::neutral);
  CHECK(neutral.message.find("indifferent: no stiffness resists mass") != std::string::npos);
  // With a constraint no motion is free, which is stable.
  test::OneCoordinate constrained = with_force(3, 0);
  constrained.copies_of_constraint = 1;
  State at_rest = constrained.at(0, 0);
  const EquilibriumSummary stable = find_equilibrium(constrained, at_rest);
  REQUIRE(stable.solved());
  CHECK(stable.kind == EquilibriumKind::stable);
  CHECK(stable.softest.empty());
  CHECK(std::abs(at_rest.lambda[0] + 3) < solved);
}

// A stiffness of a thousand times itself away from rest, and one that falls to nothing on the way.
TEST_CASE("Equilibrium_OfSpringsThatHardenAndSoften") {
  test::OneCoordinate hard = with_force(-8, 1e-3, 1000);
  State state = hard.at(0, 0);
  REQUIRE(find_equilibrium(hard, state).solved());
  // 1000 q^3 = 8 but for the linear spring's 2e-4, over the slope 120 there; the remaining error is of the order of its
  // square.
  CHECK(std::abs(state.q[0] - (0.2 - 2e-4 / 120)) < solved);
  test::OneCoordinate soft;
  soft.force = [](double q, double, double) { return std::atan(5 * (q - 1)); };
  soft.force_by_q = [](double q, double, double) { return 5 / (1 + 25 * (q - 1) * (q - 1)); };
  State far = soft.at(-6, 0);  // Newton's method alone would run away from here
  const EquilibriumSummary found = find_equilibrium(soft, far);
  REQUIRE(found.solved());
  CHECK(std::abs(far.q[0] - 1) < solved);
}

// Forces far below those that a row compares (1 N here) settle within its tolerance at some hundredths of a metre.
TEST_CASE("Equilibrium_OfForcesBelowTheToleranceOfTheirRow_IsSolvedAsWell") {
  constexpr double small = 2e-9;
  test::OneCoordinate soft;
  soft.force = [](double q, double, double) { return small * (std::pow(q, 9) - 1); };
  soft.force_by_q = [](double q, double, double) { return 9 * small * std::pow(q, 8); };
  for (const double start : {1.003, 1.005, 1.05, 1.1, 1.2, 1.3, 1.5, 2.0}) {
    CAPTURE(start);
    State state = soft.at(start, 0);
    REQUIRE(find_equilibrium(soft, state).solved());
    CHECK(std::abs(state.q[0] - 1) < solved);
  }
}

TEST_CASE("NoEquilibrium_IsReportedAndLeavesTheStateUnchanged") {
  test::OneCoordinate pushed = with_force(2, 0);
  State state = pushed.at(0.7, 0);
  const EquilibriumSummary none = find_equilibrium(pushed, state, {.max_iterations = 30});
  CHECK(!none.solved());
  CHECK(none.message.find("no equilibrium in") == 0);
  CHECK(none.message.find("worst equation: mass") != std::string::npos);
  CHECK(state.q[0] == 0.7);
  CHECK(pushed.accepted == 0);
  test::OneCoordinate outside = with_force(0, 1);
  outside.lowest = 2;
  State closed = outside.at(1, 0);
  const EquilibriumSummary summary = find_equilibrium(outside, closed);
  CHECK(!summary.solved());
  CHECK(summary.message == "gap closed");
}

// If a step towards equilibrium leaves the domain, shorter steps do not.
TEST_CASE("Equilibrium_NearTheEndOfTheDomain_IsFoundFromInside") {
  test::OneCoordinate p;  // a gap: the force grows without bound as q falls to 0
  p.lowest = 0;
  p.force = [](double q, double, double) { return 50 - 0.5 / (q * q); };
  p.force_by_q = [](double q, double, double) { return 1 / (q * q * q); };
  State state = p.at(1, 0);
  REQUIRE(find_equilibrium(p, state).solved());
  CHECK(std::abs(state.q[0] - 0.1) < solved);
}

TEST_CASE("SteadyMotion_KeepsItsVelocityAndRestsOtherwise") {
  test::OneCoordinate rotor = with_force(0, 0);
  State rotating = rotor.at(0.2, 30);
  const EquilibriumSummary found = find_equilibrium(rotor, rotating, {.steady_motion = true});
  REQUIRE(found.solved());
  CHECK(rotating.v[0] == 30);
  CHECK(rotating.q[0] == 0.2);
  // A spring returns it through its middle, where it does not stay.
  test::OneCoordinate spring = with_force(-2, 5);
  State passing = spring.at(0.1, 3);
  const EquilibriumSummary passed = find_equilibrium(spring, passing, {.steady_motion = true});
  CHECK(!passed.solved());
  CHECK(passed.message.find("no steady motion: mass does not keep still") == 0);
  CHECK(passing.q[0] == 0.1);
  test::OneCoordinate pushed = with_force(2, 0);
  State driven = pushed.at(0, 3);
  const EquilibriumSummary none = find_equilibrium(pushed, driven, {.steady_motion = true});
  CHECK(!none.solved());
  CHECK(none.message.find("no steady motion near the start") == 0);
  // Without velocities both searches have the same result.
  State still = spring.at(0.1, 0);
  REQUIRE(find_equilibrium(spring, still, {.steady_motion = true}).solved());
  CHECK(std::abs(still.q[0] - 0.4) < solved);
}

/// The search starts from q with zero accelerations, from which it cannot estimate the effect of the forces: its first
/// step is a long one.
State without_pull(const test::OneCoordinate& p, double q) {
  State state = p.at(q, 0);
  state.vdot.setZero();
  return state;
}

TEST_CASE("StepsThatAreTooLong_AreRejected") {
  test::OneCoordinate hard = with_force(-1, 1e-3, 1000);
  State over = without_pull(hard, 0);  // the first step ends where the spring pulls back seven times as hard
  REQUIRE(find_equilibrium(hard, over).solved());
  CHECK(std::abs(over.q[0] - (0.1 - 1e-4 / 30)) < 1e-8);  // but for the square of the linear spring's part
  test::OneCoordinate soft;                               // and here at as large a force the other way
  soft.force = [](double q, double, double) { return std::atan(100 * (q - 0.09)); };
  soft.force_by_q = [](double q, double, double) { return 100 / (1 + 1e4 * (q - 0.09) * (q - 0.09)); };
  State beyond = without_pull(soft, 0);
  REQUIRE(find_equilibrium(soft, beyond).solved());
  CHECK(std::abs(beyond.q[0] - 0.09) < solved);
  test::OneCoordinate wall;
  wall.lowest = 0.09;
  wall.force = [](double q, double, double) { return 50 - 0.5 / (q * q); };
  wall.force_by_q = [](double q, double, double) { return 1 / (q * q * q); };
  State near = without_pull(wall, 0.2);  // and here outside of the domain
  REQUIRE(find_equilibrium(wall, near).solved());
  CHECK(std::abs(near.q[0] - 0.1) < solved);
}

// With too few iterations for the descent the load is followed, to the same rest, of springs that harden and that
// soften.
TEST_CASE("LoadThatIsFollowed_LeadsToTheSameRest") {
  const double most_of_a_step = 0.2;
  for (const double stiffness : {1.0, 5.0, 40.0}) {
    CAPTURE(stiffness);
    test::OneCoordinate hard = with_force(-8 * stiffness, stiffness, stiffness), same = hard;
    State slid = hard.at(0, 0), followed = slid;
    REQUIRE(find_equilibrium(hard, slid).solved());
    CHECK(slid.q[0] > 5 * most_of_a_step);
    const EquilibriumSummary summary = find_equilibrium(same, followed, {.max_iterations = 7});
    REQUIRE(summary.solved());
    CHECK(std::abs(followed.q[0] - slid.q[0]) < 2 * solved);
    CHECK(summary.iterations > 7);
  }
  // The path may be too long for the iterations there are, and may end where nothing balances any more of the load.
  test::OneCoordinate far = with_force(-1000, 1);
  State start = far.at(0, 0);
  CHECK(!find_equilibrium(far, start, {.max_iterations = 1}).solved());
  CHECK(start.q[0] == 0);
  test::OneCoordinate limited;
  limited.force = [](double q, double, double) { return std::sin(q) - 1.5; };
  limited.force_by_q = [](double q, double, double) { return std::cos(q); };
  start = limited.at(0, 0);
  CHECK(!find_equilibrium(limited, start, {.max_iterations = 20}).solved());
  // A ninth of what is left at a time is too slow for Newton's method at any share.
  test::OneCoordinate flat;
  flat.force = [](double q, double, double) { return std::pow(q, 9); };
  flat.force_by_q = [](double q, double, double) { return 9 * std::pow(q, 8); };
  start = flat.at(1.5, 0);
  CHECK(!find_equilibrium(flat, start, {.rtol = 1e-14, .max_iterations = 3}).solved());
}

// Rows with a large tolerance leave the rest to the end, where Newton's method continues until it changes nothing.
TEST_CASE("Rest_IsSolvedBeyondTheTolerance") {
  test::OneCoordinate p = with_force(-0.05, 20, 3000);  // 20 q + 3000 q^3 = 0.05 at 0.00250 - 0.0000023...
  State loose = p.at(0, 0), tight = loose;
  REQUIRE(find_equilibrium(p, tight).solved());
  REQUIRE(find_equilibrium(p, loose, {.rtol = 0.1}).solved());  // no row requires more
  CHECK(loose.q[0] > 0.002);
  CHECK(std::abs(loose.q[0] - tight.q[0]) < 2 * solved);
  // Not where that would lead far away, nor where it gets worse, and not for ever.
  test::OneCoordinate soft = with_force(-1e-3, 1e-4);
  State there = soft.at(0, 0);
  REQUIRE(find_equilibrium(soft, there, {.rtol = 0.1}).solved());
  CHECK(there.q[0] == 0);
  test::OneCoordinate kink;
  kink.force = [](double q, double, double) { return std::atan(1e4 * q); };
  kink.force_by_q = [](double q, double, double) { return 1e4 / (1 + 1e8 * q * q); };
  State beside = kink.at(5e-4, 0);
  REQUIRE(find_equilibrium(kink, beside, {.rtol = 0.9}).solved());
  CHECK(beside.q[0] == 5e-4);
  test::OneCoordinate cube = with_force(0, 0, 1);
  State slow = cube.at(0.02, 0);
  REQUIRE(find_equilibrium(cube, slow, {.rtol = 0.1}).solved());
  CHECK(slow.q[0] == doctest::Approx(0.02 * std::pow(2.0 / 3, 8)).scale(0));  // eight iterations take a third each
}

TEST_CASE("ForcesThatAreNoNumbers_AreReported") {
  test::OneCoordinate invalid = with_force(std::numeric_limits<double>::quiet_NaN(), 1);
  State state = invalid.at(0.3, 0);
  const EquilibriumSummary summary = find_equilibrium(invalid, state);
  CHECK(!summary.solved());
  CHECK(summary.message == "the forces at the start are not numbers");
  CHECK(state.q[0] == 0.3);
}

TEST_CASE("MachineThatCannotMove_IsAtRest") {
  test::SeveralCoordinates nothing(MatrixXd(0, 0));
  State state = nothing.at(VectorXd(0));
  const EquilibriumSummary found = find_equilibrium(nothing, state);
  CHECK(found.solved());
  CHECK(found.kind == EquilibriumKind::stable);
  CHECK(found.iterations == 0);
}

/// A weight on a circle of radius 1, stable at its lowest point, in Cartesian coordinates.
test::SeveralCoordinates weight_on_a_circle() {
  test::SeveralCoordinates e(MatrixXd::Identity(2, 2), 1);
  e.force = [](const VectorXd&, const VectorXd&, double) { return VectorXd(Vector2d(0, 9.81)); };
  e.phi = [](const VectorXd& q, double) { return VectorXd(VectorXd::Constant(1, 0.5 * (q.squaredNorm() - 1))); };
  e.G = [](const VectorXd& q, double) { return MatrixXd(q.transpose()); };
  e.constraint_force_by_q = [](const VectorXd&, const VectorXd& lambda) {
    return MatrixXd(lambda[0] * MatrixXd::Identity(2, 2));
  };
  return e;
}

TEST_CASE("WeightOnACircle_IsStabilisedByTheGeometricStiffness") {
  test::SeveralCoordinates e = weight_on_a_circle();
  State hanging = e.at(Vector2d(0.8, -0.6)), upright = e.at(Vector2d(0, 1));
  const EquilibriumSummary found = find_equilibrium(e, hanging);
  REQUIRE(found.solved());
  CHECK((hanging.q - Vector2d(0, -1)).norm() < solved);
  CHECK(std::abs(hanging.lambda[0] - 9.81) < 9.81 * solved);
  CHECK(found.kind == EquilibriumKind::stable);
  CHECK(found.softest == "coordinate 0");
  // Only the geometric stiffness of the multiplier distinguishes this one from the other.
  upright.lambda[0] = -9.81;
  const EquilibriumSummary above = find_equilibrium(e, upright);
  REQUIRE(above.solved());
  CHECK(above.kind == EquilibriumKind::unstable);
}

/// A bead on a rotating hoop is at rest where its weight and the centrifugal force balance, and at the lowest point,
/// too; v rotates the hoop.
constexpr double kept = 1e-8;  // a steady motion is solved to its rows alone, to 1e-10 of forces of a few newtons

TEST_CASE("SteadyMotion_IsFoundByShorterStepsWhereWholeOnesMiss") {
  test::OneCoordinate soft;  // far from its balance Newton's increments run away
  soft.force = [](double q, double, double) { return std::atan(50 * (q - 1)); };
  soft.force_by_q = [](double q, double, double) { return 50 / (1 + 2500 * (q - 1) * (q - 1)); };
  State state = soft.at(1.06, 0);
  REQUIRE(find_equilibrium(soft, state, {.steady_motion = true}).solved());
  CHECK(std::abs(state.q[0] - 1) < kept);
  test::OneCoordinate wall;
  wall.lowest = 0.09;
  wall.force = [](double q, double, double) { return 50 - 0.5 / (q * q); };
  wall.force_by_q = [](double q, double, double) { return 1 / (q * q * q); };
  state = wall.at(0.2, 0);
  REQUIRE(find_equilibrium(wall, state, {.steady_motion = true}).solved());
  CHECK(std::abs(state.q[0] - 0.1) < kept);
}

TEST_CASE("SteadyMotionThatIsNotReached_IsReported") {
  test::OneCoordinate pushed;
  pushed.force = [](double q, double, double) { return 1 + q * q; };
  pushed.force_by_q = [](double q, double, double) { return 2 * q; };
  State state = pushed.at(0.9, 3);
  const EquilibriumSummary none = find_equilibrium(pushed, state, {.steady_motion = true});
  CHECK(!none.solved());
  CHECK(none.message == "no steady motion near the start; worst equation: mass");
  CHECK(state.q[0] == 0.9);
  test::OneCoordinate flat;
  flat.force = [](double q, double, double) { return std::pow(q, 9); };
  flat.force_by_q = [](double q, double, double) { return 9 * std::pow(q, 8); };
  state = flat.at(1, 3);
  const EquilibriumSummary slow = find_equilibrium(flat, state, {.max_iterations = 3, .steady_motion = true});
  CHECK(!slow.solved());
  CHECK(slow.message.find("no equilibrium in 3 iterations") == 0);
}

// A steady motion is checked a little later by the same equations: a missing solution at that time is no evidence, but
// a changed solution shows that the motion is not steady.
TEST_CASE("SteadyMotion_IsCheckedAShortTimeLater") {
  test::OneCoordinate rotor = with_force(0, 0);
  rotor.lowest = 0.1;
  State leaving = rotor.at(0.2, -30);
  CHECK(find_equilibrium(rotor, leaving, {.steady_motion = true}).solved());
  CHECK(leaving.q[0] == 0.2);
  // A balance that is passing by, and of which later nothing, or next to nothing, is to be had.
  for (const int power : {2, 9}) {
    CAPTURE(power);
    test::OneCoordinate passing;
    passing.force = [=](double q, double, double t) {
      return t == 0 ? q : std::pow(q - 2, power) + (power == 2 ? 1 : 0);
    };
    passing.force_by_q = [=](double q, double, double t) { return t == 0 ? 1 : power * std::pow(q - 2, power - 1); };
    State state = passing.at(0, 3);
    const EquilibriumSummary summary = find_equilibrium(passing, state, {.steady_motion = true});
    CHECK(!summary.solved());
    CHECK(summary.message.find("no steady motion: mass does not keep still") == 0);
  }
}

}  // namespace equilibrium_test
}  // namespace hersey::solver
