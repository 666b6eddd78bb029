#include <doctest/doctest.h>

#include <limits>

#include "film_cases.h"
#include "hersey/core/contract.h"
#include "relative.h"

namespace hersey::film {
namespace solver_test {

FilmModel big_end(Cavitation cavitation) {
  FilmModel m{.R = 0.0225, .L = 0.0156, .c = 34e-6, .grid = {60, 13}, .cavitation = cavitation};
  m.supply = {SupplyKind::widest_gap, 0, 1e5};
  return m;
}

constexpr double omega = 374;

// Error of pressures and flows at a relative residual of 1e-10.
constexpr double solved = 1e-7;

// A wall at mid-width changes nothing of a bearing that is the same on both sides of it.
TEST_CASE("OneWall_IsTheMiddleOfABearingOfTwiceTheWidth") {
  for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
    for (const FilmSolver solver : {FilmSolver::newton, FilmSolver::multigrid, FilmSolver::sor}) {
      CAPTURE(static_cast<int>(cavitation));
      CAPTURE(static_cast<int>(solver));
      FilmModel whole = big_end(cavitation);
      whole.edge_left.ambient_fill = whole.edge_right.ambient_fill =
          cavitation == Cavitation::mass_conserving ? 0.5 : 0;
      FilmModel half = whole;
      half.L = 0.5 * whole.L, half.grid.n_z = whole.grid.n_z / 2 + 1;
      half.edge_left = {.kind = EdgeKind::closed};
      const SolvedFilm all = solve_cold(whole, turning(whole, 0.7, omega), {.solver = solver}),
                       right = solve_cold(half, turning(half, 0.7, omega), {.solver = solver});
      CHECK(right.summary.solved());
      double furthest = 0;
      for (int k = 0; k < half.grid.size(); ++k) {
        const int i = k / half.grid.n_z, j = k % half.grid.n_z + whole.grid.n_z / 2;
        furthest = std::max(furthest, std::abs(right.fields.p[k] - all.fields.p[whole.grid.index(i, j)]));
      }
      CHECK(furthest <= solved * all.fields.p.maxCoeff());
      CHECK(right.observed.flow_left == 0);
      CHECK(right.observed.flow_right == relative(all.observed.flow_right).epsilon(solved));
    }
  }
}

// The factor of a film nearby leaves of a residual its own size times how far the film has moved since.
TEST_CASE("ChordIncrement_LeavesWhatHasChangedTimesWhatIsMissing") {
  const FilmModel m = big_end(Cavitation::mass_conserving);
  SolvedFilm film = solve_cold(m, turning(m, 0.7, omega));
  REQUIRE(film.summary.solved());
  Reynolds reynolds(m);
  Eigen::VectorXd du;
  REQUIRE(reynolds.linearise(surfaces(m, turning(m, 0.7, omega)), {}, film.u).is_inside());
  CHECK_FALSE(reynolds.linear_solver().has_factor);
  reynolds.newton_increment(du);
  REQUIRE(reynolds.linear_solver().has_factor);
  const double moved = 1e-4;
  const SurfaceMotion nearby = surfaces(m, turning(m, 0.7 + moved, omega));
  REQUIRE(reynolds.chord_increment(nearby, {}, film.u, du).is_inside());
  const double missing = reynolds.residual().relative;
  const Vector6 wrench = reynolds.forces().wrench_on_shell;
  Reynolds anew(m);
  REQUIRE(anew.linearise(nearby, {}, film.u).is_inside());
  CHECK(anew.residual().relative == missing);
  CHECK(anew.forces().wrench_on_shell == wrench);
  REQUIRE(anew.linearise(nearby, {}, film.u + du).is_inside());
  // h^3 in a gap of 0.3 c: a relative change of 3 moved/0.3.
  CHECK(anew.residual().relative < 10 * moved * missing);
}

// Oil that a groove gives an edge at the cavitation pressure runs along it; where there is none of it, all nodes
// downstream empty at once.
TEST_CASE("FrontAlongAnEdge_TakesFewIterations") {
  FilmModel m{.R = 0.05, .L = 0.06, .c = 60e-6, .grid = {60, 13}};
  m.features = {{.phi = pi / 2, .arc = pi / 9, .length = 0.045, .pressure = 1e5}};
  const SurfaceMotion motion = surfaces(m, {.e = {0.4 * m.c, -0.5 * m.c}, .omega_journal = 314});
  SolvedFilm film = solve_cold(m, motion, {0, 0});
  REQUIRE(film.summary.solved());
  Eigen::VectorXd u = film.u;
  int emptied = 0;
  for (int i = 0; i < m.grid.n_phi; ++i) {
    for (const int j : {0, m.grid.n_z - 1}) {
      if (double& at = u[m.grid.index(i, j)]; at < 0) at = 0.1 * film.fields.p.maxCoeff(), ++emptied;
    }
  }
  REQUIRE(emptied > 20);
  Reynolds reynolds(m);
  const FilmSolveSummary again = solve_film(reynolds, motion, {}, {}, u);
  CHECK(again.solved());
  CHECK(again.iterations <= 5);
  CHECK((u - film.u).norm() < solved * film.u.norm());
}

TEST_CASE("Sor_AgreesWithNewton") {
  for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
    for (const bool laws : {false, true}) {
      for (const double e : {0.2, 0.7, 0.93}) {
        CAPTURE(static_cast<int>(cavitation));
        CAPTURE(laws);
        CAPTURE(e);
        FilmModel m = big_end(cavitation);
        if (laws) {
          m.compliance = m.R / 57e9;
          m.lubricant.viscosity_law = Barus{1.28e-8};
          m.asperities = {AsperityModel::greenwood_tripp_fit, 1e-6, 3e-3, 57e9, 0.1};
        }
        Journal journal = turning(m, e, omega);
        journal.tilt = {1e-4, 2e-4};
        const SurfaceMotion motion = surfaces(m, journal, 0.02);
        const SolvedFilm newton = solve_cold(m, motion, journal.e);
        const SolvedFilm sor = solve_cold(m, motion, journal.e, {.solver = FilmSolver::sor, .rtol = 1e-9});
        REQUIRE(newton.summary.solved());
        REQUIRE(sor.summary.solved());
        // A residual of 1e-9 of the largest throughput; weak spots of the film amplify it by the condition, some 1e3.
        CHECK((sor.wrench - newton.wrench).norm() < 1e-6 * newton.wrench.norm());
        CHECK((sor.fields.p - newton.fields.p).norm() < 1e-6 * newton.fields.p.norm());
        CHECK((sor.fields.theta - newton.fields.theta).cwiseAbs().maxCoeff() < 1e-5);
      }
    }
  }
}

