#include "time_stepping/machine_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "hersey/core/stopwatch.h"
#include "hersey/results/checkpoint.h"
#include "hersey/results/reader.h"
#include "hersey/results/writer.h"
#include "hersey/run/checkpoint.h"
#include "observation/observe_step.h"
#include "start/start.h"
#include "time_stepping/warm_bodies.h"

namespace hersey::run {
namespace {

results::Status as_written(Status status) {
  if (status == Status::completed) return results::Status::completed;
  return status == Status::stopped ? results::Status::stopped : results::Status::failed;
}

std::vector<BearingProgress> bearings_of(const model::Model& model, const StepRecord& step) {
  std::vector<BearingProgress> figures;
  for (std::size_t i = 0; i < step.bearings.size(); ++i) {
    const bearing::BearingObservation& observed = step.bearings[i];
    figures.push_back({.name = model.bearings[i].name,
                       .h_min = observed.film.h_min,
                       .p_max = observed.film.p_max,
                       .e_x = observed.position.e[0],
                       .e_y = observed.position.e[1],
                       .power = observed.film.power_film + observed.film.power_asperity,
                       .flow = observed.film.flow_out()});
    BearingProgress& own = figures.back();
    own.power_asperity = observed.film.power_asperity;
    if (!observed.heat) continue;
    const film::HeatBalance& heat = observed.heat->balance;
    own.T_max = observed.heat->T_max;
    own.has_heat = true;
    own.heat_to_oil = heat.to_oil, own.heat_to_shell = heat.to_shell;
    own.heat_to_journal = heat.to_journal, own.heat_stored = heat.stored;
  }
  return figures;
}

PowerProgress powers_of(const StepRecord& step) {
  const PowerBalance& power = step.power;
  PowerProgress figures{.drives = power.drives,
                        .loads = power.loads,
                        .gravity = power.gravity,
                        .springs = power.springs,
                        .contacts = power.contacts,
                        .bearings = power.bearings,
                        .elastic = power.elastic,
                        .kinetic_rate = power.kinetic_rate,
                        .error = power.error()};
  for (const bearing::BearingObservation& observed : step.bearings) {
    figures.film_friction += observed.film.power_film;
    figures.asperity_friction += observed.film.power_asperity;
  }
  figures.has_network = step.network.T.size() > 0;
  if (figures.has_network)
    figures.heat_to_surroundings = step.network.to_fixed, figures.heat_in_bodies = step.network.stored;
  return figures;
}

CircuitProgress circuit_of(const model::Model& model, const StepRecord& step) {
  CircuitProgress figures;
  const bearing::CircuitObservation& seen = step.circuit;
  if (!model.circuit || seen.pressures.size() == 0) return figures;
  for (std::size_t i = 0; i < model.circuit->network.nodes.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    figures.nodes.push_back(
        {.name = model.circuit->network.nodes[i].name, .pressure = seen.pressures[k], .drawn = seen.drawn[k]});
    if (seen.temperatures.size() > 0) figures.nodes.back().temperature = seen.temperatures[k];
  }
  for (std::size_t i = 0; i < model.circuit->network.elements.size(); ++i)
    figures.elements.push_back(
        {.name = model.circuit->network.elements[i].name, .flow = seen.flows[static_cast<Eigen::Index>(i)]});
  return figures;
}

}  // namespace

MachineRun::MachineRun(const model::Model& model, const Options& options, std::optional<Archive::Content> checkpoint,
                       PeriodicStart start)
    : exchange_(model.fmus.empty() ? nullptr : std::make_unique<FmuExchange>(model)),
      model_(exchange_ ? exchange_->model() : model),
      options_(options),
      began_(Clock::now()),
      machine_(model::build(model_)),
      state_(starting_state(model_, machine_)),
      start_(begin_in(std::move(start), model_, machine_, state_)),
      kinds_(force_kinds(machine_)),
      stepper_(model_, machine_),
      work_(model_, machine_, stepper_.integrator()),
      record_(model_, machine_, state_, options, checkpoint.has_value()),
      checkpoints_(model_.simulation) {
  if (exchange_) fmu_inputs_.emplace(model_, machine_, state_);
  record_.declare_cost(work_.work());
  if (checkpoint) restore_file(std::move(*checkpoint));
}

std::string MachineRun::ending() const {
  const std::string text = record_.ending(state_.t);
  return start_.message.empty() || text.empty() ? text : text + "; " + start_.message;
}

void MachineRun::begin() {
  if (!resumes_) {
    if (start_.motion) move_to(*start_.motion);
    StepRecord start = observe({});
    stepper_.plan(state_, start.mechanism);
    if (exchange_) begin_exchange(start);
    record(std::move(start));
    if (!start_.multipliers.empty()) record_.write_multipliers(start_.multipliers);
  }
  work_.begin();
}

// The machine at its start, as it is with what the FMUs return to that.
void MachineRun::begin_exchange(StepRecord& start) {
  exchange_->take_inputs(fmu_inputs_->at(start, record_.energy()));
  const Jump jump = exchange_->begin();
  if (jump != Jump::none) take_jump(jump == Jump::of_speed);
  start = observe({});
}

void MachineRun::take_jump(bool moves) {
  stepper_.take_jump(state_, moves);
  record_.go_on_from(observe({}));
}

// Inputs are those of the end of the last step, whatever has been resumed or restored since.
Outcome MachineRun::exchange_signals() {
  if (!exchange_->is_due(state_.t, slack())) return {Ending::solved};
  try {
    Jump jump = Jump::none;
    {
      const Stopwatch watch(work_.fmus());
      jump = exchange_->exchange(state_.t, slack());
    }
    if (jump != Jump::none) take_jump(jump == Jump::of_speed);
  } catch (const std::runtime_error& error) {
    return no_answer<Outcome>(fmt::format("t = {:.6g} s: {}", state_.t, error.what()));
  }
  return {Ending::solved};
}

Outcome MachineRun::step(double limit) {
  if (exchange_) {
    if (Outcome exchanged = exchange_signals(); !exchanged.solved()) return exchanged;
    limit = std::min(limit, exchange_->next());
  }
  const TimeStep step = stepper_.take(state_, limit);
  if (!step.solved()) {
    // The message of a journal that touches names asperities already.
    const bool is_advised = step.message.find("asperities") != std::string::npos;
    if (const std::string why = thermal_failure(machine_, true); !why.empty())
      return no_answer<Outcome>(
          fmt::format("t = {:.6g} s: {}; no step goes on from there: {}", state_.t, why, step.message));
    return no_answer<Outcome>(step.message + (is_advised ? "" : record_.thin_films()));
  }
  if (model_.thermal_walls == model::ThermalWalls::transient) warm_bodies(machine_, step.dt);
  if (model_.thermal_walls == model::ThermalWalls::cycle_mean) average_streams(machine_, step.dt);
  mix_grooves(machine_);
  record(step);
  if (exchange_ && exchange_->is_due(state_.t, slack())) {
    const Stopwatch watch(work_.fmus());
    exchange_->take_inputs(fmu_inputs_->at(last_step_, record_.energy()));
  }
  for (const std::string& why : {thermal_failure(machine_), wear_failure(machine_)})
    if (!why.empty()) return no_answer<Outcome>(fmt::format("t = {:.6g} s: {}", state_.t, why));
  return {Ending::solved};
}

StepRecord MachineRun::observe(const TimeStep& step) {
  StepRecord observed = observe_step(machine_, state_, kinds_);
  observed.dt = step.dt;
  observed.error = step.error;
  observed.step_error = step.local_error;
  observed.newton_iterations = step.solution.iterations;
  observed.newton_residual = step.solution.residual;
  observed.rejected_steps = stepper_.rejected_steps();
  observed.energy_available = stepper_.energy().available();
  observed.energy_from_nowhere = stepper_.energy().gained();
  if (exchange_) observed.fmus = exchange_->signals();
  return observed;
}

void MachineRun::record(const TimeStep& step) {
  if (model_.thermal_walls == model::ThermalWalls::cycle_mean && record_.ends_cycle(state_.t)) settle_walls(machine_);
  const Stopwatch watch(work_.recording());
  record(observe(step));
}

void MachineRun::record(StepRecord step) {
  last_step_ = std::move(step);
  work_.take(last_step_);
  record_.take(last_step_);
  report_progress(last_step_);
}

void MachineRun::persist(Archive& archive) {
  {
    const Archive::Group group(archive, "state");
    archive.io("t", state_.t), archive.io("q", state_.q), archive.io("v", state_.v);
    archive.io("vdot", state_.vdot), archive.io("lambda", state_.lambda);
  }
  archive.io("lead_in_cycles", start_.cycles), archive.io("lead_in", start_.message);
  archive.io("lead_in_period", start_.period);
  {
    const Archive::Group group(archive, "mechanism");
    machine_.mechanism->persist(archive);
  }
  {
    const Archive::Group group(archive, "march");
    stepper_.persist(archive);
  }
  if (machine_.network) {
    const Archive::Group group(archive, "thermal_network");
    machine_.network->persist(archive);
  }
  if (exchange_) {
    const Archive::Group group(archive, "fmus");
    exchange_->persist(archive);
  }
  {
    const Archive::Group group(archive, "work");
    double wall_time = elapsed();
    archive.io("wall_time", wall_time);
    if (archive.restores()) before_ = wall_time;
    work_.persist(archive);
  }
  const Archive::Group group(archive, "record");
  record_.persist(archive);
}

void MachineRun::persist_motion(Archive& archive) {
  archive.io("v", state_.v), archive.io("vdot", state_.vdot), archive.io("lambda", state_.lambda);
  {
    const Archive::Group group(archive, "mechanism");
    machine_.mechanism->persist_between_bodies(archive);
  }
  {
    const Archive::Group group(archive, "history");
    stepper_.persist_history(archive, state_);
  }
  if (!machine_.network) return;
  const Archive::Group group(archive, "thermal_network");
  machine_.network->persist(archive);
}

Motion MachineRun::motion() {
  Archive archive;
  persist_motion(archive);
  return {.q = state_.q, .memory = archive.content()};
}

void MachineRun::move_to(const Motion& motion) {
  const Eigen::VectorXd here = state_.q;
  mechanism().retract(here, mechanism().difference(here, motion.q, motion.swinging), state_.q);
  Archive archive(motion.memory);
  persist_motion(archive);
  place_surfaces();
}

void MachineRun::place_surfaces() {
  for (const model::BuiltBearing& bearing : machine_.bearings)
    bearing.bearing->place_surfaces(mechanism().relative_motion(state_, bearing.force));
}

void MachineRun::write_checkpoint(bool in_any_case) {
  if (exchange_ && !why_not_saved(model_).empty()) return;
  if (start_.was_stopped || options_.results.empty() || !(in_any_case || checkpoints_.is_due(state_.t))) return;
  const Stopwatch watch(work_.recording());
  const Clock::time_point began = Clock::now();
  Archive archive;
  save_identity(archive, model_);
  persist(archive);
  results::write_checkpoint(checkpoint_file(options_.results), archive.content());
  checkpoints_.written(state_.t, std::chrono::duration<double>(Clock::now() - began).count());
}

void MachineRun::restore(Archive& archive) {
  persist(archive);
  const bool is_finite = std::isfinite(state_.t) && state_.q.allFinite() && state_.v.allFinite() &&
                         state_.vdot.allFinite() && state_.lambda.allFinite();
  if (!is_finite) throw ArchiveError("its state has a number that is not finite");
  for (const std::string& name : archive.unread())
    if (!is_identity(name)) throw ArchiveError("it holds '" + name + "', of which this program knows nothing");
  place_surfaces();
  TimeStep last;
  last.dt = stepper_.last_dt();
  last_step_ = observe(last);
}

void MachineRun::restore_file(Archive::Content checkpoint) {
  stepper_.plan(state_, observe({}).mechanism);
  Archive archive(std::move(checkpoint));
  try {
    restore(archive);
  } catch (const ArchiveError& error) {
    throw results::ReadError(checkpoint_file(options_.results),
                             std::string("it does not fit this program: ") + error.what());
  }
  checkpoints_.written(state_.t, 0);
  resumes_ = true;
}

void MachineRun::report_progress(const StepRecord& step) const {
  if (!options_.on_progress) return;
  const model::Simulation& plan = model_.simulation;
  options_.on_progress({.t = state_.t,
                        .t_start = plan.start,
                        .t_end = plan.start + plan.duration,
                        .dt = step.dt,
                        .newton_iterations = step.newton_iterations,
                        .moft = record_.moft(),
                        .elapsed = elapsed(),
                        .bearings = [this, &step] { return bearings_of(model_, step); },
                        .circuit = [this, &step] { return circuit_of(model_, step); },
                        .powers = [&step] { return powers_of(step); }});
}

Outcome MachineRun::finish(Status status, const std::string& message, const Summary* coarse) {
  cost_ = cost();  // in case of a file that cannot be written
  try {
    {
      const Stopwatch watch(work_.recording());
      record_.flush();
    }
    cost_ = cost();
    if (coarse != nullptr && status == Status::completed) record_.write_step_errors(*coarse);
    record_.finish(as_written(status), message, cost_->wall_time, cost_->work);
  } catch (const results::WriteError& error) {
    return no_answer<Outcome>(error.what());
  }
  return {Ending::solved};
}

Summary MachineRun::summary() const {
  Summary summary;
  summary.results = options_.results;
  summary.t_end = state_.t;
  summary.rejected_steps = stepper_.rejected_steps();
  summary.lead_in_cycles = start_.cycles;
  record_.summarise(summary);
  const Cost spent = cost_ ? *cost_ : cost();
  summary.wall_time = spent.wall_time;
  summary.work = spent.work;
  return summary;
}

double MachineRun::elapsed() const { return before_ + std::chrono::duration<double>(Clock::now() - began_).count(); }

}  // namespace hersey::run
