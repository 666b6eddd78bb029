#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "film_cases.h"
#include "relative.h"

// A layer of oil that the journal's surface carries in over an edge: it floods the film where it suffices and starves
// it where it does not.
namespace hersey::film {
namespace layer_test {

constexpr double length = 0.04, width = 0.01, inlet = 60e-6, outlet = 30e-6, mu = 0.02, U = 5;

/// A wide slider whose gap falls linearly along z. `upwards`: the runner comes in over the edge z = -L/2.
struct Slider {
  FilmModel model;
  SurfaceMotion motion;
  bool upwards = true;
  /// Oil that comes in over the leading edge [m^3/s].
  [[nodiscard]] double drawn(const SolvedFilm& film) const {
    return -(upwards ? film.observed.flow_left : film.observed.flow_right);
  }
};

Slider slider(int rows, std::optional<double> layer, bool upwards = true) {
  Slider s;
  s.upwards = upwards;
  FilmModel& m = s.model;
  m = {.surface = Plane{}, .R = 1, .L = length, .c = outlet, .grid = patch_grid({{0, width, 4}}, rows)};
  m.lubricant.mu0 = mu;
  m.lubricant.temperature_law = FixedViscosity{mu};
  m.ends = {{.first = {.kind = EdgeKind::closed}, .last = {.kind = EdgeKind::closed}}};
  m.edge_left.ambient_fill = m.edge_right.ambient_fill = 1;
  (upwards ? m.edge_left : m.edge_right).layer = layer;
  s.motion.g.resize(m.grid.size());
  s.motion.g_rate.setZero(m.grid.size());
  for (int k = 0; k < m.grid.size(); ++k) {
    const double z = m.grid.z_over_L(k % rows), behind = 0.5 + (upwards ? z : -z);  // of the length
    s.motion.g[k] = inlet + (outlet - inlet) * behind;
  }
  s.motion.w_journal = upwards ? U : -U;
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

double load(const SolvedFilm& film) { return std::abs(film.wrench[3]) / width; }

TEST_CASE("Layer_FloodsASliderOrStarvesIt") {
  for (const bool upwards : {true, false}) {
    CAPTURE(upwards);
    const Slider full = slider(161, std::nullopt, upwards), ample = slider(161, 2 * inlet, upwards);
    const SolvedFilm as_drawn = solved(full), scraping = solved(ample);
    CHECK(load(scraping) == relative(load(as_drawn)).epsilon(1e-9));  // the solver's tolerance, amplified
    CHECK(scraping.observed.starved_share == 0);
    const double brought = 2 * inlet * U * width;
    CHECK(scraping.observed.flow_scraped ==
          relative(brought - ample.drawn(scraping)).epsilon(1e-9));  // the solver's tolerance, amplified
    for (const double fraction : {0.95, 0.85}) {
      CAPTURE(fraction);
      // The full film begins where the oil fills the gap of a slider that draws so much.
      const double layer = fraction * flow_of(inlet, outlet) / U, begins = layer * outlet / (outlet - layer);
      const double starved = (inlet - begins) / (inlet - outlet),
                   exact = load_of(begins, outlet, length * (1 - starved));
      std::array<double, 2> error{}, of_front{};
      for (const std::size_t k : {0U, 1U}) {
        const Slider s = slider(k == 0 ? 81 : 641, layer, upwards);
        const SolvedFilm film = solved(s);
        error.at(k) = std::abs(load(film) / exact - 1);
        of_front.at(k) = std::abs(film.observed.starved_share - starved);
        CHECK(s.drawn(film) == relative(layer * U * width).epsilon(1e-9));   // the solver's tolerance, amplified
        CHECK(std::abs(film.observed.flow_scraped) < 1e-9 * s.drawn(film));  // likewise
      }
      CHECK(error[0] < 0.05);  // the front lies within a cell of 80
      CHECK(error[1] < 0.3 * error[0]);
      CHECK(of_front[0] < 1.0 / 80);
      CHECK(of_front[1] < 1.0 / 640);
    }
  }
}

// It fills 2 h_l/h of the gap that it meets: less than half of the outlet's fills no gap anywhere, nothing fills none.
TEST_CASE("ThinLayer_CarriesNothing") {
  for (const double layer : {0.9 * 0.5 * outlet, 0.0}) {
    CAPTURE(layer);
    const Slider s = slider(81, layer);
    const SolvedFilm film = solved(s);
    CHECK(film.observed.p_max == 0);
    CHECK(film.observed.starved_share > 1 - 1.0 / 80);  // the half volume on the edge where the oil leaves is full
    CHECK(film.observed.flow_right == doctest::Approx(layer * U * width).epsilon(1e-9));  // round-off of sums
    const double filled = film.fields.theta[s.model.grid.index(1, 20)];
    CHECK(std::abs(filled - 2 * layer / s.motion.g[20]) < 0.5 / 80);  // oil leaves a volume by the gap of its face
  }
}

// Where the runner leaves the film the layer on it is of no account.
TEST_CASE("LayerOnTheEdgeThatTrails_BringsNothing") {
  const Slider plain = slider(81, inlet);  // some of it is scraped off
  Slider both = plain;
  both.model.edge_right.layer = 1e-3;
  CHECK(load(solved(both)) == relative(load(solved(plain))).epsilon(1e-9));  // the solver's tolerance, amplified
  CHECK(solved(both).observed.flow_scraped == relative(solved(plain).observed.flow_scraped).epsilon(1e-9));  // likewise
}

TEST_CASE("Layer_IsOneFilmForEverySolver") {
  const Slider s = slider(81, 0.85 * flow_of(inlet, outlet) / U);
  const SolvedFilm film = solved(s);
  for (const FilmSolver solver : {FilmSolver::sor, FilmSolver::multigrid})
    CHECK(load(solved(s, solver)) == relative(load(film)).epsilon(1e-6));  // residuals, amplified
}

// By the gap and by the speed that brings the oil.
TEST_CASE("Layer_HasExactDerivatives") {
  for (const bool upwards : {true, false}) {
    CAPTURE(upwards);
    const Slider s = slider(81, 0.85 * flow_of(inlet, outlet) / U, upwards);
    Reynolds reynolds(s.model);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(s.model.grid.size());
    REQUIRE(solve_film(reynolds, s.motion, {}, {.rtol = 1e-12}, u).solved());
    MotionDirection direction;
    direction.g.resize(s.model.grid.size());
    for (int k = 0; k < s.model.grid.size(); ++k) direction.g[k] = 1 + 0.3 * std::sin(0.1 * k);
    direction.w_journal = 2e5;  // per metre of that gap: both change the film alike
    Eigen::VectorXd du;
    Vector6 partial;
    respond(reynolds, direction, du, partial);
    const double step = 1e-11;  // m, of a film of 30 um: differences to 1e-6
    std::array<Eigen::VectorXd, 2> moved;
    for (const std::size_t k : {0U, 1U}) {
      SurfaceMotion motion = s.motion;
      motion.g += (k == 0 ? -step : step) * direction.g;
      motion.w_journal += (k == 0 ? -step : step) * direction.w_journal;
      moved.at(k) = u;
      REQUIRE(solve_film(reynolds, motion, {}, {.rtol = 1e-12}, moved.at(k)).solved());
    }
    const Eigen::VectorXd difference = (moved[1] - moved[0]) / (2 * step);
    CHECK((du - difference).norm() < 1e-5 * difference.norm());  // round-off of the difference
  }
}

}  // namespace layer_test
}  // namespace hersey::film
