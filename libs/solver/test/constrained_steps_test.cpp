#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "hersey/core/input_error.h"
#include "hersey/solver/generalized_alpha.h"
#include "hersey/solver/initialise.h"
#include "one_coordinate.h"
#include "several_coordinates.h"

// Steps of a pendulum in Cartesian coordinates, which a constraint keeps on its circle, and failures of such steps.
namespace hersey::solver {
namespace constrained_steps_test {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double gravity = 10;
constexpr double round_off = 1e-12;  // of direct solutions with forces of a few times gravity

VectorXd one(double value) { return VectorXd::Constant(1, value); }

test::SeveralCoordinates pendulum() {
  test::SeveralCoordinates e(Matrix2d::Identity(), 1);
  e.force = [](const VectorXd&, const VectorXd&, double) { return VectorXd(Vector2d(0, gravity)); };
  e.phi = [](const VectorXd& q, double) { return one(0.5 * (q.squaredNorm() - 1)); };
  e.G = [](const VectorXd& q, double) { return MatrixXd(q.transpose()); };
  e.bias = [](const VectorXd&, const VectorXd& v, double) { return one(v.squaredNorm()); };
  e.constraint_force_by_q = [](const VectorXd&, const VectorXd& lambda) {
    return MatrixXd(lambda[0] * Matrix2d::Identity());
  };
  return e;
}

State from_the_side(test::SeveralCoordinates& e) {
  State state = e.at(Vector2d(1, 0));
  REQUIRE(initialise(e, state).solved());
  return state;
}

/// G v and G vdot + gamma at the end of a step.
double off_the_rates(const State& s) { return std::abs(s.q.dot(s.v)); }
double off_the_accelerations(const State& s) { return std::abs(s.q.dot(s.vdot) + s.v.squaredNorm()); }

TEST_CASE("Pendulum_KeepsItsCircleAndItsEnergyToSecondOrder") {
  const auto lost = [](int steps) {
    test::SeveralCoordinates e = pendulum();
    State state = from_the_side(e);
    GeneralizedAlpha integrator({.spectral_radius = 0.8, .rtol = 1e-11});
    for (int i = 0; i < steps; ++i) {
      REQUIRE(integrator.step(e, state, 1.0 / steps).solved());
      CHECK(std::abs(state.q.norm() - 1) < 1e-11);  // rtol
    }
    // The force in the rod is m v^2 less the weight along it.
    CHECK(std::abs(state.lambda[0] - state.v.squaredNorm() + gravity * state.q[1]) < 1e-2 * gravity);
    return std::abs(0.5 * state.v.squaredNorm() + gravity * state.q[1]);
  };
  CHECK(std::log2(lost(200) / lost(400)) == doctest::Approx(2).epsilon(0.1));
}

// The remaining share is due to the factors of the step's last iteration, which belong to a slightly different
// configuration.
constexpr double what_is_left = 0.05;

TEST_CASE("StepOfAnotherLength_EndsOnTheConstraintsIfRequired") {
  const auto ends = [](bool returns, double last) {
    test::SeveralCoordinates e = pendulum();
    State state = from_the_side(e);
    GeneralizedAlpha integrator({.spectral_radius = 0.8, .returns_to_constraints = returns});
    for (int i = 0; i < 4; ++i) REQUIRE(integrator.step(e, state, 0.02).solved());
    REQUIRE(integrator.step(e, state, last).solved());
    return Vector2d(off_the_rates(state), off_the_accelerations(state));
  };
  const Vector2d off = ends(false, 0.005), on = ends(true, 0.005);
  CHECK(off[0] > 1e-6);  // by the square of the step before
  CHECK(on[0] < what_is_left * off[0]);
  CHECK(on[1] < what_is_left * off[1]);
  CHECK(ends(true, 0.02) == ends(false, 0.02));  // steps of one length are as they are
  // At rest there is no violation to correct.
  test::SeveralCoordinates e = pendulum();
  State hanging = e.at(Vector2d(0, -1));
  REQUIRE(initialise(e, hanging).solved());
  GeneralizedAlpha integrator({.spectral_radius = 0.8, .returns_to_constraints = true});
  for (const double dt : {0.02, 0.005}) CHECK(integrator.step(e, hanging, dt).iterations == 0);
  CHECK(hanging.q == Vector2d(0, -1));
}

TEST_CASE("StepChosenByItsError_EndsOnTheConstraints") {
  Vector2d left;
  for (const bool chosen : {false, true}) {
    CAPTURE(chosen);
    test::SeveralCoordinates e = pendulum();
    State state = from_the_side(e);
    GeneralizedAlpha integrator({.spectral_radius = 0.8, .chosen_by_error = chosen});
    VectorXd error;
    const StepCheck check = [&](const State&, const VectorXd& estimate) {
      error = estimate;
      return true;
    };
    for (int i = 0; i < 4; ++i) REQUIRE(integrator.step(e, state, 0.02, check).solved());
    CHECK(error.norm() > 0);
    const Vector2d off(off_the_rates(state), off_the_accelerations(state));
    if (chosen) CHECK((off.array() < what_is_left * left.array()).all());
    left = off;
    const State before = state;
    const StepSummary rejected = integrator.step(e, state, 0.02, [](const State&, const VectorXd&) { return false; });
    CHECK(rejected.status == StepStatus::inaccurate);
    CHECK(state.q == before.q);
    CHECK(state.t == before.t);
  }
}

TEST_CASE("WithoutDissipation_ConstraintsAreRefusedUnlessStepsEndOnThem") {
  test::SeveralCoordinates e = pendulum();
  State state = from_the_side(e);
  GeneralizedAlpha integrator({.spectral_radius = 1});
  CHECK_THROWS_AS((void)integrator.step(e, state, 0.01), InputError);
  CHECK(integrator.step(e, state, 0.01, [](const State&, const VectorXd&) { return true; }).solved());
}

// A film whose oil a step does not account for: the step is solved again from where it ended, by the new equations.
TEST_CASE("InconsistentStep_IsSolvedAgainByItsOwnEquations") {
  double pull = 1;
  test::SeveralCoordinates e(MatrixXd::Identity(1, 1));
  e.condenses = true;
  e.force = [&](const VectorXd&, const VectorXd&, double) { return one(-pull); };
  State state = e.at(one(0));
  state.vdot[0] = 1;
  GeneralizedAlpha integrator({.spectral_radius = 0.8});
  REQUIRE(integrator.step(e, state, 0.1).solved());
  State plain = state, again = state;
  test::SeveralCoordinates other = e;
  GeneralizedAlpha same({.spectral_radius = 0.8});
  State start = other.at(one(0));
  start.vdot[0] = 1;
  REQUIRE(same.step(other, start, 0.1).solved());
  REQUIRE(integrator.step(e, plain, 0.1).solved());
  other.stands_after = 1;
  other.changed = [&] { pull = 2; };
  REQUIRE(same.step(other, again, 0.1).solved());
  CHECK(again.vdot[0] == doctest::Approx(2));
  CHECK(plain.vdot[0] == doctest::Approx(1));
  // The new equations may be outside of their domain.
  pull = 1;
  other.stands_after = 1;
  other.changed = [&] { other.outside = [](const State&) { return std::string("gap closed"); }; };
  const State before = again;
  const StepSummary summary = same.step(other, again, 0.1);
  CHECK(summary.status == StepStatus::domain_error);
  CHECK(summary.message.find("gap closed") != std::string::npos);
  CHECK(again.q == before.q);
}

/// Status of a step from q = 0 at rest; the state stays as it was where it has no answer.
StepSummary attempt(Equations& e, State state, double dt, const GeneralizedAlphaOptions& options = {}) {
  const State before = state;
  GeneralizedAlpha integrator(options);
  const StepSummary summary = integrator.step(e, state, dt);
  if (!summary.solved()) CHECK(state.q == before.q);
  return summary;
}

TEST_CASE("StepsThatLeadNowhere_EndWithTheirReason") {
  test::OneCoordinate invalid;
  invalid.force = [](double, double, double) { return std::numeric_limits<double>::quiet_NaN(); };
  State rest = invalid.at(0, 0);
  rest.vdot.setZero();
  const StepSummary no_number = attempt(invalid, rest, 0.1);
  CHECK(no_number.status == StepStatus::domain_error);
  CHECK(no_number.message.find("the residual is not a number") != std::string::npos);
  // The start lies inside the domain, all increments lead outside.
  test::OneCoordinate wall;
  wall.force = [](double q, double, double) { return q == 0 ? 1e6 : std::numeric_limits<double>::quiet_NaN(); };
  const StepSummary nowhere = attempt(wall, rest, 0.1, {.max_halvings = 3});
  CHECK(nowhere.status == StepStatus::domain_error);
  // No increment is a number where the mass is next to nothing and the force next to everything.
  test::OneCoordinate light;
  light.mass = 1e-200;
  light.force = [](double, double, double) { return 1e200; };
  CHECK(attempt(light, rest, 0.1).status == StepStatus::singular);
  // The state is evaluated twice, first without its tangent: only the second evaluation finds it outside.
  int looks = 0;
  test::SeveralCoordinates fickle(MatrixXd::Identity(1, 1));
  fickle.force = [](const VectorXd& q, const VectorXd&, double) { return one(100 * std::pow(q[0], 3) - 50); };
  fickle.force_by_q = [](const VectorXd& q, const VectorXd&, double) { return MatrixXd(one(300 * q[0] * q[0])); };
  double last = 1e300;
  fickle.outside = [&](const State& s) {
    looks = s.q[0] == last ? looks + 1 : 0;
    last = s.q[0];
    return std::string(looks > 0 && s.t > 0 && s.q[0] != 0 ? "gone" : "");
  };
  State at_rest = fickle.at(one(0));
  const StepSummary gone = attempt(fickle, at_rest, 1);
  CHECK(gone.status == StepStatus::domain_error);
  CHECK(gone.message.find("gone") != std::string::npos);
}

// With old factors a step is solved to a hundredth of the tolerance, because Newton's own iteration would pass beyond
// it; at the last iteration the tolerance itself applies.
TEST_CASE("LastIteration_IsMeasuredByTheToleranceItself") {
  test::OneCoordinate e;
  e.force = [](double q, double, double) { return 10 * std::sin(q); };
  e.force_by_q = [](double q, double, double) { return 10 * std::cos(q); };
  int with_one_less = 0;
  for (double rtol = 1e-4; rtol > 1e-12; rtol /= 3) {
    const auto step = [&](int most) {
      return attempt(e, e.at(2, 0), 0.2, {.spectral_radius = 0.8, .rtol = rtol, .max_iterations = most});
    };
    const int needed = step(50).iterations;
    CHECK(step(needed).solved());
    if (needed > 1 && step(needed - 1).solved()) ++with_one_less;
    if (needed > 2) CHECK(!step(needed - 2).solved());
  }
  CHECK(with_one_less > 2);  // each iteration divides the residual by more than twenty: 100 is one or two of them
}

// The row with the largest residual is named, irrespective of its index.
TEST_CASE("WorstRow_IsNamedAtAnyIndex") {
  for (const Eigen::Index worst : {0, 1}) {
    test::SeveralCoordinates e(Matrix2d::Identity());
    e.force = [worst](const VectorXd& q, const VectorXd&, double) {
      VectorXd f(q.array().cube() + 1);
      f[worst] += 1e3 * std::sin(1e3 * q[worst]) + 900;
      return f;
    };
    e.least_scale = 1e4;
    const StepSummary summary = attempt(e, e.at(Vector2d(0, 0)), 0.1, {.rtol = 1e-12, .max_iterations = 1});
    CHECK(summary.status == StepStatus::no_convergence);
    CHECK(summary.worst_row == "coordinate " + std::to_string(worst));
  }
}

TEST_CASE("Restart_RemovesOnlyMotionsThatConstraintsDoNotAllow") {
  test::SeveralCoordinates e = pendulum();
  State state = e.at(Vector2d(0.6, -0.8), 2 * Vector2d(0.8, 0.6) + 0.01 * Vector2d(0.6, -0.8));
  REQUIRE(restart(e, state, 1e-3));
  CHECK((state.v - 2 * Vector2d(0.8, 0.6)).norm() < round_off);
  CHECK(off_the_accelerations(state) < round_off);
  CHECK(std::abs(state.lambda[0] - (4 + 0.8 * gravity)) < round_off);
  CHECK(state.q == Vector2d(0.6, -0.8));
  // The heavier of two coordinates that share a velocity changes less.
  test::SeveralCoordinates pair(Vector2d(3, 1).asDiagonal(), 1);
  pair.G = [](const VectorXd&, double) { return MatrixXd(Vector2d(1, -1).transpose()); };
  State apart = pair.at(Vector2d(0, 0), Vector2d(0, 1));
  REQUIRE(restart(pair, apart, 1e-3));
  CHECK((apart.v - Vector2d(0.25, 0.25)).norm() < 1e-15);  // momentum is kept
  // Without constraints there is nothing to remove.
  test::SeveralCoordinates free(MatrixXd::Identity(1, 1));
  free.force = [](const VectorXd&, const VectorXd&, double) { return one(-3); };
  State falling = free.at(one(0), one(7));
  REQUIRE(restart(free, falling, 1e-3));
  CHECK(falling.v[0] == 7);
  CHECK(falling.vdot[0] == doctest::Approx(3));
}

TEST_CASE("RestartThatIsNotDetermined_LeavesTheStateAlone") {
  const auto refused = [](test::SeveralCoordinates& e, const Vector2d& q, const Vector2d& v) {
    State state = e.at(q, v);
    CHECK(!restart(e, state, 1e-3));
    CHECK(state.v == v);
    CHECK(state.vdot.isZero(0));
  };
  const Vector2d v(1, 0.5);
  test::SeveralCoordinates outside = pendulum(), beyond = pendulum(), dead = pendulum(), massless = pendulum();
  outside.outside = [](const State&) { return std::string("gap closed"); };
  refused(outside, Vector2d(1, 0), v);
  beyond.outside = [](const State& s) { return std::string(off_the_rates(s) < round_off ? "gap closed" : ""); };
  refused(beyond, Vector2d(1, 0), v);  // inside as given, outside with the velocities it would have
  dead.phi_t = [](const VectorXd&, double) { return one(1); };
  refused(dead, Vector2d(0, 0), v);  // the constraint has no derivative here
  massless.mass = Vector2d(1, 0).asDiagonal();
  refused(massless, Vector2d(1, 0), v);
}

// A motion without inertia is in balance: it stays so, and takes no part in the accelerations.
TEST_CASE("Accelerations_LeaveMasslessMotionsInTheirBalance") {
  test::SeveralCoordinates e(Vector2d(0, 2).asDiagonal());
  e.force = [](const VectorXd&, const VectorXd& v, double) { return VectorXd(Vector2d(4 * v[0] - 2, -6)); };
  e.force_by_v = [](const VectorXd&, const VectorXd&, double) { return MatrixXd(Vector2d(4, 0).asDiagonal()); };
  State state = e.at(Vector2d(0, 0), Vector2d(0.5, 0));
  REQUIRE(solve_accelerations(e, state, 1e-3));
  CHECK(state.vdot[0] == 0);
  CHECK(state.vdot[1] == doctest::Approx(3));
  CHECK(state.v[0] == 0.5);
  e.outside = [](const State&) { return std::string("gap closed"); };
  const State before = state;
  CHECK(!solve_accelerations(e, state, 1e-3));
  CHECK(state.vdot == before.vdot);
}

}  // namespace constrained_steps_test
}  // namespace hersey::solver
