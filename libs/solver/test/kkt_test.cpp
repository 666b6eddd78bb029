#include "kkt.h"

#include <doctest/doctest.h>

#include <random>

// Linear algebra of constraints: against dense decompositions, and whatever the units of rows and coordinates.
namespace hersey::solver {
namespace kkt_test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
constexpr double eps = std::numeric_limits<double>::epsilon();

MatrixXd random(Index rows, Index columns, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> part(-1, 1);
  MatrixXd A(rows, columns);
  for (double& value : A.reshaped()) value = part(engine);
  return A;
}

/// Powers of ten, one after another, from 10^-most to 10^most.
VectorXd units(Index n, int most) {
  VectorXd u(n);
  for (Index i = 0; i < n; ++i)
    u[i] = std::pow(10.0, most * (2 * static_cast<double>(i) / static_cast<double>(n - 1) - 1));
  return u;
}

Equations::SparseMatrix bordered(const MatrixXd& M, const MatrixXd& G) {
  MatrixXd S = MatrixXd::Zero(M.rows() + G.rows(), M.rows() + G.rows());
  S.topLeftCorner(M.rows(), M.rows()) = M;
  S.bottomLeftCorner(G.rows(), M.rows()) = G;
  S.topRightCorner(M.rows(), G.rows()) = G.transpose();
  return S.sparseView();
}

TEST_CASE("DependentRows_AreFoundInAnyUnits") {
  MatrixXd G = random(5, 8, 1);
  G.row(3) = 2 * G.row(0) - G.row(4);
  for (const int most : {0, 9}) {
    CAPTURE(most);
    const MatrixXd scaled = units(5, most).asDiagonal() * G;
    const RankAnalysis found = analyse_rank(scaled);
    CHECK(found.rank == 4);
    CHECK(found.involved == std::vector<Index>{0, 3, 4});
    CHECK_FALSE(has_full_rank(scaled.sparseView()));
    CHECK(has_full_rank(scaled.topRows(3).sparseView()));
    CHECK(analyse_rank(scaled.topRows(3)).involved.empty());
  }
  MatrixXd with_zero = random(3, 4, 2);
  with_zero.row(1).setZero();
  CHECK(analyse_rank(with_zero).rank == 2);
  CHECK_FALSE(has_full_rank(with_zero.sparseView()));
  CHECK_FALSE(has_full_rank(random(4, 3, 3).sparseView()));
  CHECK(has_full_rank(random(4, 4, 3).sparseView()));
  CHECK(has_full_rank(Equations::SparseMatrix(0, 3)));
}

TEST_CASE("SmallestIncrement_IsThatOfThePseudoInverse") {
  MatrixXd G = random(3, 7, 4);
  const VectorXd residual = random(3, 1, 5), weight = VectorXd::Ones(7) + 0.9 * random(7, 1, 6);
  for (const double apart : {1.0, 1e-7}) {  // elimination; rows so nearly dependent that the QR decomposition is used
    CAPTURE(apart);
    G.row(2) = G.row(0) + apart * random(1, 7, 7);
    const MatrixXd scaled = G * weight.asDiagonal();
    const VectorXd expected = weight.cwiseProduct(scaled.completeOrthogonalDecomposition().solve(-residual));
    const VectorXd dx = smallest_increment(G.sparseView(), residual, weight);
    CHECK((dx - expected).norm() < 1000 * eps / apart * expected.norm());  // round-off, by the condition
  }
  CHECK(smallest_increment(Equations::SparseMatrix(0, 3), VectorXd(0), VectorXd::Ones(3)) == VectorXd::Zero(3));
}

TEST_CASE("Accelerations_AreThoseOfTheWholeSystemInAnyUnits") {
  const MatrixXd A = random(6, 6, 8);
  const VectorXd u = units(6, 4);
  const MatrixXd M = u.asDiagonal() * (A * A.transpose() + MatrixXd::Identity(6, 6)) * u.asDiagonal();
  const MatrixXd G = random(2, 6, 9) * u.asDiagonal();
  const VectorXd h = u.asDiagonal() * random(6, 1, 10), gamma = random(2, 1, 11);
  const auto sparse = bordered(M, G);
  for (const AccelerationSolution& found : {solve_kkt(M, G, h, gamma), solve_kkt(sparse, 6, h, gamma)}) {
    REQUIRE(found.undetermined.empty());
    const VectorXd force = M * found.vdot + G.transpose() * found.lambda + h;
    CHECK(force.cwiseQuotient(u).norm() < 1e4 * eps);  // round-off, at a condition of some tens
    CHECK((G * found.vdot + gamma).norm() < 1e4 * eps);
  }
}

// A coordinate without inertia moves as a constraint prescribes; without such a constraint it is named.
TEST_CASE("CoordinateWithoutInertia_NeedsAConstraint") {
  MatrixXd M = VectorXd{{2.0, 0.0, 3.0}}.asDiagonal();
  const VectorXd h{{1.0, 0.0, 0.0}}, gamma{{0.5}};
  const MatrixXd holding{{1.0, -1.0, 0.0}}, idle{{1.0, 0.0, 0.0}};
  // The second coordinate's row leaves no force in the constraint.
  for (const AccelerationSolution& found :
       {solve_kkt(M, holding, h, gamma), solve_kkt(bordered(M, holding), 3, h, gamma)}) {
    REQUIRE(found.undetermined.empty());
    CHECK((found.vdot - VectorXd{{-0.5, 0.0, 0.0}}).norm() < 100 * eps);
    CHECK(std::abs(found.lambda[0]) < 100 * eps);
  }
  CHECK(solve_kkt(M, idle, h, gamma).undetermined == std::vector<Index>{1});
  CHECK(solve_kkt(bordered(M, idle), 3, h, gamma).undetermined == std::vector<Index>{1});
  CHECK(massless_motions(bordered(M, holding), 3).cols() == 0);
  const MatrixXd left = massless_motions(bordered(M, idle), 3);
  REQUIRE(left.cols() == 1);
  CHECK(std::abs(left(1, 0)) == doctest::Approx(left.norm()));
}

}  // namespace kkt_test
}  // namespace hersey::solver
