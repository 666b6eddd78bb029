#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "film_cases.h"
#include "relative.h"

// Edges with seals that leak.
namespace hersey::film {
namespace sealed_edge_test {

FilmModel damper(double leakage) {
  FilmModel m{.R = 0.05, .L = 0.03, .c = 100e-6, .grid = {48, 9}, .cavitation = Cavitation::full_film};
  m.edge_left = {.kind = EdgeKind::leaking, .pressure = 1e5, .leakage = leakage};
  m.edge_right = {.kind = EdgeKind::leaking, .pressure = 0, .leakage = 3 * leakage};
  return m;
}

// Around a journal at rest in the middle pressure falls along the axis alone: the film's half width and the seal resist
// as 1 and 1/kappa in units of 12 mu (L/2)/c^3 per circumference.
TEST_CASE("FeedBetweenSeals_LeaksAsTwoResistancesInSeries") {
  for (const Cavitation cavitation : {Cavitation::full_film, Cavitation::reynolds, Cavitation::mass_conserving}) {
    FilmModel m = damper(0.4);
    m.cavitation = cavitation;
    m.features = {{.name = "groove", .phi = 0, .z = 0, .arc = 2 * pi, .length = 1e-9, .pressure = 5e5}};
    const SolvedFilm film = solve_cold(m, Journal{});
    REQUIRE(film.summary.solved());
    const double unit = 2 * pi * m.R * std::pow(m.c, 3) / (6 * m.lubricant.mu0 * m.L);
    const double left = unit * 4e5 / (1 + 1 / 0.4), right = unit * 5e5 / (1 + 1 / 1.2);
    // The groove is 1e-9 m wide, 3e-8 of the half width.
    constexpr double kNarrow = 1e-7;
    CHECK(film.observed.flow_left == relative(left).epsilon(kNarrow));
    CHECK(film.observed.flow_right == relative(right).epsilon(kNarrow));
    CHECK(film.observed.flow_supply == relative(left + right).epsilon(kNarrow));
    CHECK(film.fields.p[0] == relative(1e5 + left / (0.4 * unit)).epsilon(kNarrow));
    CHECK(film.observed.mass_balance_error < 1e-9);  // the same
  }
}

TEST_CASE("Seals_TendToOpenAndToClosedEdges") {
  const Journal squeeze{.e = {30e-6, 0}, .e_rate = {2e-3, 3e-3}};
  const auto force = [&](const FilmModel& m) {
    const SolvedFilm film = solve_cold(m, squeeze);
    REQUIRE(film.summary.solved());
    return Vector6(film.wrench);
  };
  FilmModel open = damper(1);
  open.edge_left.kind = open.edge_right.kind = EdgeKind::pressure;
  const Vector6 of_open = force(open);
  const double far = (force(damper(1e3)) - of_open).norm(), farther = (force(damper(1e5)) - of_open).norm();
  CHECK(far < 1e-2 * of_open.norm());                   // of first order in 1/kappa
  CHECK(farther == relative(far / 100).epsilon(0.02));  // the next order, 1/kappa
  // Without a level given, a closed film's pressure is known but for a constant, which bears nothing.
  FilmModel closed = damper(1);
  closed.edge_left.kind = closed.edge_right.kind = EdgeKind::closed;
  closed.features = {{.name = "feed", .phi = 1, .arc = 0.2, .length = 1e-3, .pressure = 2e5}};
  const auto fed = [&](double leakage) {
    FilmModel m = damper(leakage);
    m.features = closed.features;
    return m;
  };
  const Vector6 of_closed = force(closed);
  const double near = (force(fed(1e-4)) - of_closed).norm(), nearer = (force(fed(1e-6)) - of_closed).norm();
  CHECK(near < 1e-2 * of_closed.norm());                // of first order in kappa
  CHECK(nearer == relative(near / 100).epsilon(0.02));  // the next order
}

TEST_CASE("SealedFilm_IsTheSameByEverySolver") {
  for (const Cavitation cavitation : {Cavitation::full_film, Cavitation::reynolds, Cavitation::mass_conserving}) {
    FilmModel m = damper(0.5);
    m.cavitation = cavitation;
    const Journal orbit{.e = {60e-6, 0}, .omega_shell = -40, .omega_journal = -40};
    const SolvedFilm newton = solve_cold(m, orbit);
    REQUIRE(newton.summary.solved());
    for (const FilmSolver solver : {FilmSolver::sor, FilmSolver::multigrid}) {
      const SolvedFilm other = solve_cold(m, orbit, {.solver = solver});
      REQUIRE(other.summary.solved());
      CHECK((other.wrench - newton.wrench).norm() < 1e-6 * newton.wrench.norm());  // relaxation ends at 1e-10 of flows
    }
  }
}

// Oil that leaves through the seals over a step is what the film loses.
TEST_CASE("OilOfASealedFilm_IsConservedAtAnyStep") {
  FilmModel m = damper(0.5);
  m.cavitation = Cavitation::mass_conserving;
  m.lubricant.density_law = BubblyOil{0.1, 1e5};
  const Journal squeeze{.e = {30e-6, 0}, .e_rate = {-40e-3, 30e-3}};
  const SurfaceMotion motion = surfaces(m, squeeze);
  Reynolds reynolds(m);
  FilmHistory history{.dt = 1e-4};
  history.theta = Eigen::VectorXd::Ones(m.grid.size());
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  REQUIRE(solve_film(reynolds, motion, history, {}, u).solved());
  StepOilBalance oil;
  reynolds.settle(motion, history, u, oil);
  SurfaceMotion start = motion;
  start.g -= history.dt * motion.g_rate;
  const double before = oil_at_start(m, start, {}, Eigen::VectorXd::Zero(m.grid.size())).volume;
  const double lost = history.dt * (oil.flow_left + oil.flow_right);
  CHECK(std::abs(lost) > 1e-4 * before);                        // the film breathes
  CHECK(std::abs(oil.volume - before + lost) < 1e-9 * before);  // the solver's 1e-10 of the flows
}

}  // namespace sealed_edge_test
}  // namespace hersey::film
