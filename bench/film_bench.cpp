// The film's solvers on the bearing table: iterations and time of Newton and SOR, and Newton's iteration against one
// assembly, factorisation and solve of the same matrix measured beside it. Usage: film_bench [n_phi n_z]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <vector>

#include "flow_balance.h"
#include "hersey/film/film_solver.h"
#include "hersey/solver/sparse_lu.h"

namespace {

using namespace hersey;
using namespace hersey::film;

struct Bearing {
  FilmModel model;
  SurfaceMotion motion;
};

// Journal turning in a fixed bore, film starting at the widest gap, as in verification/data/finite_360.csv.
Bearing bearing(const Grid& grid, double L_over_D, double epsilon) {
  Bearing b;
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

/// Shortest of several runs [s]: the others were disturbed.
template <class Work>
double shortest(int runs, Work&& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

struct Timed {
  FilmSolveSummary summary;
  double seconds = 0;
  Eigen::VectorXd u;
};

Timed timed_solve(const Bearing& b, const FilmSolveOptions& options, int runs) {
  Timed timed;
  Reynolds reynolds(b.model);
  timed.seconds = shortest(runs, [&] {
    timed.u.setZero(b.model.grid.size());
    timed.summary = solve_film(reynolds, b.motion, {}, options, timed.u);
  });
  return timed;
}

/// One assembly of residual and Jacobian, one factorisation with pivoting and one solve; ordering not counted. Each
/// sample takes `repeats` of them, so that it lasts as long as the solve it is compared with and suffers as much
/// disturbance.
double one_assembly_factorisation_solve(const Bearing& b, const Eigen::VectorXd& u, int repeats, int runs) {
  FlowBalance balance(b.model);
  Eigen::VectorXd du;
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    std::vector<solver::SparseLu> fresh(repeats);
    for (auto& lu : fresh) lu.analyse(balance.size(), balance.column_start(), balance.row_index());
    best = std::min(best, shortest(1, [&] {
                      for (auto& lu : fresh) {
                        balance.evaluate(b.motion, {}, u);
                        balance.assemble_jacobian();
                        if (!lu.factorise(balance.values())) std::abort();
                        du = balance.residual();
                        lu.solve({du.data(), static_cast<std::size_t>(du.size())});
                      }
                    }));
  }
  return best / repeats;
}

}  // namespace

int main(int argc, char** argv) {
  const Grid grid{argc > 2 ? std::atoi(argv[1]) : 120, argc > 2 ? std::atoi(argv[2]) : 24};
  fmt::print("Film {} x {}, mass conserving, cold start. Newton to 1e-10, SOR to 1e-8 relative residual.\n", grid.n_phi,
             grid.n_z);
  fmt::print("reference = one assembly + one factorisation + one solve of the same matrix\n\n");
  fmt::print("{:>4} {:>7} | {:>6} {:>9} {:>10} {:>10} {:>6} | {:>7} {:>8}\n", "L/D", "epsilon", "Newton", "total ms",
             "iteration", "reference", "ratio", "sweeps", "SOR ms");
  double worst = 0;
  int most = 0;
  for (const double L_over_D : {1.0, 0.5}) {
    for (const double epsilon : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.97}) {
      const Bearing b = bearing(grid, L_over_D, epsilon);
      const Timed newton = timed_solve(b, {}, 15);
      const Timed sor = timed_solve(b, {.solver = FilmSolver::sor, .rtol = 1e-8}, 1);
      const double reference = one_assembly_factorisation_solve(b, newton.u, newton.summary.iterations, 15);
      const double iteration = newton.seconds / newton.summary.iterations, ratio = iteration / reference;
      worst = std::max(worst, ratio);
      most = std::max(most, newton.summary.iterations);
      fmt::print("{:4.1f} {:7.2f} | {:6} {:9.3f} {:7.3f} ms {:7.3f} ms {:6.2f} | {:7} {:8.2f}{}\n", L_over_D, epsilon,
                 newton.summary.iterations, 1e3 * newton.seconds, 1e3 * iteration, 1e3 * reference, ratio,
                 sor.summary.iterations, 1e3 * sor.seconds,
                 newton.summary.converged && sor.summary.converged ? "" : "  not converged");
    }
  }
  fmt::print("\nmost iterations {} (asked: 10), worst ratio {:.2f} (asked: 2)\n", most, worst);
  return most <= 10 && worst <= 2 ? 0 : 1;
}
