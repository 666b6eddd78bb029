#include "hersey/solver/symmetric_factor.h"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <limits>
#include <random>
#include <vector>

#include "hersey/core/contract.h"
#include "seeded_random.h"

namespace hersey::solver {
namespace symmetric_factor_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Graph Laplacian of a k x k x k grid, with `shift` on the diagonal: the lowest eigenvalue is `shift`.
Eigen::SparseMatrix<double> laplacian(int k, double shift) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> diagonal(static_cast<std::size_t>(k * k * k), shift);
  const auto join = [&](int a, int b) {
    entries.emplace_back(a, b, -1);
    entries.emplace_back(b, a, -1);
    ++diagonal[a];
    ++diagonal[b];
  };
  for (int a = 0; a < k * k * k; ++a) {
    if (a % k != k - 1) join(a, a + 1);
    if (a / k % k != k - 1) join(a, a + k);
    if (a / (k * k) != k - 1) join(a, a + k * k);
  }
  for (int a = 0; a < k * k * k; ++a) entries.emplace_back(a, a, diagonal[a]);
  Eigen::SparseMatrix<double> A(k * k * k, k * k * k);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

// Threads of the library that orders the unknowns find another ordering each time, from some 10^4 unknowns on.
TEST_CASE("SymmetricFactor_GivesTheSameBitsEachTime") {
  const Eigen::SparseMatrix<double> A = laplacian(26, 1);
  Eigen::MatrixXd first;
  for (int time = 0; time < 3; ++time) {
    SymmetricFactor factor;
    factor.analyse(A);
    REQUIRE(factor.factorise(A).solved());
    Eigen::MatrixXd x = seeded_random(A.rows(), 1, 5);
    factor.solve(x);
    if (time == 0) first = x;
    CHECK(x == first);
  }
}

TEST_CASE("SymmetricFactor_SolvesManyColumnsAndIsReusedForANewMatrix") {
  SymmetricFactor factor;
  factor.analyse(laplacian(12, 1));
  CHECK(factor.memory_estimate() > 0);
  for (const double shift : {1.0, 7.0}) {
    const Eigen::SparseMatrix<double> A = laplacian(12, shift);
    REQUIRE(factor.factorise(A).solved());
    const Eigen::MatrixXd b = seeded_random(A.rows(), 9, 3);
    Eigen::MatrixXd x = b;
    factor.solve(x);
    CHECK((A * x - b).norm() < 1000 * eps * b.norm());
    Eigen::MatrixXd wide(A.rows() + 3, 2);  // columns that do not lie end to end
    wide.topRows(A.rows()) = b.leftCols(2);
    factor.solve(wide.topRows(A.rows()));
    CHECK((wide.topRows(A.rows()) - x.leftCols(2)).norm() < 1000 * eps * x.norm());
  }
}

TEST_CASE("SymmetricFactor_ReadsTheLowerTriangle") {
  const Eigen::SparseMatrix<double> A = laplacian(6, 1);
  const Eigen::SparseMatrix<double> lower = A.triangularView<Eigen::Lower>();
  SymmetricFactor factor;
  factor.analyse(lower);
  REQUIRE(factor.factorise(lower).solved());
  Eigen::MatrixXd x = A * Eigen::VectorXd::Ones(A.rows());
  factor.solve(x);
  CHECK((x.array() - 1).abs().maxCoeff() < 1000 * eps);
}

TEST_CASE("SymmetricFactor_CountsNegativeEigenvalues") {
  const Eigen::SparseMatrix<double> A = laplacian(5, -1.3);
  const Eigen::VectorXd lambda = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(A)).eigenvalues();
  SymmetricFactor factor;
  factor.analyse(A);
  const FactorSummary summary = factor.factorise(A);
  REQUIRE(summary.solved());
  CHECK(summary.negative_pivots == (lambda.array() < 0).count());
  CHECK(summary.negative_pivots > 3);
}

