#include "hersey/solver/initialise.h"

#include <doctest/doctest.h>

#include "kkt.h"
#include "one_coordinate.h"

namespace hersey::solver {
namespace initialise_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST_CASE("Acceleration_FollowsTheForce") {
  test::OneCoordinate e;
  e.mass = 2;
  e.force = [](double, double, double) { return -6.0; };
  State s = e.at(1, 4);
  REQUIRE(initialise(e, s).solved());
  CHECK(s.q[0] == 1);
  CHECK(s.v[0] == 4);
  CHECK(s.vdot[0] == doctest::Approx(3).epsilon(1e-15));  // round-off
  CHECK(e.accepted == 1);
}

TEST_CASE("Constraint_TakesPositionVelocityAndForce") {
  test::OneCoordinate e;
  e.copies_of_constraint = 1;
  e.force = [](double, double, double) { return -6.0; };
  State s = e.at(1, 4);
  REQUIRE(initialise(e, s).solved());
  CHECK(std::abs(s.q[0]) < 1e-12);  // rtol of the assembly
  // Round-off of direct solutions.
  CHECK(std::abs(s.v[0]) < 1e-12);
  CHECK(std::abs(s.vdot[0]) < 1e-12);
  CHECK(s.lambda[0] == doctest::Approx(6).epsilon(1e-14));  // round-off
}

TEST_CASE("RedundantRows_AreNamed") {
  test::OneCoordinate e;
  e.copies_of_constraint = 2;
  State s = e.at(1, 0);
  const InitialiseSummary summary = initialise(e, s);
  CHECK(summary.status == InitialiseStatus::redundant);
  CHECK(summary.redundant == std::vector<std::string>{"stop 1", "stop 2"});
  CHECK(s.q[0] == 1);  // unchanged
}

TEST_CASE("MotionWithoutInertia_IsNamed") {
  test::OneCoordinate e;
  e.mass = 0;
  State s = e.at(1, 0);
  s.vdot.setZero();
  const InitialiseSummary summary = initialise(e, s);
  CHECK(summary.status == InitialiseStatus::undetermined);
  CHECK(summary.undetermined == std::vector<std::string>{"mass"});
}

TEST_CASE("ClosedGapAtTheStart_IsADomainError") {
  test::OneCoordinate e;
  e.lowest = 2;
  State s = e.at(1, 0);
  const InitialiseSummary summary = initialise(e, s);
  CHECK(summary.status == InitialiseStatus::domain_error);
  CHECK(summary.message.find("gap closed") != std::string::npos);
}

TEST_CASE("RankAnalysis_NamesEveryRowOfADependency") {
  MatrixXd G(4, 5);
  G << 1, 2, 0, 0, 1,  //
      0, 1, 3, 0, 0,   //
      0, 0, 0, 7, 0,   //
      2, 5, 3, 0, 2;   // twice the first and the second
  const RankAnalysis analysis = analyse_rank(G);
  CHECK(analysis.rank == 3);
  CHECK(analysis.involved == std::vector<Eigen::Index>{0, 1, 3});
}

TEST_CASE("Kkt_SolvesBothEquationsWithInertiasFarApart") {
  // Inertias over twelve decades, as of a crankshaft and a spring's end.
  MatrixXd M = VectorXd((VectorXd(4) << 1e3, 1, 1e-4, 1e-9).finished()).asDiagonal();
  M(0, 1) = M(1, 0) = 3;
  MatrixXd G(2, 4);
  G << 1, 0, 2, 0, 0, 1, 0, 1e3;
  const VectorXd h = (VectorXd(4) << 1, -2, 3, 0.5).finished(), gamma = (VectorXd(2) << 4, -5).finished();
  const AccelerationSolution s = solve_kkt(M, G, h, gamma);
  REQUIRE(s.undetermined.empty());
  // Relative to the terms that each row adds up.
  const VectorXd forces =
      M.cwiseAbs() * s.vdot.cwiseAbs() + G.transpose().cwiseAbs() * s.lambda.cwiseAbs() + h.cwiseAbs();
  const VectorXd motions = G.cwiseAbs() * s.vdot.cwiseAbs() + gamma.cwiseAbs();
  // Direct with refinement: far above round-off, far below a row that is missed.
  CHECK((M * s.vdot + G.transpose() * s.lambda + h).cwiseQuotient(forces).cwiseAbs().maxCoeff() < 1e-9);
  CHECK((G * s.vdot + gamma).cwiseQuotient(motions).cwiseAbs().maxCoeff() < 1e-9);
}

}  // namespace initialise_test
}  // namespace hersey::solver
