#include "steady/steady_heat.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>
#include <variant>

#include "gap/clearance_growth.h"
#include "gap/hot_clearance.h"
#include "gap/oil_temperatures.h"
#include "hersey/film/grid_transfer.h"
#include "hersey/film/thermal_network.h"
#include "steady/steady_search.h"
#include "steady/temperature_path.h"

// Film and temperature are solved alternately (thermal.16).
namespace hersey::bearing {
namespace {

// Iterations of film and temperature, and the change of temperatures over the largest rise (plus 1 K) at which they
// end.
constexpr int kMostHeatIterations = 300;
constexpr double kHeatTolerance = 1e-8;

// Temperatures that still change by more than this fraction of their rise after so many iterations, and have at each of
// them, go round for ever: where oil stands in a cell, its heat, and with that its viscosity, may be anything.
constexpr int kTurnsToComeNear = 80;
constexpr double kFarApart = 0.5;

// Where more heat passes through the film than is made in it, the balance asks for more: for this error of it, if so
// many further iterations come to it.
constexpr double kBalanceTolerance = 5e-8;
constexpr int kTurnsForTheBalance = 40;

// Of iterations that lead away from temperatures as near as this, those are taken: waves of temperature along a long
// film change its answer by so little that the last of them are lost in what the film's solver leaves.
constexpr double kLastTolerance = 1e-6;

// On half the grid they come as near as its films are to those on the whole one.
constexpr double kHalfGridTolerance = 0.1;

// The film is solved to this fraction of how far its temperatures still move.
constexpr double kFractionOfDistance = 0.1;

// An iteration leaves at least this fraction of the clearance between bodies: films that close too far on the way make
// heat that no answer has.
constexpr double kLeastLeft = 0.4;

// No film is solved less well than this: none at all would do.
constexpr double kCoarsest = 1e-3;

// Bodies of a network in balance with the film's heat, and the film with their temperatures (thermal.48).
void balance(film::ThermalNetwork& network, film::FilmHeat& heat) {
  const film::FilmTerminals at = film::terminals_of(heat.thermal());
  network.advance(0, {{at, heat.heat_flow()}});
  heat.move_walls(network.walls(at, heat.heat_flow().T));
}

double celsius(double T) { return T - film::zero_celsius; }

// Where the hottest oil is.
std::string hottest_of(const film::HeatObservables& observed) {
  return fmt::format("{:.0f} degC at {:.0f} deg, z = {:.3g} mm", celsius(observed.T_max),
                     observed.T_max_phi * 180 / std::numbers::pi, 1e3 * observed.T_max_z);
}

// Reports a film that is lost as its oil warms and thins, or heat that leaves only at temperatures that no oil has.
void tell_runaway(const film::HeatObservables& observed, bool has_lost_film, SteadySummary& summary) {
  if (has_lost_film) {
    summary.message = fmt::format("thermal runaway: oil that warms to {} is too thin for the film to stay; {}",
                                  hottest_of(observed), summary.message);
  } else if (observed.T_max > hottest_oil) {
    summary.set_solved(false);
    summary.message = fmt::format(
        "thermal runaway: the film's heat leaves it with oil of {} only, and no oil is one above {:.0f} degC",
        hottest_of(observed), celsius(hottest_oil));
  }
}

// Of the film in the next iteration: all that was asked for where that may be the last, as an iteration brings
// temperatures nearer by a factor of ten or so.
double film_tolerance(const SteadyOptions& options, double relative_distance) {
  const double near = kFractionOfDistance * relative_distance;
  return near <= 10 * kHeatTolerance ? options.rtol : std::max(options.rtol, std::min(kCoarsest, near));
}

// Solves film and temperature alternately until temperatures, and the clearance at those of the walls, no longer
// change.
// @param network  of walls that are nodes; null: none is
SteadySummary iterate_film_and_heat(const film::FilmModel& model, const SteadyOptions& options,
                                    double relative_distance, SteadySearch& search, TemperaturePath& path,
                                    film::ThermalNetwork* network) {
  SteadySummary summary;
  double clearance_before = 0;
  int turns_near = 0;
  bool is_last = false;
  for (int k = 0; k < kMostHeatIterations && (k < kTurnsToComeNear || path.nearest() <= kFarApart); ++k) {
    ShapesAtRest shapes{path.heat().shell_opening(), film::around(model.grid, path.heat().journal_growth())};
    const HotClearance hot = hot_clearance(model, path.growth(), shapes.thermal_shell, shapes.thermal_journal);
    const bool is_open = hot.smallest > seized * clearance(model);
    if (is_open && hot.has_shape && hot.smallest < kLeastLeft * clearance_before && path.step_back()) continue;
    summary.set_solved(false);
    if (is_open) {
      search.set_growth(path.growth());
      search.set_tolerance(film_tolerance(options, path.relative_distance()));
      search.set_viscosity(path.heat().viscosity());
      search.set_shapes(std::move(shapes));
      summary = search.has_film() ? search.retry() : search.solve();
    }
    summary.heat_iterations = k + 1;
    if (!summary.solved()) {
      if (path.step_back()) continue;
      if (!is_open)
        summary.message = seizure_text(model, hot, path.heat().observables());
      else if (path.has_film())
        tell_runaway(path.heat().observables(), true, summary);
      return summary;
    }
    clearance_before = hot.smallest;
    search.heat(path.heat());
    if (network != nullptr) balance(*network, path.heat());
    path.take();
    const bool is_only_begun = relative_distance > kHeatTolerance;
    const bool is_near = path.relative_distance() <= (is_last ? kLastTolerance : relative_distance);
    if (is_near) ++turns_near;
    const bool is_balanced =
        path.heat().observables().balance.error() <= kBalanceTolerance || turns_near > kTurnsForTheBalance;
    if (is_near && (is_only_begun || (is_balanced && search.accept_if_converged()))) {
      tell_runaway(path.heat().observables(), false, summary);
      return summary;
    }
    if (is_last) break;
    is_last = path.leads_away() && path.nearest() <= kLastTolerance;
    if (is_last) {
      path.return_to_nearest();
    } else {
      path.step_on(k);
    }
  }
  summary.set_solved(false);
  summary.message = fmt::format("film and temperature do not converge in {} iterations; hottest oil {}",
                                summary.heat_iterations, hottest_of(path.heat().observables()));
  tell_runaway(path.heat().observables(), false, summary);
  return summary;
}

// From the same film on half the nodes each way, where an iteration costs a quarter. Without an answer there, all
// stays.
void begin_on_half_grid(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options,
                        SteadySearch& search, TemperaturePath& path) {
  if (options.start_heat || options.elasticity || !film::can_be_coarsened(model.grid)) return;
  // Walls that move with their heat find their way with the film of the grid itself.
  if (film::terminals_of(*options.thermal).has_any() || options.thermal->expansion ||
      std::holds_alternative<film::BodyWall>(options.thermal->shell) ||
      std::holds_alternative<film::BodyJournal>(options.thermal->journal))
    return;
  film::FilmModel half = model;
  half.grid = film::half_of(model.grid);
  SteadyOptions on_half = options;
  film::ThermalModel& thermal = *on_half.thermal;
  if (auto* wall = std::get_if<film::WallAtTemperature>(&thermal.shell); wall != nullptr && wall->around.size() > 0)
    wall->around = film::GridTransfer(model.grid, half.grid).around(wall->around);
  SteadySearch search_there(half, point, on_half);
  TemperaturePath path_there(half, thermal, point, std::nullopt);
  if (!iterate_film_and_heat(half, on_half, kHalfGridTolerance, search_there, path_there, nullptr).solved()) return;
  const film::GridTransfer transfer(half.grid, model.grid);
  const double fill = film::fill_scale(model) / film::fill_scale(half);
  search.begin_at(search_there.position(),
                  transfer(search_there.film().unaryExpr([fill](double u) { return u < 0 ? fill * u : u; })));
  path.begin_at(path_there, transfer);
}

}  // namespace

SteadySummary solve_with_heat(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options,
                              SteadyState& state) {
  SteadySearch search(model, point, options);
  TemperaturePath path(model, *options.thermal, point, options.start_heat);
  std::optional<film::ThermalNetwork> network;
  if (options.network && film::terminals_of(*options.thermal).has_any()) network.emplace(*options.network);
  begin_on_half_grid(model, point, options, search, path);
  const SteadySummary summary =
      iterate_film_and_heat(model, options, kHeatTolerance, search, path, network ? &*network : nullptr);
  if (!summary.solved()) return summary;
  state = search.state();
  state.heat = SteadyHeat{path.heat().state(),
                          path.heat().observables(),
                          path.heat().fields(),
                          path.heat().body_temperatures(),
                          path.heat().journal_body_temperatures(),
                          {}};
  if (network) state.heat->network = network->observables();
  return summary;
}

}  // namespace hersey::bearing
