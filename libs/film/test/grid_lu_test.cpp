#include "solve/grid_lu.h"

#include <doctest/doctest.h>

#include <Eigen/SparseCore>
#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "hersey/solver/sparse_lu.h"
#include "seeded_random.h"

namespace hersey::film {
namespace grid_lu_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

// Entries between neighbours on a grid and a diagonal that outweighs them; rows at z = -L/2 prescribe their unknown.
Eigen::SparseMatrix<double> five_points(const Grid& grid, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0.2, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < grid.n_phi; ++i) {
    for (int j = 0; j < grid.n_z; ++j) {
      const int node = grid.index(i, j);
      entries.emplace_back(node, node, j == 0 ? 1 : 5);
      if (j == 0) continue;
      if (grid.next(i) >= 0) entries.emplace_back(node, grid.index(grid.next(i), j), -uniform(generator));
      if (grid.before(i) >= 0) entries.emplace_back(node, grid.index(grid.before(i), j), -uniform(generator));
      entries.emplace_back(node, node - 1, -uniform(generator));
      if (j + 1 < grid.n_z) entries.emplace_back(node, node + 1, -uniform(generator));
    }
  }
  Eigen::SparseMatrix<double> A(grid.size(), grid.size());
  A.setFromTriplets(entries.begin(), entries.end());
  A.makeCompressed();
  return A;
}

void analyse(GridLu& lu, const Eigen::SparseMatrix<double>& A) {
  lu.analyse({A.outerIndexPtr(), static_cast<std::size_t>(A.cols()) + 1},
             {A.innerIndexPtr(), static_cast<std::size_t>(A.nonZeros())});
}

std::span<const double> values(const Eigen::SparseMatrix<double>& A) {
  return {A.valuePtr(), static_cast<std::size_t>(A.nonZeros())};
}

std::vector<Grid> grids() {
  return {{12, 3}, {7, 4}, {60, 13}, {24, 2}, patch_grid({{0, 1, 9}, {1.5, 2.5, 14}}, 6), patch_grid({{0, 1, 4}}, 31)};
}

TEST_CASE("NestedDissection_HasEachNodeOnce") {
  for (const Grid& grid : grids()) {
    CAPTURE(grid.n_phi);
    std::vector<int> nodes;
    for (const std::vector<int>& group : nested_dissection(grid)) nodes.insert(nodes.end(), group.begin(), group.end());
    REQUIRE(nodes.size() == static_cast<std::size_t>(grid.size()));
    std::sort(nodes.begin(), nodes.end());
    for (int k = 0; k < grid.size(); ++k) CHECK(nodes[static_cast<std::size_t>(k)] == k);
  }
}

TEST_CASE("GridLu_SolvesOnRingsAndPatches") {
  for (const Grid& grid : grids()) {
    CAPTURE(grid.n_phi);
    const Eigen::SparseMatrix<double> A = five_points(grid, 1);
    GridLu lu(grid);
    analyse(lu, A);
    REQUIRE(lu.factorise(values(A)));
    const Eigen::MatrixXd x = seeded_random(grid.size(), 5, 2);
    Eigen::MatrixXd b = A * x, bt = A.transpose() * x;
    lu.solve({b.data(), static_cast<std::size_t>(b.size())}, 5);
    lu.solve_transposed({bt.data(), static_cast<std::size_t>(bt.size())}, 5);
    // Diagonally dominant with condition below 10: round-off of a few rows' sums.
    CHECK((b - x).norm() < 100 * eps * x.norm());
    CHECK((bt - x).norm() < 100 * eps * x.norm());
  }
}

// Where the only entries lead from line to line no group has a pivot of its own.
TEST_CASE("GridLu_TakesPivotsOfTheWholeMatrixWhereGroupsHaveNone") {
  const Grid grid{24, 5};
  Eigen::SparseMatrix<double> A = five_points(grid, 3);
  for (int column = 0; column < A.cols(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator at(A, column); at; ++at)
      if (at.row() % grid.n_z != 0 && (at.row() + grid.n_z) % grid.size() != column) at.valueRef() = 0;
  solver::FrontalLu fronts;
  fronts.analyse(grid.size(), {A.outerIndexPtr(), static_cast<std::size_t>(A.cols()) + 1},
                 {A.innerIndexPtr(), static_cast<std::size_t>(A.nonZeros())}, nested_dissection(grid));
  CHECK_FALSE(fronts.factorise(values(A)));
  GridLu lu(grid);
  analyse(lu, A);
  REQUIRE(lu.factorise(values(A)));
  const Eigen::MatrixXd x = seeded_random(grid.size(), 2, 4);
  Eigen::MatrixXd b = A * x;
  lu.solve({b.data(), static_cast<std::size_t>(b.size())}, 2);
  solver::SparseLu pivoting;
  pivoting.analyse(A);
  REQUIRE(pivoting.factorise(values(A)));
  Eigen::MatrixXd by_pivoting = A * x;
  pivoting.solve({by_pivoting.data(), static_cast<std::size_t>(b.size())}, 2);
  CHECK(b == by_pivoting);
}

TEST_CASE("GridLu_SaysThatAMatrixIsSingular") {
  const Grid grid{10, 4};
  Eigen::SparseMatrix<double> A = five_points(grid, 5);
  for (int column = 0; column < A.cols(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator at(A, column); at; ++at)
      if (at.row() == 7) at.valueRef() = 0;
  GridLu lu(grid);
  analyse(lu, A);
  CHECK_FALSE(lu.factorise(values(A)));
}

}  // namespace grid_lu_test
}  // namespace hersey::film
