#include "hersey/run/simulate.h"

#include <fmt/format.h>

#include <exception>
#include <optional>

#include "hersey/core/error_text.h"
#include "hersey/core/input_error.h"
#include "hersey/model/build.h"
#include "hersey/results/checkpoint.h"
#include "hersey/results/output_lock.h"
#include "hersey/results/reader.h"
#include "hersey/results/writer.h"
#include "hersey/solver/equilibrium.h"
#include "hersey/solver/linearise.h"
#include "observation/observe_step.h"
#include "record/coarser_run.h"
#include "start/bearing_axes.h"
#include "start/facing_surfaces.h"
#include "start/redundancies.h"
#include "start/start.h"
#include "start/start_changes.h"
#include "time_stepping/checkpoint.h"
#include "time_stepping/fmu_exchange.h"
#include "time_stepping/fmu_inputs.h"
#include "time_stepping/instants.h"
#include "time_stepping/lead_in.h"
#include "time_stepping/machine_run.h"
#include "time_stepping/steady_heat.h"

namespace hersey::run {
namespace {

// The time is read back: after a write error the file contains less than was passed to it.
double last_time(const std::filesystem::path& file) {
  const results::Reader reader(file);
  const std::size_t rows = reader.rows();
  return rows > 0 ? reader.read_rows("/time", rows - 1, 1).values.front() : 0;
}

void add_warning(Summary& summary, const std::string& text) {
  summary.warning += (summary.warning.empty() || text.empty() ? "" : "; ") + text;
}

// One run: time stepping or another analysis of the machine, to its end.
class Run {
 public:
  Run(const model::Model& model, const Options& options, std::optional<Archive::Content> checkpoint,
      PeriodicStart start, const Summary* coarse)
      : model_(model),
        options_(options),
        machine_(model, options, std::move(checkpoint), std::move(start)),
        coarse_(coarse) {}

  Summary run() {
    try {
      analyse();
      finish(coarse_);
      if (status_ == Status::completed) discard_checkpoint(options_.results);
    } catch (const results::WriteError& error) {
      fail_to_write(error.what());
    } catch (const std::exception& error) {
      fail(fmt::format("t = {:.6g} s: {}", machine_.state().t, error_text(error)));
      finish(nullptr);
    }
    Summary summary = machine_.summary();
    summary.status = status_;
    summary.message = message_;
    summary.warning = machine_.fmu_warnings();
    add_warning(summary, machine_.parted_teeth());
    summary.newton_iterations += newton_iterations_;
    const std::optional<double> last_row = machine_.last_row();
    summary.t_results = is_all_written_ && last_row ? *last_row : last_time(options_.results);
    return summary;
  }

 private:
  void analyse() {
    using model::Analysis;
    const model::Simulation& plan = model_.simulation;
    switch (plan.analysis) {
      case Analysis::dynamics:
      case Analysis::kinematics:
        return step_to_end();
      case Analysis::equilibrium:
      case Analysis::steady:
        if (come_to_rest()) machine_.record_here();
        return;
      case Analysis::modes:
        if (plan.modes_about == model::ModesAbout::end) {
          step_to_end();
          if (status_ != Status::completed) return;
        } else {
          if (plan.modes_about != model::ModesAbout::start && !come_to_rest()) return;
          machine_.record_here();
        }
        return linearise_here();
    }
  }

  void step_to_end() {
    machine_.begin();
    while (!machine_.is_at_end()) {
      if (const Outcome step = machine_.step(); !step.solved()) return fail(step.message);
      if (is_stopped()) return;
    }
    message_ = machine_.ending();
  }

  // True if the user ends the run here, where it can be resumed: no part of a step is pending.
  bool is_stopped() {
    const bool stops = options_.stop && options_.stop->load();
    if (stops && options_.on_stopping) options_.on_stopping();
    machine_.write_checkpoint(stops);
    if (!stops) return false;
    status_ = Status::stopped;
    message_ = fmt::format("stopped on request at t = {:.6g} s", machine_.state().t);
    return true;
  }

  bool come_to_rest() {
    solver::EquilibriumOptions options;
    options.steady_motion = model_.simulation.is_steady_motion();
    const solver::EquilibriumSummary rest = find_warm_steady_motion(machine_.machine(), machine_.state(), options);
    newton_iterations_ += rest.iterations;
    message_ = rest.message;
    if (!rest.solved()) fail((options.steady_motion ? "" : "static: ") + rest.message + advice_on_films());
    return rest.solved();
  }

  /// What carries a machine that rests in films.
  [[nodiscard]] std::string advice_on_films() const {
    if (model_.bearings.empty() || model_.simulation.is_steady_motion()) return "";
    return "; at rest films carry what their supplies press: `analysis: steady` lets the drives turn";
  }

  void linearise_here() {
    const solver::Linearisation linear = solver::linearise(machine_.mechanism(), machine_.state(), machine_.last_dt());
    const solver::Modes found = linear.solved() ? solver::find_modes(linear) : no_answer<solver::Modes>(linear.message);
    if (!found.solved()) return fail("modes: " + found.message);
    machine_.write_modes(found);
    if (!found.stable) message_ = "unstable: a small motion grows (negative damping ratio)";
  }

  void finish(const Summary* coarse) {
    if (const Outcome written = machine_.finish(status_, message_, coarse); !written.solved())
      fail_to_write(written.message);
  }

  void fail_to_write(std::string message) {
    is_all_written_ = false;
    fail(std::move(message));
  }

  void fail(std::string message) {
    status_ = Status::failed;
    message_ = std::move(message);
  }