TEST_CASE("SorInTime_AgreesWithNewton") {
  const FilmModel m = big_end(Cavitation::mass_conserving);
  Journal journal = turning(m, 0.7, omega);
  journal.e_rate = {0.03, -0.05};
  const SurfaceMotion motion = surfaces(m, journal);
  FilmHistory history{1e-4, Eigen::VectorXd::Constant(m.grid.size(), 0.9), Eigen::VectorXd::Zero(m.grid.size())};
  std::array<Eigen::VectorXd, 2> u{Eigen::VectorXd::Zero(m.grid.size()), Eigen::VectorXd::Zero(m.grid.size())};
  Reynolds reynolds(m);
  REQUIRE(solve_film(reynolds, motion, history, {}, u[0]).solved());
  REQUIRE(solve_film(reynolds, motion, history, {.solver = FilmSolver::sor, .rtol = 1e-10}, u[1]).solved());
  CHECK((u[0] - u[1]).norm() < 1e-7 * u[0].norm());  // SOR ends at 1e-10, which weak spots of the film amplify
}

TEST_CASE("HardFilms_ConvergeFromColdStart") {
  // Nearly closed gaps with every law on, from nothing, on three grids.
  for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
    for (const double e : {0.05, 0.9, 0.98, 1.01}) {
      for (const double alpha : {0.0, 2e-8}) {
        for (const Grid& grid : {Grid{60, 13}, Grid{61, 6}, Grid{180, 21}}) {
          CAPTURE(static_cast<int>(cavitation));
          CAPTURE(e);
          CAPTURE(alpha);
          CAPTURE(grid.n_phi);
          FilmModel m = big_end(cavitation);
          m.grid = grid;
          m.lubricant.viscosity_law = Barus{alpha};
          m.compliance = m.R / 57e9;
          m.asperities = {AsperityModel::greenwood_tripp_exact, 1e-6, 3e-3, 57e9, 0.1};
          const SolvedFilm film = solve_cold(m, turning(m, e, omega));
          CHECK(film.summary.solved());
          CHECK(film.summary.iterations <= 25);
        }
      }
    }
  }
}

