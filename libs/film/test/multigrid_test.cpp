#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "film_cases.h"

namespace hersey::film {
namespace multigrid_test {

FilmModel big_end(Cavitation cavitation, const Grid& grid) {
  FilmModel m{.R = 0.0225, .L = 0.0156, .c = 34e-6, .grid = grid, .cavitation = cavitation};
  m.supply = {SupplyKind::widest_gap, 0, 1e5};
  return m;
}

constexpr double omega = 374;

struct Increments {
  Eigen::VectorXd direct, multigrid;
  int iterations = 0, fallback_solves = 0;
};

Increments increments(const FilmModel& model, const SurfaceMotion& motion, const FilmHistory& history,
                      const Eigen::VectorXd& u) {
  Increments found;
  Reynolds direct(model), multigrid(model, LinearSolver::multigrid);
  direct.linearise(motion, history, u);
  multigrid.linearise(motion, history, u);
  direct.newton_increment(found.direct);
  multigrid.newton_increment(found.multigrid, {.rtol = 1e-10});
  found.iterations = multigrid.linear_solver().iterations;
  found.fallback_solves = multigrid.linear_solver().fallback_solves;
  return found;
}

TEST_CASE("MultigridIterations_DoNotGrowWithTheGrid") {
  // A residual of 1e-10 after as many iterations on every grid, in either sense of rotation, in films half cavitated.
  for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
    for (const Grid& grid : {Grid{60, 13}, Grid{121, 26}, Grid{180, 39}, Grid{400, 9}, Grid{30, 80}}) {
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
        REQUIRE(film.summary.solved());
        const Increments found = increments(m, motion, {}, 0.9 * film.u);
        CHECK(found.fallback_solves == 0);
        CHECK(found.iterations <= 16);
        CHECK((found.multigrid - found.direct).norm() < 1e-6 * found.direct.norm());  // 1e-10 times the condition
      }
    }
  }
}

TEST_CASE("AllSolvers_ReachTheSameAnswer") {
  for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
    for (const double e : {0.3, 0.95}) {
      CAPTURE(static_cast<int>(cavitation));
      CAPTURE(e);
      FilmModel m = big_end(cavitation, {48, 11});
      m.compliance = m.R / 57e9;
      m.lubricant.viscosity_law = Barus{1.28e-8};
      m.asperities = {AsperityModel::greenwood_tripp_exact, 1e-6, 3e-3, 57e9, 0.1};
      m.features = {{.name = "groove", .phi = 1, .arc = 0.4, .length = 0.6 * m.L, .pressure = 2e5}};
      Journal journal = turning(m, e, omega);
      journal.tilt = {1e-4, 2e-4};
      const SolvedFilm newton = solve_cold(m, journal);
      REQUIRE(newton.summary.solved());
      for (const auto solver : {FilmSolver::multigrid, FilmSolver::sor}) {
        CAPTURE(static_cast<int>(solver));
        const SolvedFilm other = solve_cold(m, journal, {.solver = solver, .rtol = 1e-10});
        REQUIRE(other.summary.solved());
        // A residual of 1e-10 of the largest throughput; weak spots of the film amplify it by the condition, some 1e3.
        CHECK((other.wrench - newton.wrench).norm() < 1e-7 * newton.wrench.norm());
        CHECK((other.fields.p - newton.fields.p).norm() < 1e-7 * newton.fields.p.norm());
        CHECK((other.fields.theta - newton.fields.theta).cwiseAbs().maxCoeff() < 1e-6);
      }
    }
  }
}