  const model::Model& model_;
  const Options& options_;
  MachineRun machine_;
  const Summary* coarse_;
  Status status_ = Status::completed;
  std::string message_;
  int newton_iterations_ = 0;   // iterations of the search for rest
  bool is_all_written_ = true;  // true if all rows passed to the results file are in it
};

// The period with which a run goes on; 0 if its model gives it.
double found_period(const Archive::Content& checkpoint) {
  const auto period = checkpoint.numbers.find("lead_in_period");
  return period == checkpoint.numbers.end() ? 0 : period->second.values.front();
}

// Nothing else of a machine without bearings says whether its cycles repeat.
void require_periodic_motion(const model::Model& model, const PeriodicStart& start) {
  if (!model.simulation.cycle || !model.bearings.empty() || start.cycles > 0 || start.was_stopped) return;
  throw InputError(Fault{model.position_of("simulation.cycle"), "simulation.cycle",
                         "cycles of a machine without bearings, and no motion that repeats: " + start.message,
                         "a start near it, or a `duration`", ""});
}

// A run that could not begin leaves no file behind.
Summary simulate_from(std::optional<Archive::Content> checkpoint, const model::Model& model, const Options& options,
                      const Summary* coarse = nullptr) {
  try {
    PeriodicStart start = checkpoint ? PeriodicStart{} : lead_in(model, options);
    if (checkpoint) start.period = found_period(*checkpoint);
    if (!checkpoint) require_periodic_motion(model, start);
    if (start.period == 0) return Run(model, options, std::move(checkpoint), std::move(start), coarse).run();
    model::Model timed = model;
    take_period(timed, start.period);
    return Run(timed, options, std::move(checkpoint), std::move(start), coarse).run();
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(unfinished_file(options.results), ignored);
    throw;
  }
}

// Runs the model with longer steps for the error estimate; only the summary is kept.
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
    add_warning(summary, "the step error is not known: with steps twice as long the run ends early: " + coarse.message);
  return summary;
}

Summary simulate_locked(const model::Model& model, const Options& options);

Summary resume_from(Archive::Content checkpoint, const model::Model& model, const Options& options) {
  std::string warning;
  require_identity(checkpoint, model, checkpoint_file(options.results), warning);
  Summary summary = simulate_from(std::move(checkpoint), model, options);
  add_warning(summary, warning);
  return summary;
}

// A checkpoint is removed when its run is complete: as long as there is one, results with the status `completed` may
// have been cut off by a kill.
Summary resume(const model::Model& model, const Options& options) {
  const bool begun = has_results(options.results);
  const std::filesystem::path file = checkpoint_file(options.results);
  if (begun && std::filesystem::exists(file)) return resume_from(results::read_checkpoint(file), model, options);
  Summary summary;
  const bool is_done = begun && is_complete(model, options.results);
  if (const std::string why = why_not_saved(model); !is_done && !why.empty())
    throw InputError(Fault{model.position_of("fmus"), "fmus", "a run to go on with: " + why,
                           "FMUs that save their state", "run it anew with --force"});
  if (is_done) {
    summary.results = options.results;
    summary.t_end = summary.t_results = last_time(options.results);
    summary.status = Status::completed;
    summary.message = "it was complete already";
    return summary;
  }
  Options anew = options;
  anew.overwrite = true;
  anew.resume = false;
  summary = simulate_locked(model, anew);
  add_warning(summary, "there was no checkpoint to go on from: the run began anew");
  return summary;
}

// The results file is this run's alone.
Summary simulate_locked(const model::Model& model, const Options& options) {
  if (options.resume) return resume(model, options);
  // A checkpoint of results that are about to be replaced.
  if (options.overwrite || !std::filesystem::exists(options.results)) discard_checkpoint(options.results);
  if (options.step_error && !model.bearings.empty()) return simulate_with_step_error(model, options);
  return simulate_from(std::nullopt, model, options);
}

}  // namespace

std::vector<Fault> check(const model::Model& model) {
  if (model.is_of_bearings_alone()) return {};
  model::Machine machine = model::build(model);
  const solver::State start = starting_state(model, machine);
  // Refuses an unlimited number of instants. A fixed step needs none.
  const mbd::Observation at_start = observe_step(machine, start, force_kinds(machine)).mechanism;
  if (model.simulation.error_control) (void)kinks(model, machine.mechanism->spec(), at_start);
  std::vector<Fault> warnings = start_warnings(model, *machine.mechanism, start);
  if (!model.fmus.empty()) (void)FmuInputs(model, machine, start);  // refuses quantities that are not there
  for (Fault& warning : redundancy_warnings(model, *machine.mechanism)) warnings.push_back(std::move(warning));
  for (Fault& warning : offset_warnings(model)) warnings.push_back(std::move(warning));
  for (Fault& warning : axis_warnings(model, machine, at_start)) warnings.push_back(std::move(warning));
  return warnings;
}

std::vector<Fault> warnings_of(const model::Model& model) {
  std::vector<Fault> warnings = model.warnings;
  for (Fault& warning : check(model)) warnings.push_back(std::move(warning));
  return warnings;
}

void require_machine(const model::Model& model) {
  if (!model.is_of_bearings_alone()) return;
  throw InputError(Fault{{model.file, 0, 0},
                         "",
                         "bearings alone",
                         "bodies and a simulation to run",
                         "'hersey bearing' solves bearings by themselves"});
}

Summary simulate(const model::Model& model, const Options& options) {
  require_machine(model);
  const results::OutputLock lock(options.results);
  return simulate_locked(model, options);
}

}  // namespace hersey::run
