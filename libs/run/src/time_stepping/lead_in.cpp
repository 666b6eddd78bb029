#include "time_stepping/lead_in.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <numbers>
#include <stdexcept>
#include <variant>

#include "hersey/core/error_text.h"
#include "hersey/film/grid_transfer.h"
#include "time_stepping/machine_run.h"

namespace hersey::run {
namespace {

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

model::Model on_half_grids(model::Model model) {
  for (model::Bearing& bearing : model.bearings) halve_grid(bearing);
  model.simulation.cycle->lead_in = model::LeadIn::none;
  model.output.meshes_at.clear();  // files besides the results
  model.output.fields_every = model.simulation.duration;
  return model;
}

// Drives and functions of angles begin again at the start of the run. Revolutions are taken back each by itself, since
// they do not commute.
void unwind(const mbd::Mechanism& mechanism, const Eigen::VectorXd& travelled, Eigen::VectorXd& q) {
  const Eigen::VectorXd scales = mechanism.position_scales();
  for (Eigen::Index row = 0; row < travelled.size(); ++row) {
    const double revolutions = std::round(travelled[row] / (2 * std::numbers::pi));
    if (scales[row] != 1 || revolutions == 0) continue;
    Eigen::VectorXd back = Eigen::VectorXd::Zero(travelled.size()), unwound;
    back[row] = -2 * std::numbers::pi * revolutions;
    mechanism.retract(q, back, unwound);
    q = unwound;
  }
}

PeriodicStart run_cycles(const model::Model& model, const Options& options) {
  const model::Model coarse = on_half_grids(model);
  Options quiet;
  quiet.stop = options.stop;
  if (options.on_cycle)
    quiet.on_cycle = [&options](CycleProgress cycle) {
      cycle.leads_in = true;
      options.on_cycle(cycle);
    };
  MachineRun run(coarse, quiet);
  run.begin();
  Eigen::VectorXd travelled = Eigen::VectorXd::Zero(run.mechanism().nv());  // integral of the velocities
  while (!run.is_at_end()) {
    if (quiet.stop != nullptr && quiet.stop->load()) return {.message = "the lead-in was stopped"};
    if (const Outcome step = run.step(); !step.solved()) throw std::runtime_error(step.message);
    travelled += run.last_dt() * run.state().v;
  }
  PeriodicStart start{.cycles = run.summary().cycles, .state = run.state()};
  start.message = fmt::format("begun after {} cycles on half grids", start.cycles);
  unwind(run.mechanism(), travelled, start.state.q);
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
  try {
    return run_cycles(model, options);
  } catch (const std::exception& error) {
    return {.message = "the lead-in was given up: " + error_text(error)};
  }
}

}  // namespace hersey::run
