#include "hersey/solver/equilibrium.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "one_coordinate.h"

namespace hersey::solver {
namespace equilibrium_test {

constexpr double pi = std::numbers::pi;
constexpr double solved = 1e-9;  // Newton's method goes on until it changes nothing; the rows ask for 1e-10

test::OneCoordinate pendulum() {
  test::OneCoordinate p;
  p.force = [](double q, double, double) { return 9.81 * std::sin(q); };
  p.force_dq = [](double q, double, double) { return 9.81 * std::cos(q); };
  return p;
}

test::OneCoordinate with_force(double constant, double stiffness, double cubic = 0) {
  test::OneCoordinate p;
  p.force = [=](double q, double, double) { return constant + stiffness * q + cubic * q * q * q; };
  p.force_dq = [=](double q, double, double) { return stiffness + 3 * cubic * q * q; };
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

TEST_CASE("Equilibrium_ThatIsNotStable_SaysSo") {
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
  CHECK(neutral.message.find("indifferent: nothing holds mass") != std::string::npos);
  // Held by a constraint nothing is free to move: that is stable.
  test::OneCoordinate held = with_force(3, 0);
  held.copies_of_constraint = 1;
  State at_rest = held.at(0, 0);
  const EquilibriumSummary stable = find_equilibrium(held, at_rest);
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
  // 1000 q^3 = 8 but for the linear spring's 2e-4, over the slope 120 there; what is left goes with its square.
  CHECK(std::abs(state.q[0] - (0.2 - 2e-4 / 120)) < solved);
  test::OneCoordinate soft;
  soft.force = [](double q, double, double) { return std::atan(5 * (q - 1)); };
  soft.force_dq = [](double q, double, double) { return 5 / (1 + 25 * (q - 1) * (q - 1)); };
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
  soft.force_dq = [](double q, double, double) { return 9 * small * std::pow(q, 8); };
  for (const double start : {1.003, 1.005, 1.05, 1.1, 1.2, 1.3, 1.5, 2.0}) {
    CAPTURE(start);
    State state = soft.at(start, 0);
    REQUIRE(find_equilibrium(soft, state).solved());
    CHECK(std::abs(state.q[0] - 1) < solved);
  }
}

TEST_CASE("NoEquilibrium_IsToldAndLeavesTheStateAlone") {
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
  const EquilibriumSummary told = find_equilibrium(outside, closed);
  CHECK(!told.solved());
  CHECK(told.message == "gap closed");
}

// Where the way to rest would lead out of the domain, shorter steps do not.
TEST_CASE("Equilibrium_NearTheEndOfTheDomain_IsFoundFromInside") {
  test::OneCoordinate p;  // a gap: the force grows without bound as q falls to 0
  p.lowest = 0;
  p.force = [](double q, double, double) { return 50 - 0.5 / (q * q); };
  p.force_dq = [](double q, double, double) { return 1 / (q * q * q); };
  State state = p.at(1, 0);
  REQUIRE(find_equilibrium(p, state).solved());
  CHECK(std::abs(state.q[0] - 0.1) < solved);
}

TEST_CASE("SteadyMotion_KeepsItsVelocityAndStandsStillInTheRest") {
  test::OneCoordinate rotor = with_force(0, 0);
  State turning = rotor.at(0.2, 30);
  const EquilibriumSummary found = find_equilibrium(rotor, turning, {.turning = true});
  REQUIRE(found.solved());
  CHECK(turning.v[0] == 30);
  CHECK(turning.q[0] == 0.2);
  // A spring lets it pass through its middle, not stay there.
  test::OneCoordinate spring = with_force(-2, 5);
  State passing = spring.at(0.1, 3);
  const EquilibriumSummary passed = find_equilibrium(spring, passing, {.turning = true});
  CHECK(!passed.solved());
  CHECK(passed.message.find("no steady motion: mass does not keep still") == 0);
  CHECK(passing.q[0] == 0.1);
  test::OneCoordinate pushed = with_force(2, 0);
  State driven = pushed.at(0, 3);
  const EquilibriumSummary none = find_equilibrium(pushed, driven, {.turning = true});
  CHECK(!none.solved());
  CHECK(none.message.find("no steady motion near the start") == 0);
  // At rest, turning or not is the same.
  State still = spring.at(0.1, 0);
  REQUIRE(find_equilibrium(spring, still, {.turning = true}).solved());
  CHECK(std::abs(still.q[0] - 0.4) < solved);
}

}  // namespace equilibrium_test
}  // namespace hersey::solver
