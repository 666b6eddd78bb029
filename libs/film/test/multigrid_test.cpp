#include <doctest/doctest.h>

#include "film_cases.h"

namespace hersey::film {
namespace {

FilmModel big_end(Cavitation cavitation, Grid grid) {
  FilmModel m{.R = 0.0225, .L = 0.0156, .c = 34e-6, .grid = grid, .cavitation = cavitation};
  m.supply = {SupplyKind::widest_gap, 0, 1e5};
  return m;
}

constexpr double omega = 374;

struct Increments {
  Eigen::VectorXd direct, multigrid;
  int iterations = 0, rescues = 0;
};

Increments increments(const FilmModel& model, const SurfaceMotion& motion, const FilmHistory& history,
                      const Eigen::VectorXd& u) {
  Increments found;
  Reynolds direct(model), multigrid(model, LinearSolver::multigrid);
  direct.linearise(motion, history, u);
  multigrid.linearise(motion, history, u);
  direct.newton_increment(found.direct);
  multigrid.newton_increment(found.multigrid, 1e-10);
  found.iterations = multigrid.counts().iterations;
  found.rescues = multigrid.counts().rescues;
  return found;
}

TEST_CASE("MultigridIterations_DoNotGrowWithTheGrid") {
  // A residual of 1e-10 after as many iterations on every grid, in either sense of rotation, in films half cavitated.
  for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
    for (const Grid& grid : {Grid{60, 13}, Grid{121, 26}, Grid{240, 52}, Grid{400, 9}, Grid{30, 80}}) {
      for (const double sense : {1.0, -1.0}) {
        CAPTURE(static_cast<int>(cavitation));
        CAPTURE(grid.n_phi);
        CAPTURE(sense);
        const FilmModel m = big_end(cavitation, grid);
        Journal journal = turning(m, 0.8, sense * omega);
        journal.tilt = {1e-4, 2e-4};
        const SurfaceMotion motion = surfaces(m, journal, 0.02);
        // One step from the solution: front and pressures where they are, but not quite.
        const SolvedFilm film = solve_cold(m, motion, journal.e);
        REQUIRE(film.summary.converged);
        const Increments found = increments(m, motion, {}, 0.9 * film.u);
        CHECK(found.rescues == 0);
        CHECK(found.iterations <= 16);
        CHECK((found.multigrid - found.direct).norm() < 1e-6 * found.direct.norm());  // 1e-10 times the condition
      }
    }
  }
}

}  // namespace
}  // namespace hersey::film
