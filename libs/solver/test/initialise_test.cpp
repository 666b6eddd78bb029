#include "hersey/solver/initialise.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "kkt.h"
#include "one_coordinate.h"
#include "several_coordinates.h"

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

TEST_CASE("CondensedUnknownsAtTheStart_AreSolvedOrReported") {
  test::SeveralCoordinates e(MatrixXd::Identity(1, 1));
  e.force = [](const VectorXd&, const VectorXd&, double) { return VectorXd(VectorXd::Constant(1, -3)); };
  e.unsolved = 40;
  State s = e.at(VectorXd::Zero(1));
  REQUIRE(initialise(e, s).solved());
  CHECK(s.vdot[0] == doctest::Approx(3));
  CHECK(e.assembled == 40);
  e.unsolved = 1000;
  const InitialiseSummary summary = initialise(e, s);
  CHECK(summary.status == InitialiseStatus::domain_error);
  CHECK(summary.message.find("what is condensed is not solved in 60 iterations") != std::string::npos);
}

TEST_CASE("RankAnalysis_OfIndependentRowsOrNone_NamesNone") {
  CHECK(analyse_rank(MatrixXd(0, 3)).involved.empty());
  const RankAnalysis full = analyse_rank((MatrixXd(2, 3) << 1, 2, 3, 0, 1, 1e-3).finished());
  CHECK(full.rank == 2);
  CHECK(full.involved.empty());
  const RankAnalysis zero = analyse_rank((MatrixXd(2, 3) << 1, 2, 3, 0, 0, 0).finished());
  CHECK(zero.rank == 1);
  CHECK(zero.involved == std::vector<Eigen::Index>{1});  // an empty row depends on no other
}

/// Returns whether the rows are independent, by elimination or, if that is not conclusive, by QR.
TEST_CASE("Rank_IsFullDownToRowsThatDifferByRoundOff") {
  const auto full = [](const MatrixXd& G) { return has_full_rank(G.sparseView(1, 0)); };
  for (const double apart : {1.0, 1e-4, 1e-7, 1e-9}) {
    CAPTURE(apart);
    CHECK(full((MatrixXd(2, 3) << 1, 1, 0, 1, 1 + apart, 0).finished()));
  }
  CHECK(!full((MatrixXd(2, 3) << 1, 1, 0, 1, 1 + 1e-13, 0).finished()));
  CHECK(!full((MatrixXd(2, 3) << 1, 1, 0, 0, 0, 0).finished()));
  CHECK(!full(MatrixXd::Identity(3, 2)));
}

