#include <doctest/doctest.h>

#include "film_cases.h"

// What conserving oil means: the film's own balances, and cavitation that comes and goes.
namespace hersey::film {
namespace {

FilmModel bearing(int n_phi = 60, int n_z = 13) {
  FilmModel m{.R = 0.0225, .L = 0.0156, .c = 34e-6, .grid = {n_phi, n_z}};
  m.supply = {SupplyKind::widest_gap, 0, 0};
  return m;
}

constexpr double omega = 374;

TEST_CASE("FloodedEdgesWithoutSupply_HaveNoNetSideFlow") {
  FilmModel m = bearing();
  m.supply = {};
  m.p_cav = 0;
  m.p_edge_left = m.p_edge_right = 1e5;
  const SolvedFilm film = solve_cold(m, turning(m, 0.6, omega));
  REQUIRE(film.summary.converged);
  CHECK(film.observed.p_max > 1e6);
  CHECK(film.observed.cavitated_share > 0.1);
  // The solver leaves 1e-10 of the largest throughput per node.
  const double scale = m.R * omega * m.c * m.L;
  CHECK(std::abs(film.observed.flow_left + film.observed.flow_right) < 1e-9 * scale);
  CHECK(film.observed.flow_left == doctest::Approx(film.observed.flow_right).epsilon(1e-9).scale(scale));
}

TEST_CASE("FilmWithoutAnySupply_Starves") {
  FilmModel m = bearing();
  m.supply = {};
  const SolvedFilm film = solve_cold(m, turning(m, 0.6, omega));
  CHECK(film.summary.converged);
  CHECK(film.summary.message.find("supply") != std::string::npos);
  CHECK(film.observed.p_max < 1e-6);
  CHECK(film.observed.force_pressure.norm() < 1e-6);  // N; with supply this bearing carries 456 N
  CHECK(film.fields.theta.maxCoeff() <= 1 + 1e-12);
  CHECK(film.fields.theta.minCoeff() >= 0);
}

TEST_CASE("SteadyFilm_BalancesItsOil") {
  for (const double e : {0.1, 0.5, 0.9, 0.98}) {
    CAPTURE(e);
    FilmModel m = bearing();
    m.p_edge_right = 2e5;  // from right to left through the bearing, one edge flooded and one in air
    m.supply.pressure = 3e5;
    const SolvedFilm film = solve_cold(m, surfaces(m, turning(m, e, omega), 0.03), {-e * m.c, 0});
    REQUIRE(film.summary.converged);
    CHECK(film.observed.flow_left > 0);
    CHECK(film.observed.flow_supply > 0);
    CHECK(film.observed.mass_balance_error < 1e-9);  // residual of the solver, summed
  }
}

// A time step conserves the oil it started with exactly if the gap's rate is that of the step itself.
TEST_CASE("TimeSteps_ConserveOil") {
  FilmModel m = bearing();
  m.compliance = 4e-13;
  const double dt = 2e-4;
  Reynolds reynolds(m);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  Journal journal = turning(m, 0.5, omega);
  SurfaceMotion before = surfaces(m, journal);
  REQUIRE(solve_film(reynolds, before, {}, {}, u).converged);
  for (int step = 1; step <= 20; ++step) {
    const FilmFields fields = film_fields(m, before, u);
    const FilmHistory history{dt, fields.theta, fields.w};
    const double volume_before = observe_film(m, before, {}, journal.e, u).oil_volume;
    journal.e = 0.5 * m.c * Eigen::Vector2d(-std::cos(0.1 * step), 0.8 * std::sin(0.1 * step));
    SurfaceMotion motion = surfaces(m, journal);
    motion.g_rate = (motion.g - before.g) / dt;
    const FilmSolveSummary summary = solve_film(reynolds, motion, history, {}, u);
    REQUIRE(summary.converged);
    CHECK(summary.iterations <= 8);
    const FilmObservables o = observe_film(m, motion, history, journal.e, u);
    const double change = (o.oil_volume - volume_before) / dt;
    const double scale = m.R * omega * m.c * m.L;
    CHECK(std::abs(o.flow_supply - o.flow_left - o.flow_right - change) < 1e-8 * scale);
    CHECK(o.mass_balance_error < 1e-8);
    before = motion;
  }
}

// Parabolic slider, closed on itself by a line at p_cav (reference: exact one-dimensional solution of the
// mass-conserving problem; ends at p = p_cav = 0).
TEST_CASE("ParabolicSlider_RupturesWhereItShould") {
  const double length = 0.0762, U = 4.57;
  for (const int n : {381, 762}) {
    FilmModel m{.R = length / (2 * pi), .L = 0.01, .c = 25.4e-6, .grid = {n, 3}, .lubricant = {.mu0 = 0.039}};
    m.supply = {SupplyKind::fixed_angle, 0, 0};
    m.edges = EdgeKind::closed;
    SurfaceMotion motion = surfaces(m, {});
    motion.u_journal = U;
    for (int i = 0; i < n; ++i) {
      const double x = 2.0 * i / n - 1;
      for (int j = 0; j < 3; ++j) motion.g[m.grid.index(i, j)] = 25.4e-6 * (1 + x * x);
    }
    const SolvedFilm film = solve_cold(m, motion, {0, 0});
    REQUIRE(film.summary.converged);
    double load = 0;
    int last = 0;
    for (int i = 0; i < n; ++i) {
      load += film.fields.p[m.grid.index(i, 1)] * length / n;
      if (film.u[m.grid.index(i, 1)] > 0) last = i;
    }
    const double dx = length / n;
    CHECK(std::abs(last * dx + 0.5 * dx - 0.0517348) < dx);
    CHECK(film.observed.p_max == doctest::Approx(3.591787e6).epsilon(30.0 / (n * n) + 1e-6));  // second order
    CHECK(load == doctest::Approx(101349.50).epsilon(30.0 / (n * n) + 1e-6));
  }
}

// Pure squeeze with cavitation that opens and closes again (Ausas, Jai and Buscaglia 2009; reference values exact).
TEST_CASE("SqueezedFilm_CavitatesAndReforms") {
  FilmModel m{.R = 1 / (2 * pi), .L = 0.1, .c = 0.4, .grid = {400, 3}, .lubricant = {.mu0 = 1.0 / 6}};
  m.supply = {SupplyKind::fixed_angle, 0, 0.025};
  m.edges = EdgeKind::closed;
  const auto gap = [](double t) { return 0.125 * std::cos(4 * pi * t) + 0.375; };
  const double dt = 1e-3, dx = 1.0 / m.grid.n_phi;
  Reynolds reynolds(m);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  FilmHistory history{dt, Eigen::VectorXd::Ones(m.grid.size()), Eigen::VectorXd::Zero(m.grid.size())};
  double first = 0, narrowest = 1, when = 0;
  for (int step = 1; step <= 400; ++step) {
    const double t = step * dt;
    SurfaceMotion motion = surfaces(m, {});
    motion.g.setConstant(gap(t));
    motion.g_rate.setConstant((gap(t) - gap(t - dt)) / dt);
    REQUIRE(solve_film(reynolds, motion, history, {}, u).converged);
    history.theta = film_fields(m, motion, u).theta;
    int full = 0;  // cells of full film from one end to the front
    while (full < m.grid.n_phi / 2 && history.theta[m.grid.index(full, 1)] >= 1) ++full;
    if (first == 0 && full < m.grid.n_phi / 2) first = t;
    const double width = full * dx;
    if (width < narrowest) narrowest = width, when = t;
  }
  // First order in time, one cell in space; the front is slow around its turning point, where it stays within one cell
  // for a while.
  CHECK(std::abs(first - 0.2500792) <= 2 * dt);
  CHECK(std::abs(narrowest - 0.0230077) <= 1.5 * dx);
  CHECK(std::abs(when - 0.3148259) <= 0.02);
}

// The film must not notice where the line lies between two nodes, nor lack oil there.
TEST_CASE("SupplyLine_WorksBetweenNodes") {
  const FilmModel m = bearing();
  const double e = 0.6, cell = 2 * pi / m.grid.n_phi;
  const double on_node = solve_cold(m, turning(m, e, omega)).wrench.segment<2>(3).norm();
  for (const double part : {0.05, 0.3, 0.5, 0.8}) {
    CAPTURE(part);
    const double angle = part * cell;
    const Journal journal{.e = -e * m.c * Eigen::Vector2d(std::cos(angle), std::sin(angle)), .omega_journal = omega};
    const SolvedFilm film = solve_cold(m, surfaces(m, journal, angle), journal.e);
    REQUIRE(film.summary.converged);
    CHECK(film.wrench.segment<2>(3).norm() == doctest::Approx(on_node).epsilon(0.5 * cell * cell));
    CHECK(film.fields.theta[m.grid.index(1, 6)] > 0.998);               // the first node downstream
    CHECK(film.fields.theta[m.grid.index(m.grid.n_phi - 1, 6)] < 0.9);  // upstream the film is broken
  }
}

TEST_CASE("FillScale_HasNoInfluence") {
  // The clearance only scales unknowns: with twice its value P0 is a quarter, the film the same.
  FilmModel m = bearing();
  const SurfaceMotion motion = surfaces(m, turning(m, 0.7, omega));
  const SolvedFilm film = solve_cold(m, motion, {0, 0});
  m.c *= 2;
  const SolvedFilm other = solve_cold(m, motion, {0, 0});
  CHECK((film.wrench - other.wrench).norm() < 1e-9 * film.wrench.norm());
  CHECK((film.fields.theta - other.fields.theta).cwiseAbs().maxCoeff() < 1e-9);
}

}  // namespace
}  // namespace hersey::film
