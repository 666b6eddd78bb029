#include "hersey/run/simulate.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <exception>
#include <optional>

#include "hersey/core/error_text.h"
#include "hersey/core/input_error.h"
#include "hersey/core/stopwatch.h"
#include "hersey/model/build.h"
#include "hersey/results/checkpoint.h"
#include "hersey/results/reader.h"
#include "hersey/results/writer.h"
#include "hersey/solver/equilibrium.h"
#include "hersey/solver/linearise.h"
#include "march/checkpoint.h"
#include "march/coarser_run.h"
#include "march/instants.h"
#include "march/redundancies.h"
#include "march/start.h"
#include "march/start_changes.h"
#include "march/step_march.h"
#include "march/warm_bodies.h"
#include "record/bearing_axes.h"
#include "record/facing_surfaces.h"
#include "record/observe_step.h"
#include "record/run_record.h"
#include "record/work_record.h"

namespace hersey::run {
namespace {

using Clock = std::chrono::steady_clock;

// Read back: after a write error the file holds less than was handed to it.
double last_time(const std::filesystem::path& file) {
  const results::Reader reader(file);
  const std::size_t rows = reader.rows();
  return rows > 0 ? reader.read_rows("/time", rows - 1, 1).values.front() : 0;
}

// One simulation: owns the machine, its state and its record.
class Simulation {
 public:
  /// @param checkpoint  where an interrupted run goes on; empty: from the start
  /// @param coarse  summary of the run with steps twice as long; none where no step error is asked for
  Simulation(const model::Model& model, const Options& options, std::optional<Archive::Content> checkpoint,
             const Summary* coarse = nullptr)
      : model_(model),
        options_(options),
        coarse_(coarse),
        began_(Clock::now()),
        machine_(model::build(model)),
        state_(starting_state(model, machine_)),
        kinds_(force_kinds(machine_)),
        march_(model, machine_),
        work_(model, machine_, march_.integrator()),
        record_(model, machine_, state_, options, checkpoint.has_value()),
        checkpoints_(model.simulation) {
    summary_.results = options.results;
    record_.declare_cost(work_.work());
    if (checkpoint) restore(std::move(*checkpoint));
  }

  Summary run() {
    try {
      analyse();
      finish(summary_.status == Status::completed ? results::Status::completed
             : summary_.status == Status::stopped ? results::Status::stopped
                                                  : results::Status::failed);
      if (summary_.status == Status::completed) discard_checkpoint(options_.results);
    } catch (const results::WriteError& error) {
      fail(error.what());
    } catch (const std::exception& error) {
      fail(fmt::format("t = {:.6g} s: {}", state_.t, error_text(error)));
      finish(results::Status::failed);
    }
    summary_.t_end = state_.t;
    summary_.t_results = last_time(options_.results);
    summary_.rejected_steps = march_.rejected_steps();
    record_.summarise(summary_);
    summary_.wall_time = elapsed();
    return summary_;
  }

 private:
  void analyse() {
    using model::Analysis;
    const model::Simulation& plan = model_.simulation;
    switch (plan.analysis) {
      case Analysis::dynamics:
      case Analysis::kinematics:
        return march();
      case Analysis::equilibrium:
        if (come_to_rest()) record(MarchedStep{});
        return;
      case Analysis::modes:
        if (plan.modes_about == model::ModesAbout::end) {
          march();
          if (summary_.status != Status::completed) return;
        } else {
          if (plan.modes_about != model::ModesAbout::start && !come_to_rest()) return;
          record(MarchedStep{});
        }
        return linearise_here();
    }
  }

  void march() {
    if (!resumes_) {
      const StepRecord start = observe({});
      march_.plan(state_, start.mechanism);
      record(start);
    }
    work_.begin();
    while (!march_.is_at_end() && !record_.ends_run()) {
      const MarchedStep step = march_.take(state_);
      if (!step.is_taken()) {
        // A journal that touches has been told so already.
        const bool is_advised = step.trouble.find("asperities") != std::string::npos;
        if (const std::string why = thermal_trouble(machine_, true); !why.empty())
          return fail(fmt::format("t = {:.6g} s: {}; no step goes on from there: {}", state_.t, why, step.trouble));
        return fail(step.trouble + (is_advised ? "" : record_.thin_films()));
      }
      if (model_.thermal_walls == model::ThermalWalls::transient) warm_bodies(machine_, step.dt);
      record(step);
      if (const std::string trouble = thermal_trouble(machine_); !trouble.empty())
        return fail(fmt::format("t = {:.6g} s: {}", state_.t, trouble));
      if (is_stopped()) return;
    }
    summary_.message = record_.ending(state_.t);
  }