TEST_CASE("SingularMatrix_IsReportedWithItsNullity") {
  for (const double unit : {1e-9, 1.0, 1e12}) {
    Eigen::SparseMatrix<double> A = unit * laplacian(8, 0);  // every component of the graph floats
    SymmetricFactor factor;
    factor.analyse(A);
    const FactorSummary summary = factor.factorise(A);
    CHECK(summary.status == FactorStatus::singular);
    CHECK(summary.null_unknowns.size() == 1);
    CHECK(summary.message == "the matrix is singular: 1 of its 512 pivots vanish");
    Eigen::MatrixXd b = Eigen::MatrixXd::Ones(A.rows(), 1);
    CHECK_THROWS_AS(factor.solve(b), ContractError);
    A.coeffRef(0, 0) += unit;  // no longer free
    CHECK(factor.factorise(A).solved());
  }
}

TEST_CASE("FactorLargerThanTheMemory_IsRefusedWithTheFigure") {
  const Eigen::SparseMatrix<double> A = laplacian(20, 1);
  SymmetricFactor factor;
  factor.analyse(A);
  factor.set_memory_limit(factor.memory_estimate() / 2);
  const FactorSummary summary = factor.factorise(A);
  CHECK(summary.status == FactorStatus::too_large);
  CHECK(summary.message.find("a factor of 8000 unknowns needs about") != std::string::npos);
  factor.set_memory_limit(2 * factor.memory_estimate());
  CHECK(factor.factorise(A).solved());
}

/// [0, B; B^T, 0] with `per` entries a row beside a weak diagonal of B: no pivot lies on its own diagonal, and as many
/// eigenvalues are negative as B has rows.
Eigen::SparseMatrix<double> saddle(int n, int per) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> value(-1, 1);
  std::uniform_int_distribution<int> column(0, n - 1);
  std::vector<Eigen::Triplet<double>> entries;
  const auto set = [&](int i, int j, double b) {
    entries.emplace_back(i, n + j, b);
    entries.emplace_back(n + j, i, b);
  };
  for (int i = 0; i < 2 * n; ++i) entries.emplace_back(i, i, 0.0);
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < per; ++k) {
      const int j = column(generator);
      set(i, j, value(generator));
    }
    set(i, i, 1e-3);
  }
  Eigen::SparseMatrix<double> A(2 * n, 2 * n);
  A.setFromTriplets(entries.begin(), entries.end());
  A.makeCompressed();
  return A;
}

// Delayed pivots need memory that cannot be predicted from the pattern alone: more of it is provided, and where that is
// insufficient, too, the factorisation reports it.
TEST_CASE("DelayedPivots_GetMemoryOrAreReported") {
  for (const int per : {3, 6}) {
    CAPTURE(per);
    const Eigen::SparseMatrix<double> A = saddle(1000, per);
    SymmetricFactor factor;
    factor.analyse(A);
    const FactorSummary summary = factor.factorise(A);
    CHECK(factor.factorised() == summary.solved());
    if (!summary.solved()) {
      CHECK(per == 6);
      CHECK(summary.status == FactorStatus::failed);
      CHECK(summary.message.find("the factorisation ended with MUMPS error -9") == 0);
      continue;
    }
    CHECK(summary.negative_pivots == 1000);
    const Eigen::MatrixXd b = seeded_random(2000, 1, 3);
    Eigen::MatrixXd x = b;
    factor.solve(x);
    // Backward: entries are of one, and pivots at least a hundredth of their column.
    CHECK((A * x - b).norm() < 1e5 * eps * x.norm());
  }
}

TEST_CASE("MatrixWithANotANumber_IsNotFactorised") {
  Eigen::SparseMatrix<double> A = laplacian(3, 1);
  SymmetricFactor factor;
  factor.analyse(A);
  A.coeffRef(2, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK(factor.factorise(A).status == FactorStatus::failed);
}

}  // namespace symmetric_factor_test
}  // namespace hersey::solver
