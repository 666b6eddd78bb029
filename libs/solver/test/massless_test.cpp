#include "massless.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hersey/solver/initialise.h"
#include "one_coordinate.h"
#include "several_coordinates.h"

// Motions without inertia have the rates at which the forces along them vanish, theory manual eq. (integrator.10).
namespace hersey::solver {
namespace massless_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double solved = 1e-9;  // forces vanish to 1e-10 of their terms

/// No mass, and a damper that answers a rate with `force`.
test::OneCoordinate damper(double (*force)(double), double (*slope)(double)) {
  test::OneCoordinate e;
  e.mass = 0;
  e.force = [=](double, double v, double) { return force(v); };
  e.force_by_v = [=](double, double v, double) { return slope(v); };
  return e;
}

MasslessSummary balance(Equations& e, State& state) {
  return balance_massless(e, state, MatrixXd::Identity(e.nv(), e.nv()));
}

TEST_CASE("MasslessMotion_IsBalancedWhereNewtonsMethodRunsAway") {
  test::OneCoordinate e = damper([](double v) { return std::atan(5 * (v - 1)); },
                                 [](double v) { return 5 / (1 + 25 * (v - 1) * (v - 1)); });
  State state = e.at(0, 3);
  REQUIRE(balance(e, state).solved());
  CHECK(std::abs(state.v[0] - 1) < solved);
}

TEST_CASE("MasslessMotion_IsBalancedInsideTheDomain") {
  test::SeveralCoordinates e(MatrixXd::Zero(1, 1));  // rates at and below zero are outside
  e.force = [](const VectorXd&, const VectorXd& v, double) { return VectorXd::Constant(1, 50 - 0.5 / (v[0] * v[0])); };
  e.force_by_v = [](const VectorXd&, const VectorXd& v, double) {
    return MatrixXd::Constant(1, 1, std::pow(v[0], -3));
  };
  e.outside = [](const State& s) { return std::string(s.v[0] <= 0 ? "backwards" : ""); };
  State state = e.at(VectorXd::Zero(1), VectorXd::Ones(1));
  REQUIRE(balance(e, state).solved());
  CHECK(std::abs(state.v[0] - 0.1) < solved);
  e.force = [](const VectorXd&, const VectorXd& v, double) { return VectorXd::Constant(1, 50 + v[0]); };
  e.force_by_v = [](const VectorXd&, const VectorXd&, double) { return MatrixXd::Ones(1, 1); };
  state.v[0] = 1e-3;  // no increment is short enough
  const MasslessSummary summary = balance(e, state);
  CHECK(!summary.solved());
  CHECK(summary.message == "backwards");
  CHECK(state.v[0] == 1e-3);
}

TEST_CASE("ForcesThatNoRateBalances_AreReported") {
  const auto message_of = [](test::OneCoordinate& e, double v) {
    State state = e.at(0, v);
    state.vdot.setZero();
    const InitialiseSummary summary = initialise(e, state);
    CHECK(!summary.solved());
    CHECK(state.v[0] == v);
    return summary.message;
  };
  const std::string none = "at the start, t = 0 s: no velocity balances the forces on motions without inertia";
  test::OneCoordinate least = damper([](double v) { return 1 + v * v; }, [](double v) { return 2 * v; });
  CHECK(message_of(least, 0.9) == none);
  test::OneCoordinate flat =  // each iteration takes a ninth of what is left
      damper([](double v) { return std::pow(v, 9); }, [](double v) { return 9 * std::pow(v, 8); });
  CHECK(message_of(flat, 100) == none);
  // The forces at the start are numbers, those at the rate that would balance them are not.
  test::OneCoordinate invalid = damper(
      [](double v) { return v > -1 ? 100 + v : std::numeric_limits<double>::quiet_NaN(); }, [](double) { return 1.0; });
  CHECK(message_of(invalid, 0) == "at the start, t = 0 s: the forces are not numbers");
}

TEST_CASE("CondensedUnknowns_AreSolvedBeforeForcesAreBalanced") {
  test::OneCoordinate e = damper([](double v) { return 4 * v - 5; }, [](double) { return 4.0; });
  e.internal = 1e-3;
  State state = e.at(0, 0);
  const MasslessSummary summary = balance(e, state);
  CHECK(!summary.solved());
  CHECK(summary.message == "film of the fake is not solved");
  test::SeveralCoordinates slow(MatrixXd::Zero(1, 1));
  slow.force = [](const VectorXd&, const VectorXd& v, double) { return VectorXd(4 * v - VectorXd::Constant(1, 5)); };
  slow.force_by_v = [](const VectorXd&, const VectorXd&, double) { return MatrixXd::Constant(1, 1, 4); };
  slow.unsolved = 20;
  State other = slow.at(VectorXd::Zero(1));
  REQUIRE(balance(slow, other).solved());
  CHECK(std::abs(other.v[0] - 1.25) < solved);
  CHECK(slow.assembled == 21);  // until it is solved at the start, and once where the forces vanish
}

TEST_CASE("UnconstrainedMotions_AreNamedAlone") {
  // Only the second of three motions is damped; the third is loaded, the first is not.
  test::SeveralCoordinates e(MatrixXd::Zero(3, 3));
  e.force = [](const VectorXd&, const VectorXd& v, double) { return VectorXd(Vector3d(0, 2 * v[1] - 1, 0)); };
  e.force_by_v = [](const VectorXd&, const VectorXd&, double) { return MatrixXd(Vector3d(0, 2, 0).asDiagonal()); };
  State state = e.at(Vector3d(0, 0, 0));
  const MasslessSummary loose = balance(e, state);
  CHECK(!loose.solved());
  CHECK(loose.undetermined == std::vector<Eigen::Index>{0, 2});
  state.v[1] = 0.5;  // at rest in its balance the others are as loose
  CHECK(balance(e, state).undetermined == std::vector<Eigen::Index>{0, 2});
  CHECK(state.v[1] == 0.5);
}

// A film that fails where a light journal would settle: the start as given is inside its domain, the balance is not.
TEST_CASE("StartWhoseBalanceIsOutsideOfTheDomain_IsADomainError") {
  test::SeveralCoordinates e(Vector2d(0, 1).asDiagonal());
  e.force = [](const VectorXd&, const VectorXd& v, double) { return VectorXd(Vector2d(v[0] - 2, 0)); };
  e.force_by_v = [](const VectorXd&, const VectorXd&, double) { return MatrixXd(Vector2d(1, 0).asDiagonal()); };
  int evaluations = 0;
  e.outside = [&](const State& s) { return std::string(s.v[0] > 1 && ++evaluations > 1 ? "gap closed" : ""); };
  State state = e.at(Vector2d(0, 0));
  const InitialiseSummary summary = initialise(e, state);
  CHECK(summary.status == InitialiseStatus::domain_error);
  CHECK(summary.message == "at the start, t = 0 s: gap closed");
}

}  // namespace massless_test
}  // namespace hersey::solver
