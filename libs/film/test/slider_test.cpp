#include <doctest/doctest.h>

#include <array>
#include <functional>

#include "film_cases.h"
#include "relative.h"

// Plane sliders: a stretch of the circumference between two grooves that hold the rest of it at the ends' pressures,
// closed edges, so that nothing varies along the axis.
namespace hersey::film {
namespace slider_test {

struct Slider {
  double length = 0, U = 0, mu = 0;    ///< [m, m/s, Pa s]
  double end_pressure = 0;             ///< at both ends [Pa]
  std::function<double(double)> gap;   ///< [m] at x in [0, length]
  double from = 0, to = 0, depth = 0;  ///< a pocket of the slider that stands still [m]
};

struct SolvedSlider {
  int n = 0;        ///< cells on the slider
  double dx = 0;    ///< [m]
  double load = 0;  ///< of the pressure above that at the ends [N/m]
  double flow = 0;  ///< [m^2/s]
  Eigen::VectorXd p, theta;
  SolvedFilm film;
};

constexpr int groove_cells = 4;

// Node k lies at x = k dx; beyond the slider's end lie both grooves, first the outlet's, then the inlet's.
SolvedSlider solve(const Slider& slider, int n) {
  SolvedSlider s{.n = n, .dx = slider.length / n};
  const int all = n + 2 * groove_cells;
  FilmModel m{.R = all * s.dx / (2 * pi), .L = 0.01, .c = slider.gap(slider.length), .grid = {all, 3}};
  m.lubricant.mu0 = slider.mu;
  m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
  const double cell = 2 * pi / all, arc = groove_cells * cell, inlet = arc - 0.5 * cell;
  m.features = {{.name = "inlet", .phi = -0.5 * inlet, .arc = inlet, .length = m.L, .pressure = slider.end_pressure},
                {.name = "outlet", .phi = n * cell + 0.5 * arc, .arc = arc, .length = m.L}};
  m.features[1].pressure = slider.end_pressure;
  if (slider.depth > 0) {
    m.features.push_back({.name = "pocket",
                          .phi = 0.5 * (slider.from + slider.to) / m.R,
                          .arc = (slider.to - slider.from) / m.R,
                          .length = m.L,
                          .is_fed = false,
                          .depth = slider.depth});
  }
  SurfaceMotion motion = surfaces(m, {});
  motion.u_journal = slider.U;
  const double between = slider.gap(slider.length);
  for (int k = 0; k < all; ++k) {
    // The slider's own gap goes on into the grooves for as far as its ends see it; between the grooves it is even.
    const int x = k <= n + 2 ? k : k == all - 1 ? -1 : n + 3;
    const double g = x <= n + 2 ? slider.gap(x * s.dx) : between;
    motion.g.segment(m.grid.index(k, 0), 3).setConstant(g);
  }
  s.film = solve_cold(m, motion, {0, 0});
  REQUIRE(s.film.summary.converged);
  CHECK(s.film.observed.mass_balance_error < 1e-9);  // the solver's tolerance is 1e-10 per node
  s.p.resize(n + 1), s.theta.resize(n + 1);
  for (int k = 0; k <= n; ++k) {
    s.p[k] = s.film.fields.p[m.grid.index(k, 1)] - slider.end_pressure;
    s.theta[k] = s.film.fields.theta[m.grid.index(k, 1)];
  }
  s.load = s.p.sum() * s.dx;  // trapezoidal rule: both ends are zero
  // What the inlet feeds, and what the surface carries into it from the other groove.
  s.flow = s.film.observed.flow_features[0] / m.L + 0.5 * slider.U * between;
  return s;
}

double order(double coarse, double fine, double refinement = 2) {
  return std::log(std::abs(coarse / fine)) / std::log(refinement);
}

// Reynolds' slider at its optimum inclination, Lamb's closed form.
TEST_CASE("LongSlider_MeetsTheClosedFormWithOrderTwo") {
  const double K = 1.18870, exact = (std::log1p(K) - 2 * K / (2 + K)) / (K * K);
  CHECK(exact == relative(0.0267072).epsilon(2e-6));
  const Slider slider{0.05, 3, 0.02, 0, [&](double x) { return 2e-5 * (1 + K * (1 - x / 0.05)); }};
  const double unit = 6 * slider.mu * slider.U * std::pow(slider.length / 2e-5, 2);
  std::array<double, 2> error{};
  for (int k = 0; k < 2; ++k) error[k] = solve(slider, k == 0 ? 50 : 100).load / unit / exact - 1;
  CHECK(std::abs(error[1]) < 2e-4);
  CHECK(order(error[0], error[1]) == doctest::Approx(2).epsilon(0.02));
}

// Rayleigh's step at its optimum. A jump of the gap between two nodes is seen as a ramp over that cell.
TEST_CASE("RayleighStep_MeetsTheClosedForm") {
  const double inlet = 0.71823, ratio = 1 + 0.5 * std::sqrt(3);
  const auto gap = [](double) { return 2e-5; };
  const Slider slider{0.05, 3, 0.02, 0, gap, 0, inlet * 0.05, 2e-5 * (ratio - 1)};
  const double unit = 6 * slider.mu * slider.U * std::pow(slider.length / 2e-5, 2);
  for (const int n : {100, 103, 400, 1600}) {
    CAPTURE(n);
    const SolvedSlider s = solve(slider, n);
    CHECK(std::abs(s.load / unit / 0.0343779 - 1) < 0.01 / n + 2e-6);  // the reference has six digits
  }
}

// Parabolic slider between ends at the cavitation pressure (reference: exact solution of the mass-conserving problem).
TEST_CASE("ParabolicSlider_MeetsTheExactSolutionWithOrderTwo") {
  const double length = 0.0762;
  const Slider slider{length, 4.57, 0.039, 0,
                      [&](double x) { return 25.4e-6 * (1 + std::pow(2 * x / length - 1, 2)); }};
  std::array<double, 2> load_error{}, peak_error{};
  for (int k = 0; k < 2; ++k) {
    const SolvedSlider s = solve(slider, k == 0 ? 190 : 380);
    load_error[k] = s.load / 101349.50 - 1;
    peak_error[k] = s.film.observed.p_max / 3.591787e6 - 1;
    int last = 0;
    for (int i = 0; i <= s.n; ++i) {
      if (s.p[i] > 0) last = i;
    }
    CHECK(std::abs((last + 0.5) * s.dx - 0.05173480) < s.dx);
  }
  CHECK(std::abs(load_error[1]) < 2e-4);
  CHECK(std::abs(peak_error[1]) < 2e-4);
  CHECK(order(load_error[0], load_error[1]) == doctest::Approx(2).epsilon(0.05));
  CHECK(order(peak_error[0], peak_error[1]) == doctest::Approx(2).epsilon(0.05));
}

struct PocketErrors {
  double flow = 0, front = 0, peak = 0;  // of the flow, reformation [cells] and peak pressure
};

// A slider with a pocket (Fowell et al. 2007; Giacopini et al. 2010): the film breaks at the pocket's leading edge and
// re-forms within it.
PocketErrors pocket(int n) {
  const auto gap = [](double x) { return 1.05e-6 - 5e-6 * x; };
  const SolvedSlider s = solve({10e-3, 1, 0.01, 1e5, gap, 2e-3, 5e-3, 1e-6}, n);
  int last = 0, first = n;
  for (int k = 0; k <= n; ++k) {
    if (s.theta[k] < 1 - 1e-9) last = k, first = std::min(first, k);  // full but for round-off
  }
  CHECK(std::abs(first * s.dx - 2e-3) <= s.dx);
  // The front's own node is partly full: the share by which it is fuller than the one before tells where in the cell
  // the film begins.
  const double before = s.theta[last - 1], share = (s.theta[last] - before) / (1 - before);
  return {s.flow / 5.229635e-7 - 1, ((last + 1 - share) * s.dx - 3.611263e-3) / s.dx,
          (s.film.fields.p.maxCoeff()) / 9.808819e6 - 1};
}

TEST_CASE("PocketSlider_RupturesAndReforms") {
  // Both steps on nodes: as exact as the reference's digits.
  for (const int n : {100, 200}) {
    CAPTURE(n);
    const PocketErrors e = pocket(n);
    CHECK(std::abs(e.flow) < 2e-7);
    CHECK(std::abs(e.front) < 0.5);
    CHECK(std::abs(e.peak) < 4e-7);
  }
  // Steps between nodes, at the same place in their cells on both grids: order one.
  const PocketErrors coarse = pocket(101), fine = pocket(1111);
  CHECK(std::abs(coarse.flow) < 5e-4);
  CHECK(std::abs(coarse.front) < 1);
  CHECK(std::abs(fine.front) < 1);
  CHECK(order(coarse.flow, fine.flow, 11) == doctest::Approx(1).epsilon(0.05));
  CHECK(order(coarse.peak, fine.peak, 11) == doctest::Approx(1).epsilon(0.1));
}

}  // namespace slider_test
}  // namespace hersey::film
