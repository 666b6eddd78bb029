#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gap/oil_temperatures.h"
#include "hersey/bearing/global_heat.h"
#include "hersey/bearing/steady_bearing.h"
#include "hersey/solver/fixed_point_iteration.h"
#include "steady/temperature_path.h"

namespace hersey::bearing {
namespace {

constexpr int most_iterations = 40;
constexpr double tolerance = 1e-8;

// Steps half-way back to the last temperature at which the film carried, until it is said to have run away.
constexpr int most_steps_back = 8;

/// The balance of heat of a bearing solved (thermal.20).
EffectiveTemperature balance(const film::Lubricant& oil, const GlobalHeat& heat, const film::FilmObservables& film) {
  const double power = film.power_film + film.power_asperity;
  if (heat.cools_by_surroundings) {
    const double T = heat.T_ambient + power / (heat.transfer * heat.area);
    return {T, T};
  }
  const double rise = power / (oil.density * oil.specific_heat * film.flow_sides());
  return {heat.T_supply + 0.5 * rise, heat.T_supply + rise};
}

/// Describes walls that leave no clearance with oil of temperature T.
SteadySummary seizure(const film::FilmModel& model, const OperatingPoint& at, double T) {
  SteadySummary summary;
  summary.message = fmt::format("a seizure: the clearance of {:.4g} um closes to {:.4g} um with oil of {:.0f} degC",
                                1e6 * clearance(model), 1e6 * clearance(model, at), T - film::zero_celsius);
  return summary;
}

/// Of a film that cold oil has kept and oil of temperature T does not.
SteadySummary runaway(SteadySummary summary, double T) {
  summary.message = fmt::format("thermal runaway: oil that warms to {:.0f} degC is too thin for the film to stay; {}",
                                T - film::zero_celsius, summary.message);
  return summary;
}

/// An answer, unless oil of temperature T is none.
SteadySummary checked(SteadySummary summary, double T) {
  if (T <= hottest_oil) return summary;
  summary.set_solved(false);
  summary.message = fmt::format(
      "thermal runaway: the balance of heat does not close with oil below {:.0f} degC, and no oil is one above {:.0f} "
      "degC",
      T - film::zero_celsius, hottest_oil - film::zero_celsius);
  return summary;
}

}  // namespace

SteadySummary solve_global(film::FilmModel& model, const OperatingPoint& point, const GlobalHeat& heat,
                           const SteadyOptions& options, SteadyState& state) {
  const double from = heat.cools_by_surroundings ? heat.T_ambient : heat.T_supply;
  solver::FixedPointIteration mixing(solver::Acceleration::quasi_newton, 0.5);
  SteadyOptions next = options;
  SteadySummary summary;
  double rise = 0, carried = 0;
  int linearisations = 0, steps_back = 0;
  for (int k = 1; k <= most_iterations; ++k) {
    model.lubricant = film::at_temperature(model.lubricant, from + rise);
    const OperatingPoint at =
        heat.expansion ? with_growth(point, model, heat.expansion->growth(model.R, from + rise)) : point;
    if (clearance(model, at) <= seized * clearance(model) || initial_gap(model, at, options) <= 0)
      return seizure(model, at, from + rise);
    summary = solve_steady(model, at, next, state);
    linearisations += summary.iterations;
    summary.iterations = linearisations, summary.heat_iterations = k;
    if (!summary.solved()) {
      if (k == 1) return summary;
      if (++steps_back > most_steps_back) return runaway(summary, from + rise);
      rise = 0.5 * (rise + carried);
      mixing.begin_step();
      continue;
    }
    carried = rise;
    if (!heat.cools_by_surroundings && !(state.film.flow_sides() > 0)) {
      summary.set_solved(false);
      summary.message = "no oil leaves over the edges to take the heat along: give `cooling` by the surroundings";
      return summary;
    }
    state.effective = balance(model.lubricant, heat, state.film);
    const double found = state.effective->T - from;
    if (std::abs(found - rise) <= tolerance * (1 + std::abs(found))) return checked(summary, state.effective->T_out);
    next.start = state.e, next.start_film = state.u, next.start_deformation = state.s;
    const Eigen::VectorXd x = Eigen::VectorXd::Constant(1, rise), image = Eigen::VectorXd::Constant(1, found);
    rise = std::clamp(mixing.next(x, image)[0], coldest_trial - from, hottest_trial - from);
  }
  summary.set_solved(false);
  summary.message = fmt::format("the balance of heat finds no temperature in {} iterations; last {:.0f} degC",
                                most_iterations, from + rise - film::zero_celsius);
  return from + rise > hottest_oil ? checked(summary, from + rise) : summary;
}

}  // namespace hersey::bearing
