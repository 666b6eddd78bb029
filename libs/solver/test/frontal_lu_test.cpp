#include "hersey/solver/frontal_lu.h"

#include <doctest/doctest.h>

#include <Eigen/SparseCore>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "hersey/core/contract.h"
#include "hersey/solver/subtract_product.h"
#include "seeded_random.h"

namespace hersey::solver {
namespace frontal_lu_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

using Groups = std::vector<std::vector<int>>;

std::span<const double> values(const Eigen::SparseMatrix<double>& A) {
  return {A.valuePtr(), static_cast<std::size_t>(A.nonZeros())};
}

void analyse(FrontalLu& lu, const Eigen::SparseMatrix<double>& A, const Groups& groups) {
  lu.analyse(static_cast<int>(A.cols()), {A.outerIndexPtr(), static_cast<std::size_t>(A.cols()) + 1},
             {A.innerIndexPtr(), static_cast<std::size_t>(A.nonZeros())}, groups);
}

void solve(FrontalLu& lu, Eigen::MatrixXd& b) {
  lu.solve({b.data(), static_cast<std::size_t>(b.size())}, static_cast<int>(b.cols()));
}

void solve_transposed(FrontalLu& lu, Eigen::MatrixXd& b) {
  lu.solve_transposed({b.data(), static_cast<std::size_t>(b.size())}, static_cast<int>(b.cols()));
}

// Entries at random places and a diagonal that outweighs them; every fifth unknown stands alone in its row.
Eigen::SparseMatrix<double> scattered(int n, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0.1, 1.0);
  std::uniform_int_distribution<int> any(0, n - 1);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 6 + uniform(generator));
    for (int k = 0; k < 3 && i % 5 != 0; ++k) entries.emplace_back(i, any(generator), -uniform(generator));
  }
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  A.makeCompressed();
  return A;
}

// All unknowns in random order, in groups of random length.
Groups drawn_groups(int n, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), generator);
  Groups groups;
  std::uniform_int_distribution<int> length(1, 11);
  for (std::size_t at = 0; at < order.size();) {
    const std::size_t end = std::min(order.size(), at + static_cast<std::size_t>(length(generator)));
    groups.emplace_back(order.begin() + static_cast<std::ptrdiff_t>(at),
                        order.begin() + static_cast<std::ptrdiff_t>(end));
    at = end;
  }
  return groups;
}

TEST_CASE("FrontalLu_SolvesWhateverTheGroups") {
  const int n = 90;
  for (unsigned seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    const Eigen::SparseMatrix<double> A = scattered(n, seed);
    FrontalLu lu;
    analyse(lu, A, drawn_groups(n, 100 + seed));
    REQUIRE(lu.factorise(values(A)));
    for (const int columns : {1, 4, 6, 9, 3}) {
      CAPTURE(columns);
      const Eigen::MatrixXd x = seeded_random(n, columns, seed);
      Eigen::MatrixXd b = A * x, bt = A.transpose() * x;
      solve(lu, b);
      solve_transposed(lu, bt);
      // Diagonally dominant with condition below 10: round-off of a few rows' sums.
      CHECK((b - x).norm() < 100 * eps * x.norm());
      CHECK((bt - x).norm() < 100 * eps * x.norm());
    }
  }
}

// Without exchanges within the group the first pivot would be zero.
TEST_CASE("FrontalLu_ChoosesPivotsWithinGroups") {
  const int n = 12;
  Eigen::MatrixXd dense = seeded_random(n, n, 3);
  dense.diagonal().setZero();
  const Eigen::SparseMatrix<double> A = dense.sparseView();
  std::vector<int> all(static_cast<std::size_t>(n));
  std::iota(all.begin(), all.end(), 0);
  FrontalLu lu;
  analyse(lu, A, {all});
  REQUIRE(lu.factorise(values(A)));
  const Eigen::MatrixXd x = seeded_random(n, 2, 4);
  Eigen::MatrixXd b = A * x, bt = A.transpose() * x;
  solve(lu, b);
  solve_transposed(lu, bt);
  const double amplified = 1e3 * eps;  // condition of a random matrix of this size: some hundreds
  CHECK((b - x).norm() < amplified * x.norm());
  CHECK((bt - x).norm() < amplified * x.norm());

  SUBCASE("where the group has none, there is no factor") {
    Groups alone;
    for (int k = 0; k < n; ++k) alone.push_back({k});
    analyse(lu, A, alone);
    CHECK_FALSE(lu.factorise(values(A)));
    Eigen::MatrixXd rhs = x;
    CHECK_THROWS_AS(solve(lu, rhs), ContractError);
  }
}

