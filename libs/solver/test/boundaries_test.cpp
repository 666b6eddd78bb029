#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "hersey/solver/fixed_point_iteration.h"
#include "hersey/solver/gmres.h"
#include "hersey/solver/sparse_lu.h"
#include "hersey/solver/step_control.h"
#include "hersey/solver/symmetric_factor.h"

// Solvers without unknowns, without a solution, or without new information.
namespace hersey::solver {
namespace boundaries_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

void copy(const Eigen::VectorXd& b, Eigen::VectorXd& x) { x = b; }

TEST_CASE("Gmres_OfAZeroOperator_ReportsIt") {
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(5);
  Gmres gmres;
  Eigen::VectorXd x;
  const auto nothing = [](const Eigen::VectorXd& v, Eigen::VectorXd& y) { y.setZero(v.size()); };
  const GmresSummary summary = gmres.solve(nothing, copy, b, {.max_iterations = 20}, x);
  CHECK(!summary.solved());
  CHECK(summary.iterations == 1);  // it ends there
  CHECK(summary.message.find("stays where it is") != std::string::npos);
  CHECK(x.isZero(0));
  CHECK(summary.residual_norm == b.norm());
}

TEST_CASE("Gmres_OfValuesThatAreNoNumbers_Ends") {
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  Gmres gmres;
  Eigen::VectorXd x;
  const GmresSummary of_b = gmres.solve(copy, copy, Eigen::VectorXd::Constant(3, no_number), {.max_iterations = 20}, x);
  CHECK(!of_b.solved());
  CHECK(of_b.iterations == 0);
  const auto invalid = [&](const Eigen::VectorXd& v, Eigen::VectorXd& y) { y = v, y[1] = no_number; };
  const GmresSummary of_A = gmres.solve(invalid, copy, Eigen::VectorXd::Ones(3), {.max_iterations = 20}, x);
  CHECK(!of_A.solved());
  CHECK(of_A.iterations == 1);
}

// Aitken's factor is the ratio of two changes: two equal answers of an exchange give no information about it.
TEST_CASE("Aitken_KeepsItsFactorWhereNothingChanges") {
  FixedPointIteration iteration(Acceleration::aitken, 0.5);
  iteration.begin_step();
  const Eigen::Vector2d x(1, 2), image(2, 4);
  const Eigen::VectorXd first = iteration.next(x, image);
  CHECK((first - (x + 0.5 * (image - x))).norm() == 0);
  CHECK((iteration.next(x, image) - first).norm() == 0);
}

// Two changes along one line are one: what the second leaves beside it is round-off, and is not divided by.
TEST_CASE("QuasiNewton_CountsParallelChangesAsOne") {
  FixedPointIteration iteration(Acceleration::quasi_newton, 1);
  iteration.begin_step();
  const Eigen::Vector3d along(1, -2, 0.5), start(0.3, 0.1, 0.2);
  const auto image = [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(0.5 * x + start); };
  Eigen::VectorXd x;
  for (const double step : {0.0, 1.0, 3.0}) x = iteration.next(start + step * along, image(start + step * along));
  CHECK(x.allFinite());
  // The image's slope is a half: along that line it takes the residual to nothing, across it leaves what images are.
  const Eigen::Vector3d fixed = 2 * start, missing = fixed - x;
  CHECK(std::abs(missing.dot(along)) < 64 * eps * fixed.norm() * along.norm());  // round-off of sums of three
}

TEST_CASE("SymmetricFactor_OfNothingYet") {
  SymmetricFactor factor;
  CHECK(factor.size() == 0);
  CHECK(factor.memory_estimate() == 0);
  CHECK(!factor.factorised());
  Eigen::SparseMatrix<double> A(3, 3);
  A.setIdentity();
  A.makeCompressed();
  factor.set_memory_limit(1e12);  // given before the pattern, it stays
  factor.analyse(A);
  CHECK(factor.size() == 3);
  REQUIRE(factor.factorise(A).solved());
  Eigen::MatrixXd none(3, 0);
  factor.solve(none);  // nothing to solve for is solved
  CHECK(none.cols() == 0);
}

TEST_CASE("StepControl_WithoutErrorsGrowsByAThirdAtATime") {
  StepControl control({.smallest = 1e-6, .largest = 1}, 1e-3);
  control.accepted(1e-3, Eigen::VectorXd());
  CHECK(control.dt() > 1e-3);
  CHECK(control.dt() < 1.4e-3);
}

TEST_CASE("StepControl_InPartsOfAUnit_ShortensAndWaitsAfterARejection") {
  const StepControlOptions options{.smallest = 1e-5, .largest = 1, .unit = 1e-3};
  const Eigen::VectorXd small = Eigen::VectorXd::Constant(1, 1e-6), large = Eigen::VectorXd::Constant(1, 0.99);
  StepControl control(options, 1e-3);
  control.accepted(1e-3, large);  // beyond the aim, though within the tolerance
  CHECK(control.dt() < options.unit);
  StepControl again(options, 1e-3);
  REQUIRE(again.rejected(1e-3, 20));
  const double shorter = again.dt();
  CHECK(shorter < options.unit);
  const double part = again.proposed(1);
  again.accepted(part, small);  // the error would allow twice as much: not right after a rejection
  CHECK(again.dt() <= shorter);
  again.accepted(again.proposed(1), small);
  CHECK(again.dt() > shorter);
  // No part of the unit is as small as what is left: that is taken as it is.
  CHECK(control.proposed(2e-6) == doctest::Approx(2e-6).scale(0).epsilon(4 * eps));
}

}  // namespace boundaries_test
}  // namespace hersey::solver
