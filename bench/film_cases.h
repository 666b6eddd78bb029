#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>

#include "hersey/film/film_solver.h"
#include "hersey/film/reynolds.h"

namespace hersey::film {

struct BenchBearing {
  FilmModel model;
  SurfaceMotion motion;
};

/// Journal turning in a fixed bore, film starting at the widest gap, as in verification/data/finite_360.csv.
inline BenchBearing bench_bearing(const Grid& grid, double L_over_D, double epsilon) {
  BenchBearing b;
  b.model = {.R = 0.025, .L = 0.05 * L_over_D, .c = 25e-6, .grid = grid};
  b.model.supply = {SupplyKind::widest_gap, 0, 0};
  b.motion.g.resize(grid.size());
  b.motion.g_rate.setZero(grid.size());
  b.motion.u_journal = 100 * b.model.R;
  for (int k = 0; k < grid.size(); ++k) {
    const int i = k / grid.n_z;
    b.motion.g[k] = b.model.c * (1 + epsilon * std::cos(2 * std::numbers::pi * i / grid.n_phi));
  }
  return b;
}

/// Processor time of this process [s]: other work on the machine disturbs it less than the clock on the wall.
inline double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Shortest of several runs [s].
template <class Work>
double shortest(int runs, Work&& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    const double start = processor_time();
    work();
    best = std::min(best, processor_time() - start);
  }
  return best;
}

struct TimedFilm {
  FilmSolveSummary summary;
  LinearSolverState counts;
  double seconds = 0;
  Eigen::VectorXd u;
  Vector6 wrench = Vector6::Zero();
};

/// A film from nothing, its data structures included.
inline TimedFilm timed_film(const BenchBearing& b, const FilmSolveOptions& options, int runs) {
  TimedFilm timed;
  timed.seconds = shortest(runs, [&] {
    Reynolds reynolds(b.model, linear_solver_of(options.solver));
    timed.u.setZero(b.model.grid.size());
    timed.summary = solve_film(reynolds, b.motion, {}, options, timed.u);
    timed.wrench = reynolds.forces().wrench_on_shell;
    timed.counts = reynolds.linear_solver();
  });
  return timed;
}

}  // namespace hersey::film
