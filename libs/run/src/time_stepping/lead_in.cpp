#include "time_stepping/lead_in.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "hersey/core/error_text.h"
#include "hersey/film/grid_transfer.h"
#include "hersey/solver/initialise.h"
#include "start/start.h"
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

class LeadIn {
 public:
  LeadIn(const model::Model& model, const Options& options, model::Machine& machine)
      : coarse_(on_half_grids(model)), options_(options), machine_(machine) {
    quiet_.stop = options.stop;
    if (options.on_cycle) {
      quiet_.on_cycle = [this](CycleProgress cycle) {
        cycle.leads_in = true;
        options_.on_cycle(cycle);
      };
    }
  }

  /// Runs its cycles. @returns false if it was stopped
  bool run() {
    MachineRun run(coarse_, quiet_);
    run.begin();
    travelled_ = Eigen::VectorXd::Zero(machine_.mechanism->nv());
    while (!run.is_at_end()) {
      if (quiet_.stop != nullptr && quiet_.stop->load()) return false;
      if (const Outcome step = run.step(); !step.solved()) throw std::runtime_error(step.message);
      if (run.state().v.size() != travelled_.size()) throw std::runtime_error("its bodies have other coordinates");
      travelled_ += run.last_dt() * run.state().v;
    }
    cycles_ = run.summary().cycles;
    end_ = run.state();
    for (std::size_t i = 0; i < machine_.bearings.size(); ++i)
      films_.push_back(run.machine().bearings[i].bearing->on_grid(machine_.bearings[i].bearing->model().grid));
    if (run.machine().network) run.machine().network->persist(network_);
    return true;
  }

  /// Moves the machine to the end of these cycles, at the time of `state`.
  void move(solver::State& state) {
    mbd::Mechanism& mechanism = *machine_.mechanism;
    solver::State start = end_;
    start.t = state.t;
    unwind(mechanism, start.q);
    for (std::size_t i = 0; i < films_.size(); ++i) machine_.bearings[i].bearing->begin_from(films_[i]);
    if (machine_.network) {
      Archive content(network_.content());
      machine_.network->persist(content);
    }
    solver::InitialiseOptions initialise;
    initialise.fixed.resize(static_cast<std::size_t>(mechanism.nv()));
    std::iota(initialise.fixed.begin(), initialise.fixed.end(), 0);
    initialise.fixed_rates = mechanism.given_rates();
    const solver::InitialiseSummary found = solver::initialise(mechanism, start, initialise);
    if (!found.solved()) throw std::runtime_error("its last state is none of the machine's: " + found.message);
    state = start;
  }

  [[nodiscard]] int cycles() const { return cycles_; }

 private:
  // Drives and functions of angles begin again at the start: whole revolutions, each by itself, which do not commute.
  void unwind(const mbd::Mechanism& mechanism, Eigen::VectorXd& q) const {
    const Eigen::VectorXd scales = mechanism.position_scales();
    for (Eigen::Index row = 0; row < travelled_.size(); ++row) {
      const double revolutions = std::round(travelled_[row] / (2 * std::numbers::pi));
      if (scales[row] != 1 || revolutions == 0) continue;
      Eigen::VectorXd back = Eigen::VectorXd::Zero(travelled_.size()), unwound;
      back[row] = -2 * std::numbers::pi * revolutions;
      mechanism.retract(q, back, unwound);
      q = unwound;
    }
  }

  model::Model coarse_;
  const Options& options_;
  Options quiet_;
  model::Machine& machine_;
  Eigen::VectorXd travelled_;  // integral of the velocities
  int cycles_ = 0;
  solver::State end_;
  std::vector<bearing::FilmAtStart> films_;
  Archive network_;
};

}  // namespace

LeadInSummary lead_in(const model::Model& model, const Options& options, model::Machine& machine,
                      solver::State& state) {
  const auto& cycle = model.simulation.cycle;
  if (!cycle || cycle->lead_in == model::LeadIn::none) return {};
  LeadInSummary summary;
  try {
    LeadIn cycles(model, options, machine);
    if (!cycles.run()) return {.message = "its lead-in was stopped"};
    cycles.move(state);
    summary.cycles = cycles.cycles();
    summary.message = fmt::format("begun after {} cycles on half grids", summary.cycles);
  } catch (const std::exception& error) {
    summary.message = "the lead-in was given up: " + error_text(error);
    machine = model::build(model);
    state = starting_state(model, machine);
  }
  return summary;
}

}  // namespace hersey::run
