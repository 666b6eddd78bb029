#pragma once

#include <Eigen/Dense>

#include "film_cases.h"
#include "hersey/film/film_heat.h"
#include "hersey/solver/fixed_point_iteration.h"

namespace hersey::film {

/// The oil of all reference cases: mu = 0.0277 exp(-0.034 (T - 40 degC)) Pa s.
inline Lubricant thinning_oil() {
  Lubricant oil{.mu0 = 0.0277, .density = 860};
  oil.temperature_law = ExponentialViscosity{.mu_ref = 0.0277, .T_ref = 40 + zero_celsius, .beta = 0.034};
  oil.specific_heat = 2000, oil.conductivity = 0.13;
  return oil;
}

/// Oil at 40 degC, from supplies and edges.
inline ThermalModel supplied_at_40(int layers) {
  return {.layers = layers, .T_supply = 40 + zero_celsius, .T_edges = 40 + zero_celsius};
}

/// A steady film that agrees with its temperature.
struct HotFilm {
  int iterations = 0;
  double change = 0;  ///< of temperature in the last iteration [K]
  HeatState state;
  HeatObservables heat;
  TemperatureFields temperatures;
  FilmObservables film;
  FilmFields fields;
};

/// Iterates film and heat until temperatures change by less than `tolerance` [K].
inline HotFilm solve_hot(const FilmModel& model, const ThermalModel& thermal, const SurfaceMotion& motion,
                         const Eigen::Vector2d& e, double tolerance = 1e-7) {
  Reynolds reynolds(model);
  FilmHeat heat(model, thermal);
  solver::FixedPointIteration mixing(solver::Acceleration::quasi_newton, 1);
  mixing.begin_step();
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.grid.size());
  HotFilm hot;
  FilmHistory history;
  for (hot.iterations = 1; hot.iterations <= 100; ++hot.iterations) {
    history.viscosity = heat.viscosity();
    const FilmSolveSummary solved = solve_film(reynolds, motion, history, {}, u);
    if (!solved.solved()) throw std::runtime_error(solved.message);
    const HeatState before = heat.state();
    heat.advance(motion, history, u);
    const Eigen::VectorXd x = before.film.array() - thermal.T_supply,
                          image = heat.state().film.array() - thermal.T_supply;
    hot.change = (image - x).cwiseAbs().maxCoeff();
    if (hot.change < tolerance) break;
    HeatState next = heat.state();
    if (hot.iterations == 1) {
      next = first_guess(model, thermal, thermal.T_supply, next);
    } else {
      next.film = mixing.next(x, image).array() + thermal.T_supply;
    }
    heat.set_state(next);
  }
  hot.state = heat.state();
  hot.heat = heat.observables();
  hot.temperatures = heat.fields();
  hot.film = observe_film(model, motion, history, e, u);
  hot.fields = film_fields(model, motion, u);
  return hot;
}

}  // namespace hersey::film
