#include "hersey/solver/sparse_lu.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "hersey/core/contract.h"
#include "seeded_random.h"

namespace hersey::solver {
namespace sparse_lu_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

std::span<const double> values(const Eigen::SparseMatrix<double>& A) {
  return {A.valuePtr(), static_cast<std::size_t>(A.nonZeros())};
}

// A periodic upwind-like matrix, unsymmetric and diagonally dominant, with random entries.
Eigen::SparseMatrix<double> ring(int n, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0.1, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 3 + uniform(generator));
    entries.emplace_back(i, (i + 1) % n, -uniform(generator));
    entries.emplace_back(i, (i + n - 1) % n, -uniform(generator));
  }
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  A.makeCompressed();
  return A;
}

TEST_CASE("SparseLu_SolvesASequenceWithOnePivoting") {
  const int n = 50;
  SparseLu lu;
  lu.analyse(ring(n, 0));
  for (unsigned seed = 0; seed < 4; ++seed) {
    const auto A = ring(n, seed);
    REQUIRE(lu.factorise(values(A)));
    const Eigen::MatrixXd x = seeded_random(n, 3, seed);
    Eigen::MatrixXd b = A * x;
    lu.solve({b.data(), static_cast<std::size_t>(b.size())}, 3);
    // Diagonally dominant with condition below 10: round-off of a few rows' sums.
    CHECK((b - x).norm() < 100 * eps * x.norm());
    Eigen::VectorXd bt = A.transpose() * x.col(0);
    lu.solve_transposed({bt.data(), static_cast<std::size_t>(n)});
    CHECK((bt - x.col(0)).norm() < 100 * eps * x.norm());
  }
  CHECK(lu.pivotings() == 1);
}

TEST_CASE("SparseLu_SolvesASystemWithoutUnknowns") {
  SparseLu lu;
  const Eigen::SparseMatrix<double> A(0, 0);
  lu.analyse(A);
  CHECK(lu.factorise({}));
  lu.solve({});
  lu.solve_transposed({});
  CHECK(lu.reciprocal_condition() == 1);
}

TEST_CASE("SparseLu_PivotsAfreshWhereTheOldOrderFails") {
  // [[1, 1], [1, 0]]-like and then its mirror: the first pivot order would divide by 1e-20.
  Eigen::SparseMatrix<double> A(2, 2), B(2, 2);
  A.insert(0, 0) = 4, A.insert(0, 1) = 1, A.insert(1, 0) = 1, A.insert(1, 1) = 1e-20;
  B.insert(0, 0) = 1e-20, B.insert(0, 1) = 1, B.insert(1, 0) = 1, B.insert(1, 1) = 4;
  A.makeCompressed(), B.makeCompressed();
  SparseLu lu;
  lu.analyse(A);
  for (const auto& M : {A, B, A}) {
    REQUIRE(lu.factorise(values(M)));
    const Eigen::Vector2d x(1, 2);
    Eigen::VectorXd b = M * x;
    lu.solve({b.data(), 2});
    CHECK((b - x).norm() < 100 * eps);
  }
  CHECK(lu.pivotings() > 1);
  // Whichever entry the order begins with, it may have become nothing at all.
  for (const int column : {0, 1}) {
    Eigen::SparseMatrix<double> C = A;
    C.coeffRef(0, column) = 0, C.coeffRef(1, 1) = 3;
    SparseLu other;
    other.analyse(A);
    REQUIRE((other.factorise(values(A)) && other.factorise(values(C))));
    Eigen::VectorXd b = C * Eigen::Vector2d(1, 2);
    other.solve({b.data(), 2});
    CHECK((b - Eigen::Vector2d(1, 2)).norm() < 100 * eps);
  }
}

