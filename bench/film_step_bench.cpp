// One iteration of a time step on the usual grid, and what stiffness and damping cost beside an equilibrium.
#include <fmt/format.h>

#include <cstdlib>
#include <vector>

#include "film_cases.h"
#include "hersey/bearing/rigid_surfaces.h"

namespace {

using namespace hersey;
using namespace hersey::film;

/// Times of the parts of one warm iteration [s].
struct Iteration {
  double linearise = 0, condense = 0, follow = 0;
  [[nodiscard]] double total() const { return linearise + condense + follow; }
};

Iteration warm_iteration(const BenchBearing& b, FilmSolver solver, const std::vector<MotionDirection>& directions) {
  Reynolds reynolds(b.model, linear_solver_of(solver));
  const int n = b.model.grid.size();
  Eigen::VectorXd u = Eigen::VectorXd::Zero(n), du;
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(directions.size()));
  const SurfaceShapes rigid = SurfaceShapes::none(n);
  CondensedFilm condensed;
  const FilmHistory history{1e-4, Eigen::VectorXd::Ones(n), Eigen::VectorXd::Zero(n)};
  if (!solve_film(reynolds, b.motion, history, {.solver = solver}, u).solved()) std::abort();
  Iteration best;
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 300; ++run) {
    Iteration now;
    now.linearise = shortest(1, [&] { reynolds.linearise(b.motion, history, u); });
    now.condense = shortest(1, [&] { reynolds.condense(directions, rigid, condensed); });
    now.follow = shortest(1, [&] { reynolds.follow(still, rigid, du); });
    if (now.total() < least) least = now.total(), best = now;
  }
  return best;
}

std::vector<MotionDirection> directions_of(const FilmModel& model) {
  std::vector<MotionDirection> directions;
  directions.reserve(11);
  const bearing::RigidSurfaces surfaces(model);
  for (int k = 0; k < 11; ++k) directions.push_back(surfaces.direction(k));
  return directions;
}

void print_coefficients(const Grid& grid) {
  const BenchBearing b = bench_bearing(grid, 1, 0.8);
  std::vector<MotionDirection> eight = directions_of(b.model);
  eight.resize(8);
  for (const auto solver : {FilmSolver::newton, FilmSolver::multigrid}) {
    Reynolds reynolds(b.model, linear_solver_of(solver));
    Eigen::VectorXd u = Eigen::VectorXd::Zero(grid.size());
    FilmSolveSummary summary;
    const double film = shortest(1, [&] { summary = solve_film(reynolds, b.motion, {}, {.solver = solver}, u); });
    const LinearSolverState before = reynolds.linear_solver();
    Eigen::MatrixXd answers;
    Eigen::Matrix<double, 6, Eigen::Dynamic> partial;
    const double coefficients = shortest(1, [&] { respond(reynolds, eight, answers, partial); });
    const LinearSolverState after = reynolds.linear_solver();
    fmt::print("{:>11} {:>10} | {:9.4f} {:5} | {:9.4f} {:6.2f} {:15} {:7} {:6}\n",
               fmt::format("{} x {}", grid.n_phi, grid.n_z), solver == FilmSolver::newton ? "newton" : "multigrid",
               film, summary.iterations, coefficients, coefficients / film,
               after.factorisations - before.factorisations + after.setups - before.setups, eight.size(),
               after.iterations - before.iterations);
  }
}

}  // namespace

int main() {
  const Grid grid{60, 13};
  const BenchBearing b = bench_bearing(grid, 1, 0.8);
  const std::vector<MotionDirection> directions = directions_of(b.model);
  fmt::print("A warm iteration of a time step, 60 x 13, mass conserving, answers to {} changes of the surfaces [ms]\n",
             directions.size());
  fmt::print("{:>10} {:>10} {:>10} {:>10} {:>8}\n", "solver", "linearise", "condense", "follow", "total");
  double direct = 0;
  for (const auto solver : {FilmSolver::newton, FilmSolver::multigrid}) {
    const Iteration it = warm_iteration(b, solver, directions);
    if (solver == FilmSolver::newton) direct = it.total();
    fmt::print("{:>10} {:10.4f} {:10.4f} {:10.4f} {:8.4f}\n", solver == FilmSolver::newton ? "newton" : "multigrid",
               1e3 * it.linearise, 1e3 * it.condense, 1e3 * it.follow, 1e3 * it.total());
  }
  fmt::print("newton: {:.3f} ms (asked: 0.4)\n", 1e3 * direct);

  fmt::print("\nStiffness and damping (8 columns) beside a film from nothing\n");
  fmt::print("{:>11} {:>10} | {:>9} {:>5} | {:>9} {:>6} {:>15} {:>7} {:>6}\n", "grid", "solver", "film s", "it.",
             "coeff. s", "share", "factorisations", "columns", "GMRES");
  for (const Grid& each : {Grid{60, 13}, Grid{240, 52}, Grid{480, 104}}) print_coefficients(each);
  return direct <= 0.4e-3 ? 0 : 1;
}