TEST_CASE("ColdStarts_TakeEightIterationsAtMost") {
  for (const auto solver : {FilmSolver::newton, FilmSolver::multigrid}) {
    for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
      for (const Grid& grid : {Grid{60, 13}, Grid{61, 12}, Grid{160, 35}, graded_grid(120, 25, {{pi, 0.3, 4}}, {})}) {
        // Fine grids take many times as long: their corners of the range are enough.
        const bool is_fine = grid.size() > 1000;
        for (const double e : is_fine ? std::vector{0.2, 0.98} : std::vector{0.2, 0.6, 0.9, 0.98}) {
          for (const double L_over_D : is_fine ? std::vector{0.25, 2.0} : std::vector{0.25, 1.0, 2.0}) {
            for (const bool flooded : {false, true}) {
              CAPTURE(static_cast<int>(solver));
              CAPTURE(static_cast<int>(cavitation));
              CAPTURE(grid.n_phi);
              CAPTURE(e);
              CAPTURE(L_over_D);
              CAPTURE(flooded);
              FilmModel m = big_end(cavitation, grid);
              m.L = 2 * m.R * L_over_D;
              if (flooded) m.supply = {}, m.edge_left.pressure = m.edge_right.pressure = 1e5;
              const SolvedFilm film = solve_cold(m, turning(m, e, omega), {.solver = solver});
              CHECK(film.summary.solved());
              CHECK(film.summary.relative_residual <= 1e-10);  // rtol of the solver
              CHECK(film.summary.iterations <= 8);
            }
          }
        }
      }
    }
  }
}

TEST_CASE("ColdStartsWithEveryLaw_TakeFifteenIterationsAtMost") {
  for (const auto solver : {FilmSolver::newton, FilmSolver::multigrid}) {
    for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
      for (const Grid& grid : {Grid{60, 13}, Grid{120, 26}}) {
        for (const double alpha : {0.0, 2e-8}) {
          for (const double e : {0.5, 0.98, 1.01}) {
            CAPTURE(static_cast<int>(solver));
            CAPTURE(static_cast<int>(cavitation));
            CAPTURE(grid.n_phi);
            CAPTURE(alpha);
            CAPTURE(e);
            FilmModel m = big_end(cavitation, grid);
            m.lubricant.viscosity_law = Barus{alpha};
            m.compliance = m.R / 57e9;
            m.asperities = {AsperityModel::greenwood_tripp_exact, 1e-6, 3e-3, 57e9, 0.1};
            m.supply = {};
            m.features = {{.name = "one", .phi = 0.5 * pi, .arc = 0.35, .length = 0.6 * m.L, .pressure = 2e5},
                          {.name = "other", .phi = 1.5 * pi, .arc = 0.35, .length = 0.6 * m.L, .pressure = 2e5}};
            const SolvedFilm film = solve_cold(m, turning(m, e, omega), {.solver = solver});
            CHECK(film.summary.solved());
            CHECK(film.summary.iterations <= 15);
          }
        }
      }
    }
  }
}

TEST_CASE("MultigridInTime_AgreesWithNewton") {
  // The journal circles at half speed and is squeezed; the fill of the cavitated oil is carried from step to step.
  FilmModel m = big_end(Cavitation::mass_conserving, {120, 26});
  m.compliance = m.R / 57e9;
  const double dt = pi / 180 / omega;
  std::array<Reynolds, 2> reynolds{Reynolds(m), Reynolds(m, LinearSolver::multigrid)};
  std::array<Eigen::VectorXd, 2> u{Eigen::VectorXd::Zero(m.grid.size()), Eigen::VectorXd::Zero(m.grid.size())};
  FilmHistory start{dt, Eigen::VectorXd::Ones(m.grid.size()), Eigen::VectorXd::Zero(m.grid.size())};
  std::array<FilmHistory, 2> history{start, start};
  for (int step = 0; step < 40; ++step) {
    const double angle = 0.5 * omega * step * dt, e = m.c * (0.6 + 0.3 * std::sin(10 * angle));
    const double e_rate = 1.5 * omega * m.c * std::cos(10 * angle);
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle)), turned(-direction.y(), direction.x());
    const Journal journal{
        .e = -e * direction, .e_rate = -0.5 * omega * e * turned - e_rate * direction, .omega_journal = omega};
    const SurfaceMotion motion = surfaces(m, journal, angle);
    for (int k : {0, 1}) {
      const auto solver = k == 0 ? FilmSolver::newton : FilmSolver::multigrid;
      const FilmSolveSummary summary = solve_film(reynolds[k], motion, history[k], {.solver = solver}, u[k]);
      REQUIRE(summary.solved());
      CHECK(summary.iterations <= 15);
      const FilmFields fields = film_fields(m, motion, u[k]);
      history[k].theta = fields.theta;
      history[k].w = fields.w;
    }
    // 1e-10 of the largest throughput in each step, carried on by the fill.
    CHECK((reynolds[0].forces().wrench_on_shell - reynolds[1].forces().wrench_on_shell).norm() <
          1e-6 * reynolds[0].forces().wrench_on_shell.norm());
  }
  CHECK(reynolds[1].linear_solver().fallback_solves == 0);
}

