#include <doctest/doctest.h>

#include <array>
#include <string>

#include "film_cases.h"
#include "film_closed_forms.h"
#include "hersey/film/film_heat.h"
#include "relative.h"

// Films on other surfaces than a bore, and on patches of it: closed forms, and the same film laid out in another way.
namespace hersey::film {
namespace surfaces_test {

double order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

// Relative errors that solvers leave of fields, of sums over them and of flows.
constexpr double of_fields = 1e-7, of_sums = 1e-8, of_flows = 1e-9, of_sweeps = 1e-5;

constexpr double length = 0.05, width = 0.01, speed = 3, viscosity = 0.02, outlet = 2e-5;

/// A pad along y from 0 to `length`, walls at its sides.
FilmModel pad(int lines, int rows = 3) {
  FilmModel m{.surface = Plane{},
              .R = length,
              .L = width,
              .c = outlet,
              .grid = patch_grid({{.from = 0, .to = 1, .lines = lines}}, rows),
              .ends = {PatchEnds{}}};
  m.lubricant.mu0 = viscosity;
  m.p_cav = -1e5;  // there is oil at both ends
  m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
  return m;
}

/// A gap over phi and z, the journal's surface sliding.
template <class Gap>
SurfaceMotion sliding(const FilmModel& m, Gap&& gap) {
  SurfaceMotion motion;
  motion.g.resize(m.grid.size()), motion.g_rate.setZero(m.grid.size());
  for (int k = 0; k < m.grid.size(); ++k)
    motion.g[k] = gap(m.grid.phi(k / m.grid.n_z), m.L * m.grid.z_over_L(k % m.grid.n_z));
  motion.u_journal = speed;
  return motion;
}

// Reynolds' slider at its optimum inclination, Lamb's closed forms: load, friction on the pad, centre of pressure.
TEST_CASE("PlanePad_ConvergesToTheClosedFormsWithOrderTwo") {
  const verification::LongSlider exact{.K = 1.18870};
  const double load = 6 * viscosity * speed * std::pow(length / outlet, 2) * exact.load() * width;
  const double on_runner = viscosity * speed * length / outlet * width * exact.friction();
  // Along the plane, where no slope bears a part of the load.
  const double friction = on_runner - load * exact.K * outlet / length;
  std::array<double, 2> load_error{}, friction_error{}, centre_error{};
  for (int k = 0; k < 2; ++k) {
    const FilmModel m = pad(k == 0 ? 41 : 81);
    const SurfaceMotion motion = sliding(m, [&](double y, double) { return outlet * (1 + exact.K * (1 - y)); });
    const SolvedFilm film = solve_cold(m, motion, {0, 0});
    REQUIRE(film.summary.solved());
    CHECK(film.observed.mass_balance_error < 1e-10);  // the solver's
    load_error[k] = film.wrench[3] / load - 1;
    friction_error[k] = film.wrench[4] / friction - 1;
    centre_error[k] = -film.wrench[2] / film.wrench[3] / length / exact.centre() - 1;
    // The power that pulls the runner is dissipated in the film.
    CHECK(film.observed.power_taken() == relative(speed * on_runner).epsilon(2e-3));
  }
  CHECK(std::abs(load_error[1]) < 3e-4);
  CHECK(std::abs(friction_error[1]) < 1e-3);  // of order two as well
  CHECK(std::abs(centre_error[1]) < 3e-4);
  CHECK(order(load_error[0], load_error[1]) == doctest::Approx(2).epsilon(0.1));
}

FilmModel ring(int n_phi, int n_z) {
  FilmModel m{.surface = Annulus{}, .R = 0.05, .L = 0.04, .c = outlet, .grid = {n_phi, n_z}};
  m.lubricant.mu0 = viscosity;
  return m;
}

constexpr verification::ParallelAnnulus discs{.r1 = 0.03, .r2 = 0.07};

// Oil from the middle of a hydrostatic bearing: Q = pi h^3 dp/(6 mu ln(r2/r1)), and what pushes the runner up.
TEST_CASE("HydrostaticAnnulus_ConvergesToTheClosedFormWithOrderTwo") {
  const double p = 2e6, flow = discs.flow() * std::pow(outlet, 3) * p / viscosity, load = discs.area() * p;
  std::array<double, 2> flow_error{}, load_error{};
  for (int k = 0; k < 2; ++k) {
    FilmModel m = ring(24, k == 0 ? 11 : 21);
    m.edge_left.pressure = p;
    SurfaceMotion motion = sliding(m, [](double, double) { return outlet; });
    motion.u_journal = 0;
    const SolvedFilm film = solve_cold(m, motion, {0, 0});
    REQUIRE(film.summary.solved());
    flow_error[k] = film.observed.flow_right / flow - 1;
    load_error[k] = -film.wrench[5] / load - 1;
    CHECK(film.observed.flow_left == relative(-film.observed.flow_right).epsilon(1e-9));  // the solver's
    CHECK(film.observed.power_film == relative(flow * p).epsilon(5e-3));
  }
  CHECK(std::abs(flow_error[1]) < 5e-4);
  CHECK(std::abs(load_error[1]) < 5e-4);
  CHECK(order(flow_error[0], flow_error[1]) == doctest::Approx(2).epsilon(0.1));
}

// The runner rotates: T = pi mu omega (r2^4 - r1^4)/(2 h), and its drive provides the power T omega.
TEST_CASE("RotatingAnnulus_DragsWithTheRadius") {
  const FilmModel m = ring(24, 21);
  const double omega = speed / m.R;
  const SolvedFilm film = solve_cold(m, sliding(m, [](double, double) { return outlet; }), {0, 0});
  REQUIRE(film.summary.solved());
  const double torque = discs.torque() * viscosity * omega / outlet;
  // Weights are exact for parabolas; r^3 costs their error of fourth order.
  CHECK(film.wrench[2] == relative(torque).epsilon(2e-5));
  CHECK(film.observed.torque_journal == relative(-torque).epsilon(2e-5));
  CHECK(film.observed.power_film == relative(torque * omega).epsilon(2e-5));
}

// Two discs approach: W = (3 pi mu V/(2 h^3)) (r2^4 - r1^4 - (r2^2 - r1^2)^2/ln(r2/r1)).
TEST_CASE("SqueezedAnnulus_ConvergesToTheClosedFormWithOrderTwo") {
  const double V = 0.01, load = discs.squeeze() * viscosity * V / std::pow(outlet, 3);
  std::array<double, 2> error{};
  for (int k = 0; k < 2; ++k) {
    const FilmModel m = ring(24, k == 0 ? 11 : 21);
    SurfaceMotion motion = sliding(m, [](double, double) { return outlet; });
    motion.u_journal = 0;
    motion.g_rate.setConstant(-V);
    const SolvedFilm film = solve_cold(m, motion, {0, 0});
    error[k] = -film.wrench[5] / load - 1;
  }
  CHECK(std::abs(error[1]) < 2e-3);
  CHECK(order(error[0], error[1]) == doctest::Approx(2).epsilon(0.1));
}

FilmModel bore(const Grid& grid) {
  FilmModel m{.R = 0.03, .L = 0.03, .c = 30e-6, .grid = grid};
  m.shear_force = ShearForce::full;
  return m;
}

constexpr double supplied = 3e5;

// Half a bore with oil at its ends is the whole one whose other half is a groove.
TEST_CASE("PatchOfABore_IsTheFilmBesideAGroove") {
  const int n = 48;
  for (const Cavitation cavitation : {Cavitation::mass_conserving, Cavitation::reynolds, Cavitation::guembel}) {
    CAPTURE(static_cast<int>(cavitation));
    FilmModel whole = bore({n, 9}), half = bore(patch_grid({{.from = 0, .to = pi, .lines = n / 2 + 1}}, 9));
    whole.cavitation = half.cavitation = cavitation;
    whole.features = {
        {.name = "groove", .phi = 1.5 * pi, .arc = pi * (1 + 1e-9), .length = whole.L * 2, .pressure = supplied}};
    half.ends = {{.first = {.pressure = supplied}, .last = {.pressure = supplied}}};
    const Journal journal{.e = {-8e-6, 17e-6}, .e_rate = {1e-3, 2e-3}, .tilt = {2e-4, 0}, .omega_journal = 200};
    const SolvedFilm a = solve_cold(whole, journal), b = solve_cold(half, journal);
    REQUIRE(a.summary.solved());
    REQUIRE(b.summary.solved());
    double largest = 0;
    for (int i = 1; i < n / 2; ++i) {
      for (int j = 1; j < 8; ++j) {
        const double pa = a.fields.p[whole.grid.index(i, j)], pb = b.fields.p[half.grid.index(i, j)];
        largest = std::max(largest, std::abs(pa - pb));
        CHECK(std::abs(a.fields.theta[whole.grid.index(i, j)] - b.fields.theta[half.grid.index(i, j)]) <
              10 * of_fields);
      }
    }
    CHECK(largest < of_fields * a.observed.p_max);
    CHECK(b.observed.h_min == relative(a.observed.h_min).epsilon(of_flows));
    CHECK(b.observed.p_max == relative(a.observed.p_max).epsilon(10 * of_fields));
    if (cavitation == Cavitation::mass_conserving) CHECK(b.observed.mass_balance_error < of_flows);
  }
}

// Pads on one grid are independent: each has its film, and their wrenches add.
TEST_CASE("PatchesOfOneFilm_AreEachOnItsOwn") {
  const std::vector<Patch> pads{
      {.from = 0.2, .to = 1.9, .lines = 15}, {.from = 2.4, .to = 4, .lines = 12}, {.from = 4.3, .to = 6, .lines = 17}};
  const Journal journal{.e = {-8e-6, 17e-6}, .tilt = {2e-4, 0}, .omega_journal = 200};
  const auto solved = [&](const std::vector<Patch>& patches) {
    FilmModel m = bore(patch_grid(patches, 7));
    m.ends.assign(patches.size(), {.first = {.pressure = supplied}, .last = {}});
    return solve_cold(m, journal);
  };
  const SolvedFilm all = solved(pads);
  REQUIRE(all.summary.solved());
  Vector6 sum = Vector6::Zero();
  double ends = 0;
  int first = 0;
  for (const Patch& one : pads) {
    const SolvedFilm alone = solved({one});
    REQUIRE(alone.summary.solved());
    sum += alone.wrench, ends += alone.observed.flow_ends();
    const auto n = alone.fields.p.size();
    CHECK((all.fields.p.segment(first, n) - alone.fields.p).cwiseAbs().maxCoeff() < of_fields * all.observed.p_max);
    first += static_cast<int>(n);
  }
  CHECK((all.wrench - sum).norm() < of_sums * sum.norm());
  CHECK(all.observed.flow_ends() == relative(ends).epsilon(of_fields));
}

// All solvers are tested.
TEST_CASE("PatchesOfOneFilm_HaveOneAnswer") {
  FilmModel m = bore(patch_grid({{.from = 0.2, .to = 2.6, .lines = 31}, {.from = 3.3, .to = 5.9, .lines = 29}}, 9));
  m.ends.assign(2, {.first = {.pressure = supplied}, .last = {}});
  const SurfaceMotion motion = surfaces(m, {.e = {-8e-6, 17e-6}, .omega_journal = 200});
  const SolvedFilm by_newton = solve_cold(m, motion, {-8e-6, 17e-6});
  REQUIRE(by_newton.summary.solved());
  const SolvedFilm by_sor = solve_cold(m, motion, {-8e-6, 17e-6}, {.solver = FilmSolver::sor});
  REQUIRE(by_sor.summary.solved());
  CHECK((by_sor.fields.p - by_newton.fields.p).cwiseAbs().maxCoeff() < of_sweeps * by_newton.observed.p_max);
  Reynolds reynolds(m, LinearSolver::multigrid);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  REQUIRE(solve_film(reynolds, motion, {}, {}, u).solved());
  CHECK(reynolds.linear_solver().fallback_solves == 0);
  CHECK((film_fields(m, motion, u).p - by_newton.fields.p).cwiseAbs().maxCoeff() <
        of_fields * by_newton.observed.p_max);
}

// A journal that swings between two pads, part of them cavitated, whatever the step: oil at the end is oil at the start
// and what has come in, to round-off; no fill fraction leaves [0, 1].
TEST_CASE("OilOfPads_IsConservedAtAnyStep") {
  FilmModel m = bore(patch_grid({{.from = 0.2, .to = 2.8, .lines = 26}, {.from = 3.4, .to = 6, .lines = 25}}, 9));
  m.ends = {{.first = {.pressure = supplied}, .last = {}},
            {.first = {.pressure = supplied}, .last = {.kind = EdgeKind::closed}}};
  for (const bool backwards : {false, true}) {
    for (const double dt : {1e-5, 1e-3}) {
      CAPTURE(backwards);
      CAPTURE(dt);
      Reynolds reynolds(m);
      Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
      FilmHistory history{dt, Eigen::VectorXd::Ones(m.grid.size()), Eigen::VectorXd::Zero(m.grid.size())};
      StepOilBalance oil;
      double volume = 0, passed = 0, worst = 0;
      const auto at = [&](double t) {
        const double r = m.c * (0.4 + 0.3 * std::sin(900 * t)), r_rate = m.c * 0.3 * 900 * std::cos(900 * t);
        const Eigen::Vector2d er(std::cos(140 * t), std::sin(140 * t)), ea(-er.y(), er.x());
        return surfaces(
            m, {.e = r * er, .e_rate = r_rate * er + 140 * r * ea, .omega_journal = backwards ? -300.0 : 300.0});
      };
      for (int step = 0; step <= 30; ++step) {
        const SurfaceMotion motion = at(step * dt);
        REQUIRE(solve_film(reynolds, motion, history, {}, u).solved());
        if (step == 0) {
          oil = oil_at_start(m, motion, history, u);
        } else {
          reynolds.settle(motion, history, u, oil);
          if (oil.redistributed_overfill > 0.02) {
            history.by_gap = true;
            REQUIRE(solve_film(reynolds, motion, history, {}, u).solved());
            reynolds.settle(motion, history, u, oil);
            history.by_gap = false;
          }
          worst = std::max(worst, std::abs(oil.volume - volume - dt * (oil.flow_supply - oil.flow_out())));
          passed += dt * std::max(std::abs(oil.flow_ends()), std::abs(oil.flow_left + oil.flow_right));
        }
        volume = oil.volume;
        CHECK(oil.content.minCoeff() >= 0);
        CHECK(oil.content.maxCoeff() <= 1 + 1e-12);  // round-off
        history.theta = oil.content, history.w = film_fields(m, motion, u).w, history.gap = oil.gap;
      }
      CHECK(worst < of_flows * passed / 30);
    }
  }
}

// Oil between parallel plates without conduction warms by 2 mu U/(rho c h^2) per length.
TEST_CASE("ParallelPad_WarmsAsTheClosedForm") {
  FilmModel m = pad(41);
  m.lubricant.temperature_law = FixedViscosity{viscosity};
  const SurfaceMotion motion = sliding(m, [](double, double) { return outlet; });
  const SolvedFilm film = solve_cold(m, motion, {0, 0});
  ThermalModel thermal{.layers = 1, .shell = InsulatedWall{}, .journal = InsulatedWall{}};
  FilmHeat heat(m, thermal);
  for (int k = 0; k < 3; ++k) heat.advance(motion, {}, film.u);
  const double rate =
      2 * viscosity * speed / (m.lubricant.density * m.lubricant.specific_heat * outlet * outlet) * length;
  const TemperatureFields fields = heat.fields();
  const auto at = [&](int line) { return fields.middle[m.grid.index(line, 1)]; };
  // Beside the inlet oil enters half a cell warm.
  for (const int line : {20, 30, 40}) CHECK(at(line) - at(line - 10) == relative(rate / 4).epsilon(1e-6));
}

}  // namespace surfaces_test
}  // namespace hersey::film
