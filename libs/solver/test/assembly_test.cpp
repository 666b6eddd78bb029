#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hersey/solver/initialise.h"
#include "several_coordinates.h"

// Constraints are closed from a guess, theory manual eq. (integrator.21): fixed components are kept where possible, and
// constraints that cannot be closed are reported with the closest configuration.
namespace hersey::solver {
namespace assembly_test {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Constraints are closed to 1e-12 of what they compare, of slopes of one half and more.
constexpr double asked = 1e-12, closed = 1e-11;

VectorXd one(double value) { return VectorXd::Constant(1, value); }

test::SeveralCoordinates circle() {
  test::SeveralCoordinates e(Matrix2d::Identity(), 1);
  e.phi = [](const VectorXd& q, double) { return one(q.squaredNorm() - 1); };
  e.G = [](const VectorXd& q, double) { return MatrixXd(2 * q.transpose()); };
  return e;
}

TEST_CASE("FixedCoordinates_AreKeptIfTheOthersCanClose") {
  test::SeveralCoordinates e = circle();
  State state = e.at(Vector2d(0.6, 0.9));
  const InitialiseSummary summary = initialise(e, state, {.fixed = {0}});
  REQUIRE(summary.solved());
  CHECK(summary.conflict.empty());
  CHECK(state.q[0] == 0.6);
  CHECK(std::abs(state.q[1] - 0.8) < closed);  // rtol of the constraint, over the slope of 1.6
  CHECK(summary.residual <= asked);
}

TEST_CASE("FixedCoordinates_ThatConflict_MoveByTheLeast") {
  test::SeveralCoordinates e = circle();
  for (const double far : {1.001, 2.0}) {  // a rounded value, and one for which all fixed values must be released
    CAPTURE(far);
    State state = e.at(far * Vector2d(0.6, 0.8));
    const InitialiseSummary summary = initialise(e, state, {.fixed = {0, 1}});
    REQUIRE(summary.solved());
    REQUIRE(summary.conflict.size() == 1);
    CHECK(summary.conflict[0].name == "constraint 0");
    CHECK(summary.conflict[0].size == doctest::Approx(far * far - 1));  // what was open with both at rest
    // The solution is the nearest point of the circle; one free and one fixed component would leave the line from its
    // centre.
    CHECK((state.q - Vector2d(0.6, 0.8)).norm() < 1e-9);
  }
}

/// 1 + y^2 = 4 x y: at x = 0 nothing can be done by y, and from y = 0 nothing by x.
test::SeveralCoordinates saddle() {
  test::SeveralCoordinates e(Matrix2d::Identity(), 1);
  e.phi = [](const VectorXd& q, double) { return one(1 + q[1] * q[1] - 4 * q[0] * q[1]); };
  e.G = [](const VectorXd& q, double) { return MatrixXd(Vector2d(-4 * q[1], 2 * q[1] - 4 * q[0]).transpose()); };
  return e;
}

TEST_CASE("WhereTheSearchWithFixedCoordinatesEnds_TheGuessAndItsNeighbourhoodAreTried") {
  for (const double y : {0.8, 0.0}) {  // with x fixed y tends to 0, where the iteration stops; it begins at 0
    CAPTURE(y);
    test::SeveralCoordinates e = saddle();
    State state = e.at(Vector2d(0, y));
    const InitialiseSummary summary = initialise(e, state, {.fixed = {0}});
    REQUIRE(summary.solved());
    REQUIRE(summary.conflict.size() == 1);
    CHECK(summary.conflict[0].size == doctest::Approx(1));
    CHECK(std::abs(e.phi(state.q, 0)[0]) < closed);
  }
}

TEST_CASE("DeformationsMove_OnlyWhereNothingElseCloses") {
  test::SeveralCoordinates e(Matrix2d::Identity(), 1);  // a gap of one that coordinate 0 may close by a half
  e.phi = [](const VectorXd& q, double) { return one(0.5 * std::tanh(q[0]) + q[1] - 1); };
  e.G = [](const VectorXd& q, double) { return MatrixXd(Vector2d(0.5 / std::pow(std::cosh(q[0]), 2), 1).transpose()); };
  State rigid = e.at(Vector2d(0, 0.8)), both = e.at(Vector2d(0, 0));
  REQUIRE(initialise(e, rigid, {.stiff = {1}}).solved());
  CHECK(rigid.q[1] == 0.8);
  CHECK(std::abs(std::tanh(rigid.q[0]) - 0.4) < closed);
  const InitialiseSummary summary = initialise(e, both, {.stiff = {1}});
  REQUIRE(summary.solved());
  CHECK(both.q[1] > 0.5);
  CHECK(std::abs(e.phi(both.q, 0)[0]) < closed);
}

TEST_CASE("LoopThatCannotClose_IsReportedWithItsLargestConstraintFirst") {
  test::SeveralCoordinates e(Matrix2d::Identity(), 2);
  e.phi = [](const VectorXd& q, double) { return VectorXd(Vector2d(1 + q[0] * q[0], 3 + q[1] * q[1])); };
  e.G = [](const VectorXd& q, double) { return MatrixXd((2 * q).asDiagonal()); };
  State state = e.at(Vector2d(0.3, -0.2));
  const State start = state;
  const InitialiseSummary apart = initialise(e, state);
  CHECK(apart.status == InitialiseStatus::cannot_assemble);
  REQUIRE(apart.open.size() == 2);
  CHECK(apart.open[0].name == "constraint 1");
  CHECK(apart.open[0].size == doctest::Approx(3));
  CHECK(apart.open[1].size == doctest::Approx(1));
  CHECK(apart.message.find("constraint 1 by 3; constraint 0 by 1;") != std::string::npos);
  CHECK(state.q == start.q);
  CHECK(e.accepted == 0);
  // Rows of one joint are one: their distance is that of its ends.
  e.names = {"coordinate 0", "coordinate 1", "joint", "joint"};
  CHECK(!initialise(e, state, {.stiff = {0}}).solved());  // nor do deformations close it
  const InitialiseSummary together = initialise(e, state);
  REQUIRE(together.open.size() == 1);
  CHECK(together.open[0].name == "joint");
  CHECK(together.open[0].size == doctest::Approx(std::sqrt(10.0)));
}

// Two dependent rows are reported where they contradict each other, and not where they are satisfied and another row is
// open.
TEST_CASE("DependentRows_AreReportedWhereTheyContradict") {
  test::SeveralCoordinates e(MatrixXd::Identity(3, 3), 3);
  double shift = 0.1, least = -1;
  e.phi = [&](const VectorXd& q, double) { return VectorXd(Vector3d(q[0], q[0] - shift, least + q[1] * q[1])); };
  e.G = [](const VectorXd& q, double) {
    return MatrixXd((MatrixXd(3, 3) << 1, 0, 0, 1, 0, 0, 0, 2 * q[1], 0).finished());
  };
  State state = e.at(Vector3d(0, 0.9, 0));
  const InitialiseSummary conflict = initialise(e, state);
  CHECK(conflict.status == InitialiseStatus::redundant);
  CHECK(conflict.redundant == std::vector<std::string>{"constraint 0", "constraint 1"});
  shift = 0, least = 1;
  const InitialiseSummary open = initialise(e, state);
  CHECK(open.status == InitialiseStatus::cannot_assemble);
  REQUIRE(open.open.size() == 1);
  CHECK(open.open[0].name == "constraint 2");
  // Constraints of the same name are reported once.
  shift = 0.1, e.names = {"x", "y", "z", "joint", "joint", "other"};
  CHECK(initialise(e, state).redundant == std::vector<std::string>{"joint"});
}

TEST_CASE("Guess_WithoutNumbersOrOutOfIterations_IsReportedNotFollowed") {
  test::SeveralCoordinates e = circle();
  State state = e.at(Vector2d(40, 30));
  const InitialiseSummary few = initialise(e, state, {.max_iterations = 2});
  CHECK(few.status == InitialiseStatus::cannot_assemble);
  CHECK(few.iterations <= 2 * 5);  // of each attempt
  CHECK(initialise(e, state).solved());
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  test::SeveralCoordinates invalid = circle();
  invalid.phi = [=](const VectorXd&, double) { return one(no_number); };
  state = invalid.at(Vector2d(1, 0));
  CHECK(initialise(invalid, state).status == InitialiseStatus::cannot_assemble);
  CHECK(state.q == Vector2d(1, 0));
  // A root has an infinite slope at nothing: no increment is a number.
  test::SeveralCoordinates root(MatrixXd::Identity(1, 1), 1);
  root.phi = [](const VectorXd& q, double) { return one(std::sqrt(q[0]) - 1); };
  root.G = [](const VectorXd& q, double) { return MatrixXd(one(0.5 / std::sqrt(q[0]))); };
  state = root.at(one(0));
  CHECK(initialise(root, state).solved());  // from the disturbed guess
  CHECK(std::abs(state.q[0] - 1) < closed);
}

// Where round-off keeps the residual above the tolerance, no increment makes it smaller: the rows count as closed. An
// increment that makes it larger is not taken.
TEST_CASE("Closure_EndsAtRoundOff") {
  test::SeveralCoordinates e(MatrixXd::Identity(1, 1), 1);
  e.phi = [](const VectorXd& q, double) { return one(std::sin(q[0]) - 0.3 + 1e-14); };
  e.G = [](const VectorXd& q, double) { return MatrixXd(one(std::cos(q[0]))); };
  State state = e.at(one(0.1));
  CHECK(initialise(e, state, {.rtol = 1e-18}).solved());
  CHECK(std::abs(state.q[0] - std::asin(0.3)) < 1e-13);  // that much is put on the constraint, over its slope
  // At a steep wall the first increments overshoot.
  test::SeveralCoordinates steep(MatrixXd::Identity(1, 1), 1);
  steep.phi = [](const VectorXd& q, double) { return one(std::atan(50 * q[0])); };
  steep.G = [](const VectorXd& q, double) { return MatrixXd(one(50 / (1 + 2500 * q[0] * q[0]))); };
  state = steep.at(one(0.2));
  REQUIRE(initialise(steep, state).solved());
  CHECK(std::abs(state.q[0]) < asked);
}

// Rows that are the same a hundred times over, near where they close: the damping is lost in their sums.
TEST_CASE("RepeatedRows_AreFoundHoweverLargeTheyAre") {
  test::SeveralCoordinates e(Matrix2d::Identity(), 2);
  e.phi = [](const VectorXd& q, double) { return VectorXd(VectorXd::Constant(2, 500 * (q[0] * q[0] - 1))); };
  e.G = [](const VectorXd& q, double) { return MatrixXd((Matrix2d() << 1000 * q[0], 0, 1000 * q[0], 0).finished()); };
  State state = e.at(Vector2d(0.8, 0));
  const InitialiseSummary summary = initialise(e, state);
  CHECK(summary.status == InitialiseStatus::redundant);
  CHECK(summary.residual < 1e-9);  // closed all the same
}

}  // namespace assembly_test
}  // namespace hersey::solver