TEST_CASE("Responses_AreThoseOfTheDirectSolver") {
  const FilmModel m = big_end(Cavitation::mass_conserving, {120, 26});
  const SurfaceMotion motion = surfaces(m, turning(m, 0.8, omega), 0.02);
  std::vector<MotionDirection> directions(3);
  directions[0].g = Eigen::VectorXd::Ones(m.grid.size());
  directions[1].g_rate = Eigen::VectorXd::Ones(m.grid.size());
  directions[2].u_journal = 1;
  std::array<Eigen::MatrixXd, 2> du;
  std::array<Eigen::Matrix<double, 6, Eigen::Dynamic>, 2> partial;
  for (int k : {0, 1}) {
    Reynolds reynolds(m, k == 0 ? LinearSolver::direct : LinearSolver::multigrid);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
    REQUIRE(solve_film(reynolds, motion, {}, {.rtol = 1e-12}, u).solved());
    respond(reynolds, directions, du[k], partial[k]);
    CHECK(reynolds.linear_solver().fallback_solves == 0);
    Eigen::MatrixXd column = du[k].leftCols<1>();
    if (k == 1) CHECK_THROWS_AS(reynolds.solve(column, SystemMatrix::transposed), ContractError);
  }
  for (int column = 0; column < 3; ++column) {
    // Multigrid answers to 1e-10, about films that both are solved to 1e-12.
    CHECK((du[0].col(column) - du[1].col(column)).norm() < 1e-7 * du[0].col(column).norm());
  }
}

// Side by side, right-hand sides of sizes far apart, one of them zero, each keep the tolerance of their own, and the
// answers are linear in them.
TEST_CASE("RightHandSidesAbreast_AreEachSolvedToTheirOwnTolerance") {
  const FilmModel m = big_end(Cavitation::mass_conserving, {120, 26});
  const SurfaceMotion motion = surfaces(m, turning(m, 0.8, omega), 0.02);
  Reynolds reynolds(m, LinearSolver::multigrid);
  const int n = m.grid.size();
  Eigen::VectorXd u = Eigen::VectorXd::Zero(n);
  REQUIRE(solve_film(reynolds, motion, {}, {}, u).solved());
  Eigen::MatrixXd b(n, 7);
  for (int k = 0; k < n; ++k)
    for (int c = 0; c < 7; ++c) b(k, c) = std::sin(0.37 * (c + 1) * k + c);
  b.col(1) *= 1e6, b.col(3) *= 1e-9;
  b.col(4).setZero();
  b.col(6) = 2 * b.col(0) - b.col(2);
  for (const double rtol : {1e-4, 1e-7, 1e-10}) {  // above and below what single precision carries
    CAPTURE(rtol);
    Eigen::MatrixXd x = b;
    reynolds.solve(x, SystemMatrix::jacobian, rtol);
    for (int c = 0; c < 7; ++c) {
      CAPTURE(c);
      CHECK((reynolds.jacobian_product(x.col(c)) - b.col(c)).norm() <= 1.01 * rtol * b.col(c).norm());
      Eigen::MatrixXd alone = b.col(c);
      reynolds.solve(alone, SystemMatrix::jacobian, rtol);
      CHECK((reynolds.jacobian_product(alone) - b.col(c)).norm() <= 1.01 * rtol * b.col(c).norm());
    }
    CHECK(x.col(4).isZero(0));
    CHECK((reynolds.jacobian_product(x.col(6) - 2 * x.col(0) + x.col(2))).norm() <=
          rtol * (b.col(6).norm() + 2 * b.col(0).norm() + b.col(2).norm()));
  }
  CHECK(reynolds.linear_solver().fallback_solves == 0);
}

}  // namespace multigrid_test
}  // namespace hersey::film