TEST_CASE("SmallSteps_TakeFewIterations") {
  // A journal circling at half speed, in 0.5 degree steps of the shaft: from the last step's film.
  FilmModel m = big_end(Cavitation::mass_conserving);
  m.compliance = m.R / 57e9;
  Reynolds reynolds(m);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  FilmHistory history{pi / 360 / omega, Eigen::VectorXd::Ones(m.grid.size()), Eigen::VectorXd::Zero(m.grid.size())};
  int total = 0;
  const int steps = 200;
  for (int step = 0; step < steps; ++step) {
    const double angle = 0.5 * omega * step * history.dt, e = 0.9 * m.c;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle)), turned(-direction.y(), direction.x());
    const Journal journal{.e = -e * direction, .e_rate = -0.5 * omega * e * turned, .omega_journal = omega};
    const SurfaceMotion motion = surfaces(m, journal, angle);
    const FilmSolveSummary summary = solve_film(reynolds, motion, history, {}, u);
    REQUIRE(summary.solved());
    if (step > 0) total += summary.iterations;
    const FilmFields fields = film_fields(m, motion, u);
    history.theta = fields.theta;
    history.w = fields.w;
  }
  CHECK(total <= 3 * (steps - 1));  // two on average
}

TEST_CASE("FilmAtRest_IsSolvable") {
  // Nothing moves: any fill level is an answer, and none is an error.
  FilmModel m = big_end(Cavitation::mass_conserving);
  m.supply = {};
  const SolvedFilm film = solve_cold(m, Journal{.e = {1e-5, 0}});
  CHECK(film.summary.solved());
  CHECK(film.wrench.norm() == 0);
}

TEST_CASE("SolverWithoutAnswer_ReportsTheNode") {
  FilmModel m = big_end(Cavitation::mass_conserving);
  const SolvedFilm film = solve_cold(m, turning(m, 0.8, omega), {.max_iterations = 1});
  CHECK_FALSE(film.summary.solved());
  CHECK(film.summary.message.find("film cell (") != std::string::npos);
}

TEST_CASE("ViolatedContracts_AreNamed") {
  FilmModel m = big_end(Cavitation::mass_conserving);
  Reynolds reynolds(m);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  CHECK_THROWS_AS(reynolds.linearise(surfaces(m, turning(m, 0.5, omega)), {}, u.head(7)), ContractError);
  CHECK_THROWS_AS(reynolds.newton_increment(u), ContractError);
  m.grid.n_phi = 3;
  CHECK_THROWS_AS(Reynolds{m}, ContractError);
  m = big_end(Cavitation::mass_conserving);
  m.edge_left.pressure = -1;
  CHECK_THROWS_AS(Reynolds{m}, ContractError);
}

}  // namespace solver_test
}  // namespace hersey::film