  // Whether the user ends the run here, where it can go on later: nothing of a step is pending.
  bool is_stopped() {
    const bool stops = options_.stop && options_.stop->load();
    if (stops && options_.on_stopping) options_.on_stopping();
    if (stops || checkpoints_.is_due(state_.t)) write_checkpoint();
    if (!stops) return false;
    summary_.status = Status::stopped;
    summary_.message = fmt::format("stopped on request at t = {:.6g} s", state_.t);
    return true;
  }

  bool come_to_rest() {
    solver::EquilibriumOptions options;
    options.turning = model_.simulation.analysis == model::Analysis::modes &&
                      model_.simulation.modes_about == model::ModesAbout::turning;
    const solver::EquilibriumSummary rest = solver::find_equilibrium(*machine_.mechanism, state_, options);
    summary_.newton_iterations += rest.iterations;
    summary_.message = rest.message;
    if (!rest.converged) fail(options.turning ? rest.message : "static: " + rest.message);
    return rest.converged;
  }

  void linearise_here() {
    const solver::Linearisation linear = solver::linearise(*machine_.mechanism, state_, march_.last_dt());
    solver::Modes found;
    if (linear.trouble.empty()) found = solver::find_modes(linear);
    const std::string& trouble = linear.trouble.empty() ? found.message : linear.trouble;
    if (!trouble.empty()) return fail("modes: " + trouble);
    record_.write_modes(state_, found);
    if (!found.stable) summary_.message = "unstable: a small motion grows (negative damping ratio)";
  }

  [[nodiscard]] StepRecord observe(const MarchedStep& step) {
    StepRecord seen = observe_step(machine_, state_, kinds_);
    seen.dt = step.dt;
    seen.error = step.error;
    seen.step_error = step.local_error;
    seen.newton_iterations = step.solution.iterations;
    seen.newton_residual = step.solution.residual;
    seen.rejected_steps = march_.rejected_steps();
    return seen;
  }

  void record(const MarchedStep& step) {
    if (model_.thermal_walls == model::ThermalWalls::cycle_mean && record_.ends_cycle(state_.t)) settle_walls(machine_);
    const Stopwatch watch(work_.recording());
    record(observe(step));
  }

  void record(const StepRecord& step) {
    work_.take(step);
    record_.take(step);
    report_progress(step);
  }