TEST_CASE("SparseLu_ReportsSingularMatricesAndRecovers") {
  auto A = ring(10, 1);
  SparseLu lu;
  lu.analyse(A);
  const auto good = A;
  for (int i = 0; i < 10; ++i) {  // each row sums to zero: the constant vector is in the kernel
    A.coeffRef(i, i) = -(A.coeff(i, (i + 1) % 10) + A.coeff(i, (i + 9) % 10));
  }
  CHECK_FALSE(lu.factorise(values(A)));
  Eigen::VectorXd b = Eigen::VectorXd::Ones(10);
  CHECK_THROWS_AS(lu.solve({b.data(), 10}), ContractError);
  CHECK(lu.factorise(values(good)));
  A.coeffRef(3, 3) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(lu.factorise(values(A)));
}

TEST_CASE("SparseLu_FactorisesNoStructurallySingularPattern") {
  Eigen::SparseMatrix<double> A(3, 3);  // rows 1 and 2 have one column between them
  A.insert(0, 0) = 1;
  A.insert(1, 0) = 1;
  A.insert(2, 0) = 1;
  A.insert(0, 1) = 1;
  A.insert(0, 2) = 1;
  A.makeCompressed();
  SparseLu lu;
  lu.analyse(A);
  CHECK_FALSE(lu.factorise(values(A)));
  CHECK_FALSE(lu.factorised());
}

// Full, with the given diagonal: a weak one is no pivot.
Eigen::SparseMatrix<double> full(int n, unsigned seed, double diagonal) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0.1, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) entries.emplace_back(i, j, i == j ? diagonal : uniform(generator));
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  A.makeCompressed();
  return A;
}

TEST_CASE("RestoredSparseLu_SolvesToTheSameBits") {
  const int n = 12;
  const auto first = full(n, 1, 1e-9), later = full(n, 2, 0.7);
  SparseLu lu, restored, fresh;
  lu.analyse(first);
  REQUIRE(lu.factorise(values(first)));
  Archive out;
  lu.persist(out);
  Archive in(out.content());
  restored.persist(in);
  fresh.analyse(later);
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1, 2), y = x, z = x;
  REQUIRE((lu.factorise(values(later)) && restored.factorise(values(later)) && fresh.factorise(values(later))));
  lu.solve({x.data(), static_cast<std::size_t>(n)});
  restored.solve({y.data(), static_cast<std::size_t>(n)});
  fresh.solve({z.data(), static_cast<std::size_t>(n)});
  CHECK(x == y);
  CHECK(lu.pivotings() == 1);
  CHECK(x != z);                             // what was restored matters
  CHECK((x - z).norm() < 1e-10 * x.norm());  // round-off times the growth that another pivot order allows
}

TEST_CASE("SparseLuWithAPatternAlone_IsRestoredAsSuch") {
  SparseLu lu, restored;
  lu.analyse(ring(5, 0));
  Archive out;
  lu.persist(out);
  Archive in(out.content());
  restored.persist(in);
  CHECK(restored.size() == 5);
  CHECK_FALSE(restored.factorised());
  CHECK(restored.factorise(values(ring(5, 1))));
}

TEST_CASE("StoredMatrixThatHasNoFactors_IsRefused") {
  SparseLu lu;
  lu.analyse(ring(5, 0));
  REQUIRE(lu.factorise(values(ring(5, 0))));
  Archive out;
  lu.persist(out);
  for (const bool shorter : {false, true}) {
    Archive::Content content = out.content();
    Archive::Numbers& stored = content.numbers.at("pivoted_matrix");
    std::fill(stored.values.begin(), stored.values.end(), 0.0);
    if (shorter) stored.values.pop_back(), stored.shape = {stored.values.size()};
    Archive in(content);
    SparseLu restored;
    CHECK_THROWS_AS(restored.persist(in), ArchiveError);
  }
}

TEST_CASE("SparseLuWithoutAMatrix_IsRestoredAsSuch") {
  SparseLu lu, restored;
  Archive out;
  lu.persist(out);
  restored.analyse(ring(5, 0));
  Archive in(out.content());
  restored.persist(in);
  CHECK_FALSE(restored.factorised());
}

}  // namespace sparse_lu_test
}  // namespace hersey::solver
