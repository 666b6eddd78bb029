#include "hersey/solver/dormand_prince.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hersey/solver/initialise.h"
#include "several_coordinates.h"

// Steps of the explicit method: its order for positions, velocities, accelerations and multipliers; its estimate; what
// it leaves where it finds no step.
namespace hersey::solver {
namespace dormand_prince_test {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double gravity = 10;

VectorXd one(double value) { return VectorXd::Constant(1, value); }

/// q'' + q = 0.
test::SeveralCoordinates oscillator() {
  test::SeveralCoordinates e(MatrixXd::Identity(1, 1));
  e.force = [](const VectorXd& q, const VectorXd&, double) { return q; };
  return e;
}

/// A mass on a circle whose radius grows, R(t) = 1 + growth t.
test::SeveralCoordinates pendulum(double growth = 0) {
  test::SeveralCoordinates e(Matrix2d::Identity(), 1);
  e.force = [](const VectorXd&, const VectorXd&, double) { return VectorXd(Vector2d(0, gravity)); };
  e.phi = [=](const VectorXd& q, double t) { return one(0.5 * (q.squaredNorm() - std::pow(1 + growth * t, 2))); };
  e.G = [](const VectorXd& q, double) { return MatrixXd(q.transpose()); };
  e.phi_t = [=](const VectorXd&, double t) { return one(-growth * (1 + growth * t)); };
  e.bias = [=](const VectorXd&, const VectorXd& v, double) { return one(v.squaredNorm() - growth * growth); };
  return e;
}

State from_the_side(test::SeveralCoordinates& e) {
  State state = e.at(Vector2d(1, 0));
  REQUIRE(initialise(e, state).solved());
  return state;
}

State after(test::SeveralCoordinates& e, State state, double end, int steps) {
  DormandPrince integrator;
  for (int i = 1; i <= steps; ++i) REQUIRE(integrator.step(e, state, end * i / steps - state.t, {}).solved());
  return state;
}

/// Largest differences of positions, velocities, accelerations and multipliers at four instants of two seconds.
std::vector<double> differences(test::SeveralCoordinates& e, const State& start, int steps, int steps_of_exact) {
  std::vector<double> largest(4, 0.0);
  for (const int part : {1, 2, 3, 4}) {
    const State a = after(e, start, 0.5 * part, steps * part / 4),
                b = after(e, start, 0.5 * part, steps_of_exact * part / 4);
    const double of[] = {(a.q - b.q).norm(), (a.v - b.v).norm(), (a.vdot - b.vdot).norm(),
                         (a.lambda - b.lambda).norm()};
    for (std::size_t i = 0; i < 4; ++i) largest[i] = std::max(largest[i], of[i]);
  }
  return largest;
}

TEST_CASE("ExplicitOscillator_IsOfOrderEight") {
  test::SeveralCoordinates e = oscillator();
  const auto error = [&](int steps) {
    State state = e.at(one(1));
    REQUIRE(initialise(e, state).solved());
    state = after(e, state, 20, steps);
    return std::hypot(state.q[0] - std::cos(20.0), state.v[0] + std::sin(20.0));
  };
  const double order = std::log2(error(40) / error(80));
  MESSAGE("order ", order, ", error ", error(80));
  CHECK(std::abs(order - 8) < 0.2);  // the next term of steps of a quarter of a radian
}

TEST_CASE("ExplicitSteps_AreOfOrderEightWithConstraints") {
  // Against a solution with four times as many steps, whose error is 4^-8.
  for (const double growth : {0.0, 0.3}) {
    test::SeveralCoordinates e = pendulum(growth);
    const State start = from_the_side(e);
    const std::vector<double> coarse = differences(e, start, 32, 256), fine = differences(e, start, 64, 256);
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      CAPTURE(growth);
      CAPTURE(i);
      MESSAGE("order ", std::log2(coarse[i] / fine[i]), ", error ", fine[i]);
      CHECK(std::abs(std::log2(coarse[i] / fine[i]) - 8) < 0.5);  // the next term of steps of a tenth of a radian
    }
  }
}

TEST_CASE("ExplicitStep_EndsOnTheConstraintsOfAllLevels") {
  test::SeveralCoordinates e = pendulum(0.3);
  State state = from_the_side(e);
  DormandPrince integrator;
  for (int i = 0; i < 20; ++i) {
    REQUIRE(integrator.step(e, state, 0.1, {}).solved());
    const double radius = 1 + 0.3 * state.t;
    constexpr double round_off = 1e-12;  // of sums of squares of up to a hundred
    CHECK(std::abs(state.q.norm() - radius) < round_off);
    CHECK(std::abs(state.q.dot(state.v) - 0.3 * radius) < round_off);
    CHECK(std::abs(state.q.dot(state.vdot) + state.v.squaredNorm() - 0.09) < 10 * round_off);
    CHECK((state.vdot + Vector2d(0, gravity) + state.q * state.lambda[0]).norm() < 10 * round_off);
  }
}

TEST_CASE("ExplicitStepBackInTime_ReturnsToTheStart") {
  // There with velocities reversed: the motion of a machine without losses is the same backwards.
  test::SeveralCoordinates e = pendulum();
  const State start = from_the_side(e);
  const auto distance = [&](int steps) {
    State state = after(e, start, 0.8, steps);
    state.v *= -1;
    state.t = 0;
    state = after(e, state, 0.8, steps);
    return (state.q - start.q).norm() + (state.v + start.v).norm();
  };
  MESSAGE("returns to within ", distance(20));
  CHECK(distance(20) < distance(10) / 100);  // 2^8 but for round-off
  CHECK(distance(20) < 1e-9);                // of the error of twice twenty steps of a tenth of a radian
}

TEST_CASE("ExplicitErrorEstimate_IsNotBelowTheErrorAndOfItsOrder") {
  test::SeveralCoordinates e = pendulum();
  State start = from_the_side(e);
  start = after(e, start, 0.3, 30);
  const auto step = [&](double dt, double& error) {
    State state = start;
    DormandPrince integrator;
    double estimate = 0;
    const auto check = [&](const State&, const VectorXd& found) {
      estimate = found.norm();
      return true;
    };
    REQUIRE(integrator.step(e, state, dt, check).solved());
    State exact = start;
    exact.t = 0;
    error = (state.q - after(e, exact, dt, 8).q).norm();
    return estimate;
  };
  double of_coarse = 0, of_fine = 0;
  const double coarse = step(0.2, of_coarse), fine = step(0.1, of_fine);
  MESSAGE("estimates ", coarse, ", ", fine, ", errors ", of_coarse, ", ", of_fine);
  CHECK(coarse > of_coarse);
  CHECK(fine > of_fine);
  CHECK(std::log2(coarse / fine) > 7);  // an order of eight, and terms of higher order
  CHECK(std::log2(coarse / fine) < 10);
}

TEST_CASE("ExplicitStepThatIsNotAccepted_LeavesTheState") {
  test::SeveralCoordinates e = pendulum();
  State state = from_the_side(e);
  const State start = state;
  DormandPrince integrator;
  const int accepted = e.accepted;
  const auto refuse = [](const State&, const VectorXd&) { return false; };
  CHECK(integrator.step(e, state, 0.1, refuse).status == StepStatus::inaccurate);
  e.outside = [](const State& s) { return std::string(s.t > 0.05 ? "the spring breaks" : ""); };
  const StepSummary outside = integrator.step(e, state, 0.1, {});
  CHECK(outside.status == StepStatus::domain_error);
  CHECK(outside.message.find("the spring breaks") != std::string::npos);
  e.outside = {};
  e.mass(0, 0) = e.mass(1, 1) = 0;
  const StepSummary massless = integrator.step(e, state, 0.1, {});
  CHECK(massless.status == StepStatus::singular);
  CHECK(massless.message.find("no inertia") != std::string::npos);
  CHECK(e.accepted == accepted);
  CHECK(state.t == start.t);
  CHECK(state.q == start.q);
  CHECK(state.v == start.v);
  CHECK(state.lambda == start.lambda);
}

TEST_CASE("RepeatedExplicitStep_IsTheSame") {
  // There is no history: a step after a refused one is that of an integrator which has taken none.
  test::SeveralCoordinates e = pendulum();
  State one_way = from_the_side(e);
  State other = one_way;
  DormandPrince integrator, fresh;
  const auto refuse = [](const State&, const VectorXd&) { return false; };
  REQUIRE_FALSE(integrator.step(e, one_way, 0.2, refuse).solved());
  REQUIRE(integrator.step(e, one_way, 0.1, {}).solved());
  REQUIRE(fresh.step(e, other, 0.1, {}).solved());
  CHECK((one_way.q - other.q).norm() < 1e-15);  // round-off by another pivot order
}

}  // namespace dormand_prince_test
}  // namespace hersey::solver
