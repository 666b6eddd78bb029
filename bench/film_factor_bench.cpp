// Factors of a film's Jacobian: dense blocks along the nested dissection of the grid beside the sparse LU with pivots
// of the whole matrix (KLU). Usage: film_factor_bench [largest n_phi]
#include <fmt/format.h>

#include <cstdlib>

#include "balance/flow_balance.h"
#include "film_cases.h"
#include "hersey/solver/sparse_lu.h"
#include "machine_limits.h"
#include "solve/grid_lu.h"

namespace {

using namespace hersey;
using namespace hersey::film;

/// Times of one factor, of one solution, and of the six transposed ones from which a wrench follows [s].
struct Times {
  double factor = 0, one = 0, six = 0;
};

template <class Lu>
Times times_of(Lu& lu, const FlowBalance& balance, Eigen::MatrixXd& answer) {
  const auto n = static_cast<std::size_t>(balance.size());
  const int runs = balance.size() < 5000 ? 100 : 5;
  bool sound = lu.factorise(balance.values());
  Times times;
  times.factor = shortest(runs, [&] { sound = sound && lu.factorise(balance.values()); });
  if (!sound) std::abort();
  answer = balance.residual();
  Eigen::MatrixXd b(balance.size(), 6);
  times.one = shortest(runs, [&] { lu.solve({b.data(), n}, 1); });
  times.six = shortest(runs, [&] { lu.solve_transposed({b.data(), 6 * n}, 6); });
  lu.solve({answer.data(), n}, 1);
  return times;
}

}  // namespace

int main(int argc, char** argv) {
  const int largest = argc > 1 ? std::atoi(argv[1]) : 480;
  const double most_flops = bench::machine_limits().flops;
  fmt::print(
      "of gemm: operations of the factor by blocks in a second over those of large dense products here, {:.3g}\n",
      most_flops);
  fmt::print("{:>11} | {:>27} | {:>27} | {:>20} | {:>7} | {}\n", "", "blocks [ms]", "KLU [ms]", "ratio", "of gemm",
             "difference");
  fmt::print("{:>11} | {:>9} {:>8} {:>8} | {:>9} {:>8} {:>8} | {:>6} {:>6} {:>6} | {:>7} |\n", "grid", "factor",
             "1 side", "6 sides", "factor", "1 side", "6 sides", "factor", "1", "6", "");
  for (const Grid& grid : {Grid{60, 13}, Grid{120, 25}, Grid{240, 49}, Grid{480, 105}, Grid{960, 209}}) {
    if (grid.n_phi > largest) break;
    const BenchBearing b = bench_bearing(grid, 1, 0.8);
    const TimedFilm film = timed_film(b, {.solver = FilmSolver::newton}, 1);
    FlowBalance balance(b.model);
    balance.evaluate(b.motion, {}, film.u);
    balance.assemble_jacobian();
    GridLu blocks(grid);
    blocks.analyse(balance.column_start(), balance.row_index());
    solver::SparseLu sparse;
    sparse.analyse(balance.size(), balance.column_start(), balance.row_index());
    Eigen::MatrixXd by_blocks, by_sparse;
    const Times t = times_of(blocks, balance, by_blocks), s = times_of(sparse, balance, by_sparse);
    fmt::print(
        "{:>11} | {:9.3f} {:8.3f} {:8.3f} | {:9.3f} {:8.3f} {:8.3f} | {:6.2f} {:6.2f} {:6.2f} | {:5.0f} % | {:.0e}\n",
        fmt::format("{} x {}", grid.n_phi, grid.n_z), 1e3 * t.factor, 1e3 * t.one, 1e3 * t.six, 1e3 * s.factor,
        1e3 * s.one, 1e3 * s.six, t.factor / s.factor, t.one / s.one, t.six / s.six,
        100 * blocks.operations() / t.factor / most_flops, (by_blocks - by_sparse).norm() / by_sparse.norm());
  }
  return 0;
}