TEST_CASE("FrontalLu_SaysWhenItsPivotsDoNotSuffice") {
  const int n = 40;
  Eigen::SparseMatrix<double> A = scattered(n, 1);
  FrontalLu lu;
  analyse(lu, A, drawn_groups(n, 2));
  std::vector<double> given(values(A).begin(), values(A).end());
  REQUIRE(lu.factorise(given));
  SUBCASE("a number that is none") {
    given[given.size() / 2] = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(lu.factorise(given));
  }
  SUBCASE("a row of zeros") {
    for (int k = 0; k < A.nonZeros(); ++k)
      if (A.innerIndexPtr()[k] == 7) given[static_cast<std::size_t>(k)] = 0;
    CHECK_FALSE(lu.factorise(given));
  }
  SUBCASE("a pivot that lets elements grow") {
    Eigen::Matrix2d small;
    small << 1e-9, 1, 1, 1;  // growth of 1e9, more than half the digits
    const Eigen::SparseMatrix<double> two = small.sparseView();
    FrontalLu of_two;
    analyse(of_two, two, {{0}, {1}});
    CHECK_FALSE(of_two.factorise(values(two)));
    analyse(of_two, two, {{0, 1}});
    CHECK(of_two.factorise(values(two)));
  }
}

TEST_CASE("FrontalLu_FactorDependsOnTheValuesAlone") {
  const int n = 70;
  const Eigen::SparseMatrix<double> A = scattered(n, 5);
  const Groups groups = drawn_groups(n, 6);
  FrontalLu fresh, used;
  analyse(fresh, A, groups);
  analyse(used, A, groups);
  std::vector<double> other(values(A).begin(), values(A).end());
  for (double& value : other) value *= value;
  REQUIRE(used.factorise(other));
  REQUIRE(used.factorise(values(A)));
  REQUIRE(fresh.factorise(values(A)));
  Eigen::MatrixXd a = seeded_random(n, 5, 7), b = a;
  solve(fresh, a);
  solve(used, b);
  CHECK(a == b);
}

TEST_CASE("FrontalLu_RefusesGroupsThatLeaveUnknownsOut") {
  const Eigen::SparseMatrix<double> A = scattered(6, 1);
  FrontalLu lu;
  CHECK_THROWS_AS(analyse(lu, A, {{0, 1, 2}}), ContractError);
}

TEST_CASE("Product_IsSubtractedInEveryShape") {
  for (const int rows : {0, 1, 2, 3, 4, 7}) {
    for (const int columns : {0, 1, 4, 5, 8, 11, 20}) {
      for (const int inner : {0, 1, 5}) {
        CAPTURE(rows);
        CAPTURE(columns);
        CAPTURE(inner);
        using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        const RowMajor A = seeded_random(rows, inner, 1), B = seeded_random(inner, columns + 2, 2);
        const RowMajor At = A.transpose();
        RowMajor C = seeded_random(rows, columns + 3, 3);
        RowMajor expected = C;
        expected.leftCols(columns) -= A * B.leftCols(columns);
        RowMajor by_transposed = C;
        subtract_product(rows, columns, inner, {A.data(), inner}, B.data(), columns + 2, C.data(), columns + 3);
        subtract_product(rows, columns, inner, {At.data(), 1, rows}, B.data(), columns + 2, by_transposed.data(),
                         columns + 3);
        const double round_off = 8 * (inner + 1) * eps;
        CHECK((C - expected).cwiseAbs().sum() <= round_off * (1 + C.size()));
        CHECK(C == by_transposed);
        CHECK(C.rightCols(3) == expected.rightCols(3));
      }
    }
  }
}

}  // namespace frontal_lu_test
}  // namespace hersey::solver
