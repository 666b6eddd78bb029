#include "time_stepping/lead_in.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <variant>

#include "hersey/core/error_text.h"
#include "hersey/film/grid_transfer.h"
#include "time_stepping/floquet.h"
#include "time_stepping/machine_run.h"
#include "time_stepping/shooting.h"

namespace hersey::run {
namespace {

constexpr double kLongestStep = 1.5;  // of a divided period, so that no planned instant comes between
constexpr int kMostToSection = 60;    // periods
constexpr double kOfFigures = 0.1;    // tolerance of a motion over that of its figures, which are not compared

// Films with fewer lines or rows keep their grid: half of it has no film to speak of.
constexpr int kFewestHalvedLines = 24, kFewestHalvedRows = 5;

// The film on half as many lines and rows; temperatures given around its shell are taken at these lines.
void halve_grid(model::Bearing& bearing) {
  const film::Grid fine = bearing.film.grid;
  if (fine.n_phi < kFewestHalvedLines || fine.n_z < kFewestHalvedRows) return;
  bearing.film.grid = film::halved(fine);
  auto* heat = std::get_if<film::ThermalModel>(&bearing.heat);
  if (heat == nullptr) return;
  auto* wall = std::get_if<film::WallAtTemperature>(&heat->shell);
  if (wall == nullptr || wall->around.size() == 0) return;
  wall->around = film::GridTransfer::by_position(fine, bearing.film.grid).around(wall->around);
}

// The model whose cycles are tried: all of them are run, and none ends the run.
model::Model for_trials(model::Model model, bool is_coarse) {
  if (is_coarse)
    for (model::Bearing& bearing : model.bearings) halve_grid(bearing);
  model::Cycle& cycle = *model.simulation.cycle;
  cycle.lead_in = model::LeadIn::none;
  cycle.tolerance = 0;
  const int most = cycle.most + (cycle.is_period_found ? kMostToSection : 0) +
                   (cycle.multipliers > 0 ? most_periods_for_multipliers(cycle.multipliers) : 0);
  model.simulation.duration = most * cycle.period;
  model.output.meshes_at.clear();  // files besides the results
  model.output.fields_every = model.simulation.duration;
  if (cycle.is_period_found) model.simulation.step *= kLongestStep;
  return model;
}

// Wear and what a controller has stored are no parts of a motion that repeats.
bool can_be_combined(const model::Model& model) {
  return std::none_of(model.bearings.begin(), model.bearings.end(),
                      [](const model::Bearing& bearing) { return bearing.wear.has_value(); }) &&
         std::none_of(model.forces.begin(), model.forces.end(), [](const model::Force& force) {
           return std::holds_alternative<model::SpeedControl>(force.data);
         });
}

void find_multipliers(PeriodMap& map, const Shooting& found, int count, PeriodicStart& start) {
  const FloquetMultipliers multipliers = floquet_multipliers(map, found, count);
  start.multipliers = multipliers.values;
  start.cycles += multipliers.periods;
  if (!multipliers.solved()) {
    start.message += "; no multipliers: " + multipliers.message;
    return;
  }
  const double largest = std::abs(multipliers.values.front());
  start.message += fmt::format(" and {} for {} of its multipliers, the largest {:.4g}{}", multipliers.periods,
                               multipliers.values.size(), largest,
                               largest > 1 ? ": the motion is unstable, and small deviations grow" : "");
}

PeriodicStart run_cycles(const model::Model& model, const Options& options) {
  const bool is_coarse = model.simulation.cycle->lead_in == model::LeadIn::half_grids;
  const model::Model trial = for_trials(model, is_coarse);
  const model::Cycle& cycle = *model.simulation.cycle;
  double change = std::numeric_limits<double>::quiet_NaN();
  Options quiet;
  quiet.on_cycle = [&options, &change, &cycle](CycleProgress progress) {
    change = progress.change;
    progress.leads_in = true;
    // Where the period is to be found, cycles of the run are those of its first guess.
    if (options.on_cycle && !cycle.is_period_found) options.on_cycle(progress);
  };
  int periods = 0;
  const auto end_period = [&](double misfit) {
    ++periods;
    if (options.on_cycle && cycle.is_period_found)
      options.on_cycle({.number = periods, .change = misfit, .largest = "motion over its swing", .leads_in = true});
  };
  MachineRun run(trial, quiet);
  run.begin();
  const Eigen::VectorXd q_start = run.state().q;
  PeriodMap map(run, cycle.period, options.stop);
  if (cycle.is_period_found) {
    map.divide(static_cast<int>(std::lround(cycle.period / model.simulation.step)));
    if (const Outcome section =
            map.lay_section(kMostToSection, [&] { end_period(std::numeric_limits<double>::quiet_NaN()); });
        !section.solved())
      throw std::runtime_error(section.message);
  }
  const Shooting found = shoot(map, {.tolerance = (cycle.is_period_found ? kOfFigures : 1) * cycle.tolerance,
                                     .most = cycle.most,
                                     .predicts = can_be_combined(model),
                                     .repeats = [&] { return change <= cycle.tolerance || cycle.is_period_found; },
                                     .on_period = end_period});
  // Cycles that have not repeated yet are nearer to those that do than the start of the model.
  if (!found.solved() && (!is_coarse || found.periods < cycle.most)) {
    const bool may_go_on = found.periods == cycle.most;
    throw std::runtime_error(
        found.message + (may_go_on ? "; a larger `cycle.most` goes on, and a start nearer to it needs fewer" : ""));
  }
  PeriodicStart start{.cycles = periods};
  start.message = fmt::format("begun after {} cycles {}{}", start.cycles, is_coarse ? "on half grids" : "of shooting",
                              found.solved() ? "" : ", which have not repeated");
  if (cycle.is_period_found) {
    if (map.swing().is_rest()) throw std::runtime_error("the machine comes to rest: it does not oscillate");
    start.period = map.period();
    start.message += fmt::format(" with the period {:.6g} s", start.period);
  }
  if (cycle.multipliers > 0) find_multipliers(map, found, cycle.multipliers, start);
  run.move_to(found.motion);
  start.state = run.state();
  // Drives and functions of angles begin again at the start of the run.
  const Eigen::VectorXd way = run.mechanism().difference(q_start, run.state().q, found.motion.swinging);
  run.mechanism().retract(q_start, way, start.state.q);
  if (cycle.is_period_found)
    start.state.q =
        with_rings_at(run.mechanism(), q_start, map.swing().sizes(), {start.state.q, {}, found.motion.swinging}).q;
  if (!is_coarse) {
    start.motion = run.motion();
    start.motion->q = start.state.q;
    start.motion->swinging = found.motion.swinging;
    return start;
  }
  for (std::size_t i = 0; i < model.bearings.size(); ++i)
    start.films.push_back(run.machine().bearings[i].bearing->on_grid(model.bearings[i].film.grid));
  if (run.machine().network) {
    Archive network;
    run.machine().network->persist(network);
    start.network = network.content();
  }
  return start;
}

}  // namespace

PeriodicStart lead_in(const model::Model& model, const Options& options) {
  const auto& cycle = model.simulation.cycle;
  if (!cycle || cycle->lead_in == model::LeadIn::none) return {};
  PeriodicStart start;
  try {
    start = run_cycles(model, options);
  } catch (const std::exception& error) {
    start.message = "the lead-in was given up: " + error_text(error);
  }
  start.was_stopped = options.stop != nullptr && options.stop->load();
  return start;
}

}  // namespace hersey::run
