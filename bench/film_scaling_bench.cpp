// A film from nothing on ever finer grids: time per unknown of the direct solver and of multigrid, and where the time
// of one Newton iteration goes. Usage: film_scaling_bench [largest n_phi]
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

#include "balance/flow_balance.h"
#include "film_cases.h"
#include "machine_limits.h"
#include "solve/grid_lu.h"
#include "solve/multigrid_solver.h"

namespace {

using namespace hersey;
using namespace hersey::film;

constexpr int largest_direct = 960;  // beyond, the factors take gigabytes

double megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Times of one Newton iteration's parts [s].
struct Parts {
  double assembly = 0, setup = 0, solve = 0;
};

std::string shares(const Parts& parts) {
  const double total = parts.assembly + parts.setup + parts.solve;
  return fmt::format("{:3.0f} {:3.0f} {:3.0f} %", 100 * parts.assembly / total, 100 * parts.setup / total,
                     100 * parts.solve / total);
}

Parts parts_of(const BenchBearing& b, const Eigen::VectorXd& u, FilmSolver solver) {
  FlowBalance balance(b.model);
  Parts parts;
  parts.assembly = shortest(3, [&] {
    balance.evaluate(b.motion, {}, u);
    balance.assemble_jacobian();
  });
  Eigen::VectorXd rhs = balance.residual(), x;
  if (solver == FilmSolver::newton) {
    GridLu lu(b.model.grid);
    lu.analyse(balance.column_start(), balance.row_index());
    bool sound = lu.factorise(balance.values());
    parts.setup = shortest(2, [&] { sound = sound && lu.factorise(balance.values()); });
    if (!sound) std::abort();
    parts.solve = shortest(2, [&] { lu.solve({rhs.data(), static_cast<std::size_t>(rhs.size())}); });
  } else {
    MultigridSolver multigrid(b.model.grid.n_phi, b.model.grid.n_z, balance.column_start(), balance.row_index());
    bool sound = true;
    parts.setup = shortest(3, [&] { sound = sound && multigrid.setup(balance.values(), true); });
    parts.solve = shortest(3, [&] { sound = sound && multigrid.solve(rhs, {.rtol = 1e-5}, x).solved(); });
    if (!sound) std::abort();
  }
  return parts;
}

}  // namespace

int main(int argc, char** argv) {
  const int largest = argc > 1 ? std::atoi(argv[1]) : 1920;
  // A film is read and written at least once in each of its Newton iterations: Jacobian, unknowns, gap and rate.
  constexpr double bytes = 8 * (9 + 4);
  const double bandwidth = bench::machine_limits().bandwidth;
  fmt::print("Film of a bearing L/D = 1, epsilon 0.8, mass conserving, from nothing to a residual of 1e-10.\n");
  fmt::print(
      "us: processor time per unknown, set-up of all data included. Shares of one Newton iteration: assembly of\n");
  fmt::print("residual and Jacobian, factorisation (multigrid: its operators), solution.\n");
  fmt::print(
      "limit: of the time, what a core's bandwidth, {:.2g} GB/s, leaves to Newton's iterations of {:.0f} bytes\n",
      1e-9 * bandwidth, bytes);
  fmt::print("a node: Jacobian, unknowns, gap and rate once each.\n\n");
  fmt::print("{:>11} {:>8} | {:>9} {:>6} {:>4} {:>14} | {:>9} {:>6} {:>4} {:>5} {:>14} {:>7} {:>7}\n", "grid",
             "unknowns", "newton s", "us", "it.", "shares", "multigr s", "us", "it.", "GMRES", "shares", "MB", "limit");
  double at_120 = 0, slowest = 0, at_960 = 0;
  int first_faster = 0, most_iterations = 0;
  bool converged = true;
  for (int n_phi = 60, n_z = 13; n_phi <= largest; n_phi *= 2, n_z *= 2) {
    const BenchBearing b = bench_bearing({.n_phi = n_phi, .n_z = n_z}, 1, 0.8);
    const int n = b.model.grid.size(), runs = std::clamp(100000 / n, 1, 20);
    const TimedFilm multigrid = timed_film(b, {.solver = FilmSolver::multigrid}, std::max(2, runs));
    const double memory = megabytes(), us = 1e6 * multigrid.seconds / n;
    const std::string multigrid_shares = shares(parts_of(b, multigrid.u, FilmSolver::multigrid));
    fmt::print("{:>11} {:8} | ", fmt::format("{} x {}", n_phi, n_z), n);
    converged = converged && multigrid.summary.solved();
    most_iterations = std::max(most_iterations, multigrid.summary.iterations);
    if (n_phi <= largest_direct) {
      const TimedFilm newton = timed_film(b, {}, runs);
      fmt::print("{:9.4f} {:6.2f} {:4} {:>14}", newton.seconds, 1e6 * newton.seconds / n, newton.summary.iterations,
                 shares(parts_of(b, newton.u, FilmSolver::newton)));
      converged = converged && newton.summary.solved();
      if (multigrid.seconds >= newton.seconds) first_faster = 0;
      if (multigrid.seconds < newton.seconds && first_faster == 0) first_faster = n;
    } else {
      fmt::print("{:9} {:>6} {:>4} {:>14}", "-", "-", "-", "-");
    }
    const double limit = bytes * n * multigrid.summary.iterations / bandwidth;
    fmt::print(" | {:9.4f} {:6.2f} {:4} {:5} {:>14} {:7.0f} {:5.1f} %\n", multigrid.seconds, us,
               multigrid.summary.iterations, multigrid.counts.iterations, multigrid_shares, memory,
               100 * limit / multigrid.seconds);
    if (n_phi == 120) at_120 = us;
    if (n_phi == 960) at_960 = multigrid.seconds;
    if (n_phi >= 120) slowest = std::max(slowest, us);
  }
  fmt::print("\nmultigrid is faster than the direct solver from {} unknowns on\n", first_faster);
  fmt::print("multigrid at 960 x 208: {:.2f} s (asked: 1)\n", at_960);
  fmt::print("growth of its time per unknown from 120 x 26 on: {:.2f} (asked: 1.5)\n", slowest / at_120);
  fmt::print("iterations on the grid itself: {} at most (asked: 8)\n", most_iterations);
  return converged && at_960 <= 1 && slowest <= 1.5 * at_120 && most_iterations <= 8 ? 0 : 1;
}
