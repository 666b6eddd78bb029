#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "film_cases.h"
#include "relative.h"

// Pads that a given flow of oil reaches: flooded where it suffices, starved where it does not.
namespace hersey::film {
namespace given_flow_test {

constexpr double length = 0.04, inlet = 60e-6, outlet = 30e-6, mu = 0.02, U = 5;

/// A wide slider whose gap falls linearly along x; `moves` is the side over which the runner comes in.
struct Slider {
  FilmModel model;
  SurfaceMotion motion;
};

Slider slider(int lines, std::optional<double> flow, bool mirrored = false) {
  Slider s;
  FilmModel& m = s.model;
  m = {.surface = Plane{}, .R = 1, .L = 0.01, .c = outlet, .grid = patch_grid({{0, length, lines}}, 3)};
  m.lubricant.mu0 = mu;
  m.lubricant.temperature_law = FixedViscosity{mu};
  m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
  const Edge leading{.ambient_fill = 1, .flow = flow}, trailing{.ambient_fill = 1};
  m.ends = {mirrored ? PatchEnds{trailing, leading} : PatchEnds{leading, trailing}};
  s.motion.g.resize(m.grid.size());
  s.motion.g_rate.setZero(m.grid.size());
  for (int i = 0; i < lines; ++i) {
    const double x = mirrored ? length - m.grid.phi(i) : m.grid.phi(i);
    s.motion.g.segment(m.grid.index(i, 0), 3).setConstant(inlet + (outlet - inlet) * x / length);
  }
  s.motion.u_journal = mirrored ? -U : U;
  return s;
}

SolvedFilm solved(const Slider& s, FilmSolver solver = FilmSolver::newton) {
  SolvedFilm film = solve_cold(s.model, s.motion, {0, 0}, {.solver = solver, .rtol = 1e-11});
  REQUIRE(film.summary.solved());
  CHECK(film.observed.mass_balance_error < 1e-10 * s.model.grid.size());  // the solver's tolerance, per node
  return film;
}

/// Load per width of a slider between the gaps h_1 > h_2 (Hamrock's closed form).
double load_of(double h_1, double h_2, double l) {
  const double K = h_1 / h_2 - 1;
  return 6 * mu * U * l * l / (h_2 * h_2) * (std::log(1 + K) - 2 * K / (2 + K)) / (K * K);
}

/// Flow per width of that slider.
double flow_of(double h_1, double h_2) { return U * h_1 * h_2 / (h_1 + h_2); }

double load(const SolvedFilm& film, const Slider& s) { return std::abs(film.wrench[3]) / s.model.L; }

TEST_CASE("GivenFlow_StarvesAPadOrFloodsIt") {
  const double width = 0.01, flooded = flow_of(inlet, outlet) * width;
  for (const bool mirrored : {false, true}) {
    CAPTURE(mirrored);
    const Slider full = slider(161, std::nullopt, mirrored), ample = slider(161, 2 * flooded, mirrored);
    const SolvedFilm as_drawn = solved(full), spilling = solved(ample);
    // What finds no room is lost: the film is the flooded one.
    CHECK(load(spilling, ample) == relative(load(as_drawn, full)).epsilon(1e-9));  // the solver's tolerance, amplified
    for (const double fraction : {0.95, 0.85}) {
      CAPTURE(fraction);
      // The full film begins where the oil fills the gap of a slider that draws so much.
      const double q = fraction * flow_of(inlet, outlet), begins = q * outlet / (U * outlet - q);
      const double exact =
          begins <= outlet ? 0 : load_of(begins, outlet, length * (begins - outlet) / (inlet - outlet));
      std::array<double, 2> error{};
      for (const int k : {0, 1}) {
        const Slider s = slider(k == 0 ? 81 : 641, q * width, mirrored);
        const SolvedFilm film = solved(s);
        error[static_cast<std::size_t>(k)] = std::abs(load(film, s) / exact - 1);
        const double draws = mirrored ? -film.observed.flow_last : -film.observed.flow_first;
        CHECK(draws == relative(q * width).epsilon(1e-9));  // the solver's tolerance, amplified
        const int beside = s.model.grid.index(mirrored ? s.model.grid.n_phi - 2 : 1, 1);
        CHECK(film.fields.theta[beside] < 1);
      }
      CHECK(error[0] < 0.05);  // the front lies within a cell of 80
      CHECK(error[1] < 0.3 * error[0]);
    }
  }
}

// Less than half of U h/2 at the outlet fills no gap anywhere.
TEST_CASE("TooLittleOil_CarriesNothing") {
  const Slider s = slider(81, 0.9 * 0.5 * U * outlet * 0.01);
  const SolvedFilm film = solved(s);
  CHECK(film.observed.p_max == 0);
  CHECK(film.observed.flow_last == relative(-film.observed.flow_first).epsilon(1e-9));  // round-off of sums
}

TEST_CASE("GivenFlow_IsOneFilmForEverySolver") {
  const Slider s = slider(81, 0.85 * flow_of(inlet, outlet) * 0.01);
  const SolvedFilm film = solved(s);
  for (const FilmSolver solver : {FilmSolver::sor, FilmSolver::multigrid})
    CHECK(load(solved(s, solver), s) == relative(load(film, s)).epsilon(1e-6));  // residuals, amplified
}

TEST_CASE("GivenFlow_HasExactDerivatives") {
  const Slider s = slider(81, 0.85 * flow_of(inlet, outlet) * 0.01);
  Reynolds reynolds(s.model);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(s.model.grid.size());
  REQUIRE(solve_film(reynolds, s.motion, {}, {.rtol = 1e-12}, u).solved());
  MotionDirection direction;
  direction.g.resize(s.model.grid.size());
  for (int k = 0; k < s.model.grid.size(); ++k) direction.g[k] = 1 + 0.3 * std::sin(0.1 * k);
  Eigen::VectorXd du;
  Vector6 partial;
  respond(reynolds, direction, du, partial);
  const double step = 1e-11;  // m, of a film of 30 um: differences to 1e-6
  std::array<Eigen::VectorXd, 2> moved;
  for (const int k : {0, 1}) {
    SurfaceMotion motion = s.motion;
    motion.g += (k == 0 ? -step : step) * direction.g;
    moved[static_cast<std::size_t>(k)] = u;
    REQUIRE(solve_film(reynolds, motion, {}, {.rtol = 1e-12}, moved[static_cast<std::size_t>(k)]).solved());
  }
  const Eigen::VectorXd difference = (moved[1] - moved[0]) / (2 * step);
  CHECK((du - difference).norm() < 1e-5 * difference.norm());  // round-off of the difference
}

}  // namespace given_flow_test
}  // namespace hersey::film