TEST_CASE("MotionsThatConstraintsTake_NeedNoInertia") {
  const auto bordered = [](const MatrixXd& M, const MatrixXd& G) {
    MatrixXd S = MatrixXd::Zero(M.rows() + G.rows(), M.rows() + G.rows());
    S.topLeftCorner(M.rows(), M.rows()) = M;
    S.topRightCorner(M.rows(), G.rows()) = G.transpose();
    S.bottomLeftCorner(G.rows(), M.rows()) = G;
    return Equations::SparseMatrix(S.sparseView(1, 0));
  };
  const MatrixXd both = MatrixXd::Identity(2, 2), first = both.topRows(1), light = Eigen::Vector2d(1, 0).asDiagonal();
  CHECK(massless_motions(bordered(light, both), 2).cols() == 0);  // none is free
  CHECK(massless_motions(bordered(both, first), 2).cols() == 0);  // what is free has inertia
  const MatrixXd loose = massless_motions(bordered(light, first), 2);
  REQUIRE(loose.cols() == 1);
  CHECK(loose(0, 0) == 0);
  CHECK(loose(1, 0) != 0);
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

/// `units` of three coordinates each, constrained by two rows that nearly depend on each other: elimination's smallest
/// pivot is the square of `apart`. The free coordinates of the first two have `inertia` where they move against each
/// other.
Equations::SparseMatrix nearly_dependent_rows(int units, double apart, double inertia) {
  std::vector<Eigen::Triplet<double>> entries;
  const int nv = 3 * units;
  for (int unit = 0; unit < units; ++unit) {
    const int x = 3 * unit, row = nv + 2 * unit;
    for (int k = 0; k < 3; ++k) entries.emplace_back(x + k, x + k, 1.0);
    const std::vector<Eigen::Triplet<double>> rows{
        {row, x, 1}, {row, x + 1, 1}, {row + 1, x, 1}, {row + 1, x + 1, 1 + apart}};
    for (const auto& entry : rows) {
      entries.push_back(entry);
      entries.emplace_back(entry.col(), entry.row(), entry.value());
    }
  }
  for (int unit = 1; unit < units; unit += 2) {
    const double shared = unit == 1 ? 1 - inertia : 0.4;
    entries.emplace_back(3 * unit + 2, 3 * unit - 1, shared);
    entries.emplace_back(3 * unit - 1, 3 * unit + 2, shared);
  }
  Equations::SparseMatrix S(5 * units, 5 * units);
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

// A dense decomposition of 20,000 unknowns would take far too long.
TEST_CASE("LongChain_NeedsNoDenseDecompositionWhereItsConditionIsPoor") {
  const int units = 4000, nv = 3 * units;
  const Equations::SparseMatrix S = nearly_dependent_rows(units, 1e-6, 1);
  const VectorXd vdot = VectorXd::LinSpaced(nv, -1, 2), lambda = VectorXd::LinSpaced(2 * units, 3, 1);
  VectorXd exact(5 * units);
  exact << vdot, lambda;
  const VectorXd b = S * exact;
  const AccelerationSolution s = solve_kkt(S, nv, -b.head(nv), -b.tail(2 * units));
  REQUIRE(s.undetermined.empty());
  VectorXd found(5 * units);
  found << s.vdot, s.lambda;
  CHECK((S * found - b).norm() < 1e-13 * b.norm());  // refined until it is round-off
  // Round-off times the condition of two rows 1e-6 apart, once for motions and squared for multipliers.
  CHECK((s.vdot - vdot).norm() < 1e-8 * vdot.norm());
}

TEST_CASE("MotionWithoutInertia_IsNamedAmongRowsOfPoorConditionToo") {
  const int units = 20, nv = 3 * units;
  for (const double inertia : {0.0, 1e-14}) {
    const Equations::SparseMatrix S = nearly_dependent_rows(units, 1e-6, inertia);
    const AccelerationSolution s = solve_kkt(S, nv, VectorXd::Ones(nv), VectorXd::Zero(2 * units));
    CHECK(s.undetermined == std::vector<Eigen::Index>{2, 5});
  }
}

// Rows a trillionth apart: elimination's pivots lie as far apart as its condition allows, and yet the motion that is
// left has inertia.
TEST_CASE("MotionBesideRowsOfPoorCondition_IsSolved") {
  const Equations::SparseMatrix S = nearly_dependent_rows(1, 1e-12, 1);
  const VectorXd h = Eigen::Vector3d(3, -1, 2);
  const AccelerationSolution s = solve_kkt(S, 3, h, VectorXd::Zero(2));
  REQUIRE(s.undetermined.empty());
  CHECK(std::abs(s.vdot[2] + 2) < 1e-13);  // no row touches it
  VectorXd found(5), b(5);
  found << s.vdot, s.lambda;
  b << -h, 0, 0;
  CHECK((S * found - b).norm() < 1e-14 * found.norm());  // round-off of the large forces that share the first two
}

// A QR decomposition gives the smallest increment that closes such rows.
TEST_CASE("SmallestIncrement_OfNearlyDependentRows") {
  const double apart = std::ldexp(1.0, -40);
  const MatrixXd G = (MatrixXd(2, 3) << 1, 1, 1, 1, 1 + apart, 1).finished();
  const VectorXd weight = Eigen::Vector3d(1, 2, 0.5), residual = Eigen::Vector2d(-3, -3 - 2 * apart);
  const VectorXd dx = smallest_increment(G.sparseView(1, 0), residual, weight);
  CHECK((G * dx + residual).norm() < 1e-13);  // round-off of sums of a few
  const double few_digits = 1e-2;             // a hundred times round-off over what the rows are apart
  CHECK(std::abs(dx[1] - 2) < few_digits);
  // The rest is shared by the squares of the weights.
  CHECK(std::abs(dx[0] - 1 / 1.25) < few_digits);
  CHECK(std::abs(dx[2] - 0.25 / 1.25) < few_digits);
}

}  // namespace initialise_test
}  // namespace hersey::solver