  // Everything that the rest of the run depends on.
  void persist(Archive& archive) {
    {
      const Archive::Group group(archive, "state");
      archive.io("t", state_.t), archive.io("q", state_.q), archive.io("v", state_.v);
      archive.io("vdot", state_.vdot), archive.io("lambda", state_.lambda);
    }
    {
      const Archive::Group group(archive, "mechanism");
      machine_.mechanism->persist(archive);
    }
    {
      const Archive::Group group(archive, "march");
      march_.persist(archive);
    }
    if (machine_.network) {
      const Archive::Group group(archive, "thermal_network");
      machine_.network->persist(archive);
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

  void write_checkpoint() {
    const Stopwatch watch(work_.recording());
    const Clock::time_point began = Clock::now();
    Archive archive;
    save_identity(archive, model_);
    persist(archive);
    results::write_checkpoint(checkpoint_file(options_.results), archive.content());
    checkpoints_.written(state_.t, std::chrono::duration<double>(Clock::now() - began).count());
  }

  void restore(Archive::Content checkpoint) {
    march_.plan(state_, observe({}).mechanism);
    Archive archive(std::move(checkpoint));
    const std::filesystem::path file = checkpoint_file(options_.results);
    try {
      persist(archive);
    } catch (const ArchiveError& error) {
      throw results::ReadError(file, std::string("it does not fit this program: ") + error.what());
    }
    const bool is_finite = std::isfinite(state_.t) && state_.q.allFinite() && state_.v.allFinite() &&
                           state_.vdot.allFinite() && state_.lambda.allFinite();
    if (!is_finite) throw results::ReadError(file, "its state has a number that is not finite");
    for (const std::string& name : archive.unread())
      if (!is_identity(name)) throw results::ReadError(file, "it does not fit this program: it holds '" + name + "'");
    checkpoints_.written(state_.t, 0);
    resumes_ = true;
  }

  void report_progress(const StepRecord& step) const {
    if (!options_.on_progress) return;
    const model::Simulation& plan = model_.simulation;
    options_.on_progress({.t = state_.t,
                          .t_start = plan.start,
                          .t_end = plan.start + plan.duration,
                          .dt = step.dt,
                          .newton_iterations = step.newton_iterations,
                          .moft = record_.moft(),
                          .elapsed = elapsed()});
  }

  void fail(std::string message) {
    summary_.status = Status::failed;
    summary_.message = std::move(message);
  }

  void finish(results::Status status) {
    summary_.work = work_.work();
    try {
      if (coarse_ != nullptr && status == results::Status::completed) record_.write_step_errors(*coarse_);
      record_.finish(status, summary_.message, elapsed(), summary_.work);
    } catch (const results::WriteError& error) {
      fail(error.what());
    }
  }

  [[nodiscard]] double elapsed() const {
    return before_ + std::chrono::duration<double>(Clock::now() - began_).count();
  }

  const model::Model& model_;
  const Options& options_;
  const Summary* coarse_;
  Clock::time_point began_;
  model::Machine machine_;
  solver::State state_;
  std::vector<ForceKind> kinds_;
  StepMarch march_;
  WorkRecord work_;
  RunRecord record_;
  CheckpointSchedule checkpoints_;
  bool resumes_ = false;
  double before_ = 0;  // computing time before the run was resumed [s]
  Summary summary_;
};

// What could not begin leaves nothing behind.
Summary simulate_from(std::optional<Archive::Content> checkpoint, const model::Model& model, const Options& options,
                      const Summary* coarse = nullptr) {
  try {
    return Simulation(model, options, std::move(checkpoint), coarse).run();
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(unfinished_file(options.results), ignored);
    throw;
  }
}

// The run that tells the error of the steps, of which only the summary is kept.
Summary simulate_longer_steps(const model::Model& model, const Options& options) {
  Options coarse = options;
  coarse.step_error = false;
  coarse.overwrite = true;
  coarse.results += ".longer_steps";
  coarse.on_cycle = {};
  Summary summary = simulate(with_longer_steps(model), coarse);
  std::error_code ignored;
  std::filesystem::remove(coarse.results, ignored);
  discard_checkpoint(coarse.results);
  return summary;
}

Summary simulate_with_step_error(const model::Model& model, const Options& options) {
  const Summary coarse = simulate_longer_steps(model, options);
  const bool is_known = coarse.status == Status::completed;
  Summary summary = simulate_from(std::nullopt, model, options, is_known ? &coarse : nullptr);
  if (!is_known)
    summary.warning = "the step error is not known: with steps twice as long the run ends early: " + coarse.message;
  return summary;
}

Summary resume_from(Archive::Content checkpoint, const model::Model& model, const Options& options) {
  std::string warning;
  require_identity(checkpoint, model, checkpoint_file(options.results), warning);
  Summary summary = simulate_from(std::move(checkpoint), model, options);
  summary.warning = warning;
  return summary;
}

// A checkpoint goes when its run is complete: while there is one, results that say so may have been cut off by a kill.
Summary resume(const model::Model& model, const Options& options) {
  const bool begun = has_results(options.results);
  const std::filesystem::path file = checkpoint_file(options.results);
  if (begun && std::filesystem::exists(file)) return resume_from(results::read_checkpoint(file), model, options);
  Summary summary;
  if (begun && is_complete(model, options.results)) {
    summary.results = options.results;
    summary.t_end = summary.t_results = last_time(options.results);
    summary.message = "it was complete already";
    return summary;
  }
  Options anew = options;
  anew.overwrite = true;
  anew.resume = false;
  summary = simulate(model, anew);
  summary.warning = "there was no checkpoint to go on from: the run began anew";
  return summary;
}

}  // namespace

std::vector<Fault> check(const model::Model& model) {
  if (model.is_of_bearings_alone()) return {};
  model::Machine machine = model::build(model);
  const solver::State start = starting_state(model, machine);
  // Refuses instants without end. A fixed step asks for none.
  const mbd::Observation at_start = observe_step(machine, start, force_kinds(machine)).mechanism;
  if (model.simulation.error_control) (void)kinks(model, machine.mechanism->spec(), at_start);
  std::vector<Fault> warnings = start_warnings(model, *machine.mechanism, start);
  for (Fault& warning : redundancy_warnings(model, *machine.mechanism)) warnings.push_back(std::move(warning));
  for (Fault& warning : offset_warnings(model)) warnings.push_back(std::move(warning));
  for (Fault& warning : axis_warnings(model, machine, at_start)) warnings.push_back(std::move(warning));
  return warnings;
}

Summary simulate(const model::Model& model, const Options& options) {
  if (model.is_of_bearings_alone()) {
    throw InputError(Fault{{model.file, 0, 0},
                           "",
                           "bearings alone",
                           "bodies and a simulation to run",
                           "'hersey bearing' solves bearings by themselves"});
  }
  if (options.resume) return resume(model, options);
  // A checkpoint of results that are about to be replaced.
  if (options.overwrite || !std::filesystem::exists(options.results)) discard_checkpoint(options.results);
  if (options.step_error && !model.bearings.empty()) return simulate_with_step_error(model, options);
  return simulate_from(std::nullopt, model, options);
}

}  // namespace hersey::run
