#pragma once

#include <doctest/doctest.h>

#include <functional>

#include "film_cases.h"
#include "hersey/film/film_heat.h"

namespace hersey::film {

/// A plane slider: a part of the circumference between two grooves that prescribe the ends' pressures on the rest,
/// closed edges, so that nothing varies along the axis.
struct Slider {
  double length = 0, U = 0, mu = 0;    ///< [m, m/s, Pa s]
  double end_pressure = 0;             ///< at both ends [Pa]
  std::function<double(double)> gap;   ///< [m] at x in [0, length]
  double from = 0, to = 0, depth = 0;  ///< a stationary pocket of the slider [m]
  ShearThinning thinning = {};
  int layers = 1;  ///< in which it thins; 1: by the film's sliding
  Turbulence turbulence = {};
};

struct SolvedSlider {
  int n = 0;            ///< cells on the slider
  double dx = 0;        ///< [m]
  double load = 0;      ///< of the pressure above that at the ends [N/m]
  double flow = 0;      ///< [m^2/s]
  double friction = 0;  ///< between the ends, on the stationary surface [N/m]
  Eigen::VectorXd p, theta;
  SolvedFilm film;
};

inline constexpr int groove_cells = 4;

/// Iterates film and viscosities of layers that thin by their own shear.
inline SolvedFilm solve_in_layers(const FilmModel& model, const SurfaceMotion& motion, int layers) {
  Reynolds reynolds(model);
  FilmHeat heat(model, {.layers = layers, .journal = InsulatedWall{}});
  SolvedFilm film;
  film.u = Eigen::VectorXd::Zero(model.grid.size());
  FilmHistory history;
  for (int k = 0; k < 60; ++k) {
    history.viscosity = heat.viscosity();
    film.summary = solve_film(reynolds, motion, history, {}, film.u);
    REQUIRE(film.summary.solved());
    const Eigen::VectorXd before = heat.state().thinning;
    heat.advance(motion, history, film.u);
    if ((heat.state().thinning - before).cwiseAbs().maxCoeff() < 1e-12) break;  // round-off of the film's solution
  }
  film.fields = film_fields(model, motion, film.u);
  film.observed = observe_film(model, motion, history, {0, 0}, film.u, Eigen::Vector2d::Zero());
  return film;
}

// Node k lies at x = k dx; beyond the slider's end lie both grooves, first the outlet's, then the inlet's.
inline SolvedSlider solve(const Slider& slider, int n) {
  SolvedSlider s{.n = n, .dx = slider.length / n};
  const int all = n + 2 * groove_cells;
  FilmModel m{.R = all * s.dx / (2 * pi), .L = 0.01, .c = slider.gap(slider.length), .grid = {all, 3}};
  m.lubricant.mu0 = slider.mu;
  m.lubricant.temperature_law = FixedViscosity{slider.mu};
  m.lubricant.shear_thinning = slider.thinning;
  m.turbulence = slider.turbulence;
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
  double beside = 0;  // Couette friction in the grooves
  for (int k = 0; k < all; ++k) {
    // The slider's own gap extends into the grooves as far as it affects the ends; between the grooves it is even.
    const int x = k <= n + 2 ? k : k == all - 1 ? -1 : n + 3;
    const double g = x <= n + 2 ? slider.gap(x * s.dx) : between;
    motion.g.segment(m.grid.index(k, 0), 3).setConstant(g);
    const double rate = slider.U / g, fraction = k == 0 || k == n ? 0.5 : k > n ? 1 : 0;
    const double left = slider.thinning.is_newtonian() ? 1 : slider.thinning.ratio(rate, slider.mu).value;
    beside += fraction * s.dx * slider.mu * left * rate;
  }
  s.film = slider.layers == 1 ? solve_cold(m, motion, {0, 0}) : solve_in_layers(m, motion, slider.layers);
  REQUIRE(s.film.summary.solved());
  CHECK(s.film.observed.mass_balance_error < 1e-10 * m.grid.size());  // the solver's tolerance, per node
  s.p.resize(n + 1), s.theta.resize(n + 1);
  for (int k = 0; k <= n; ++k) {
    s.p[k] = s.film.fields.p[m.grid.index(k, 1)] - slider.end_pressure;
    s.theta[k] = s.film.fields.theta[m.grid.index(k, 1)];
  }
  s.load = s.p.sum() * s.dx;  // trapezoidal rule: both ends are zero
  // Flow that the inlet feeds, plus the flow that the surface carries into it from the other groove.
  s.flow = s.film.observed.flow_features[0] / m.L + 0.5 * slider.U * between;
  s.friction = s.film.observed.torque_shell / (m.R * m.L) - beside;
  return s;
}

}  // namespace hersey::film
