#include "hersey/run/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>

#include "checkpoint.h"
#include "cycle_convergence.h"
#include "extremes.h"
#include "facing_surfaces.h"
#include "flexible_record.h"
#include "hersey/core/input_error.h"
#include "hersey/core/stopwatch.h"
#include "hersey/model/build.h"
#include "hersey/results/checkpoint.h"
#include "hersey/results/reader.h"
#include "hersey/results/writer.h"
#include "hersey/solver/equilibrium.h"
#include "hersey/solver/generalized_alpha.h"
#include "hersey/solver/initialise.h"
#include "hersey/solver/kinematics.h"
#include "hersey/solver/linearise.h"
#include "hersey/solver/step_control.h"
#include "instants.h"
#include "observe_step.h"
#include "recorder.h"
#include "redundancies.h"
#include "settling.h"
#include "start.h"
#include "step_error.h"
#include "work_record.h"

namespace hersey::run {
namespace {

using Clock = std::chrono::steady_clock;

solver::GeneralizedAlphaOptions integrator_options(const model::Model& model) {
  solver::GeneralizedAlphaOptions options;
  options.spectral_radius = model.simulation.spectral_radius;
  options.rtol = model.simulation.tolerance;
  options.max_iterations = model.simulation.max_iterations;
  for (const model::Bearing& bearing : model.bearings) {
    if (bearing.coupling.scheme == model::CouplingScheme::partitioned) {
      options.max_iterations = std::max(options.max_iterations, bearing.coupling.max_iterations);
    }
  }
  return options;
}

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
  Simulation(const model::Model& model, const Options& options, std::optional<Archive::Content> checkpoint)
      : model_(model),
        options_(options),
        began_(Clock::now()),
        machine_(model::build(model)),
        state_(starting_state(model, machine_)),
        integrator_(integrator_options(model)),
        work_(model, machine_, integrator_),
        step_error_(model, machine_),
        recorder_(model, machine_, options, checkpoint.has_value()),
        deformed_(model, machine_, options.results),
        settling_(model),
        cycles_(model),
        checkpoints_(model.simulation) {
    kinds_.resize(machine_.mechanism->spec().forces.size(), ForceKind::spring);
    for (const model::BuiltContact& contact : machine_.contacts) {
      kinds_[static_cast<std::size_t>(contact.force.index)] = ForceKind::contact;
    }
    for (const model::BuiltBearing& bearing : machine_.bearings) {
      kinds_[static_cast<std::size_t>(bearing.force.index)] = ForceKind::bearing;
      extremes_.emplace_back(bearing.bearing->name());
    }
    summary_.results = options.results;
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
      fail(fmt::format("t = {:.6g} s: {}", state_.t, error.what()));
      finish(results::Status::failed);
    }
    summary_.t_end = state_.t;
    summary_.t_results = last_time(options_.results);
    for (const BearingExtremes& bearing : extremes_) summary_.bearings.push_back(bearing.summary());
    summary_.worst_power_balance = largest_power_ > 0 ? largest_error_ / largest_power_ : 0;
    summary_.wall_time = elapsed();
    return summary_;
  }

 private:
  void analyse() {
    using model::Analysis;
    const model::Simulation& plan = model_.simulation;
    switch (plan.analysis) {
      case Analysis::dynamics:
        return integrate();
      case Analysis::kinematics:
        return follow_drives();
      case Analysis::equilibrium:
        if (come_to_rest()) take(observe(0, {}));
        return;
      case Analysis::modes:
        if (plan.modes_about == model::ModesAbout::end) {
          integrate();
          if (summary_.status != Status::completed) return;
        } else {
          if (plan.modes_about != model::ModesAbout::start && !come_to_rest()) return;
          take(observe(0, {}));
        }
        return linearise_here();
    }
  }

  void begin() {
    const StepRecord start = observe(0, {});
    plan_steps(start.mechanism);
    take(start);
  }

  void integrate() {
    if (!resumes_) begin();
    work_.begin();
    if (model_.simulation.error_control) {
      march_controlled(*model_.simulation.error_control);
    } else {
      march();
    }
    tell_unconverged();
  }

  // Instant by instant, nothing integrated.
  void follow_drives() {
    const model::Simulation& plan = model_.simulation;
    if (!resumes_) take(observe(0, {}));
    const int intervals = std::max(1, static_cast<int>(std::ceil(plan.duration / plan.step - 1e-9)));
    for (int& k = instant_; k < intervals;) {
      ++k;
      const double t = k == intervals ? plan.start + plan.duration : plan.start + k * plan.step;
      const double dt = t - state_.t;
      const Eigen::VectorXd guess = dt * state_.v + 0.5 * dt * dt * state_.vdot;
      solver::State next = state_;
      machine_.mechanism->retract(state_.q, guess, next.q);
      next.t = t;
      const solver::KinematicsSummary solved = solver::solve_kinematics(*machine_.mechanism, next);
      if (!solved.solved()) return fail(solved.message);
      state_ = next;
      solver::StepSummary step;
      step.iterations = solved.iterations;
      take(observe(dt, step));
      if (ends_early()) return;
    }
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
    const solver::Linearisation linear = solver::linearise(*machine_.mechanism, state_, last_dt_);
    solver::Modes found;
    if (linear.trouble.empty()) found = solver::find_modes(linear);
    const std::string& trouble = linear.trouble.empty() ? found.message : linear.trouble;
    if (!trouble.empty()) return fail("modes: " + trouble);
    recorder_.write_modes(state_, found);
    if (!found.stable) summary_.message = "unstable: a small motion grows (negative damping ratio)";
  }

  void march() {
    const model::Simulation& plan = model_.simulation;
    const int intervals = std::max(1, static_cast<int>(std::ceil(plan.duration / plan.step - 1e-9)));
    for (int& k = instant_; k < intervals;) {
      ++k;
      const double target = k == intervals ? plan.start + plan.duration : plan.start + k * plan.step;
      if (!advance_to(target) || ends_early()) return;
    }
  }

  // Whether the run ends here, asked to or settled. Here it can go on later: nothing of a step is pending.
  bool ends_early() {
    const bool stops = options_.stop && options_.stop->load();
    if (stops || checkpoints_.is_due(state_.t)) write_checkpoint();
    if (stops) {
      summary_.status = Status::stopped;
      summary_.message = fmt::format("stopped on request at t = {:.6g} s", state_.t);
      return true;
    }
    if (settled_) summary_.message = fmt::format("settled at t = {:.6g} s", state_.t);
    return settled_ || repeats_;
  }

  // The instants that steps of controlled error have to hit, and the first such step. At the start of the run.
  void plan_steps(const mbd::Observation& start) {
    const auto& limits = model_.simulation.error_control;
    if (!limits) return;
    bends_ = kinks(model_, machine_.mechanism->spec(), start);
    targets_ = instants_to_hit(model_, bends_);
    control_.emplace(
        solver::StepControlOptions{
            .smallest = limits->smallest, .largest = limits->largest, .unit = unit_of_steps(targets_)},
        first_step(*machine_.mechanism, state_, *limits));
  }

  // From one instant that has to be hit to the next.
  void march_controlled(const model::ErrorControl& limits) {
    for (int& i = instant_; i < static_cast<int>(targets_.size()); ++i) {
      const double target = targets_[static_cast<std::size_t>(i)];
      while (target - state_.t > 1e-12 * std::max(std::abs(target), limits.largest)) {
        if (!take_controlled_step(limits, *control_, target)) return;
        if (ends_early()) return;
      }
      if (std::binary_search(bends_.begin(), bends_.end(), target)) start_afresh();
    }
  }

  // Bodies with a displacement of every node factorise a matrix for every step size: few of them then, parts of the
  // interval between the instants to hit.
  [[nodiscard]] double unit_of_steps(const std::vector<double>& targets) const {
    const auto is_nodal = [](const model::Body& body) { return body.flexible && body.flexible->nodal; };
    if (std::none_of(model_.bodies.begin(), model_.bodies.end(), is_nodal)) return 0;
    return targets.front() - model_.simulation.start;
  }

  // Beyond a kink of a drive's speed its acceleration is another one: the method's history would ring on it.
  void start_afresh() {
    if (!solver::solve_accelerations(*machine_.mechanism, state_, last_dt_)) return;
    integrator_.reset();
  }

  bool take_controlled_step(const model::ErrorControl& limits, solver::StepControl& control, double target) {
    double error = 0;
    const auto judge = [&](const solver::State& end, const Eigen::VectorXd& estimate) {
      error = step_error_.measure(end, estimate) / limits.tolerance;
      return error <= 1;
    };
    for (;;) {
      const double dt = control.proposed(target - state_.t);
      const bool hits = dt == target - state_.t;
      const solver::StepSummary step = integrator_.step(*machine_.mechanism, state_, dt, judge);
      if (step.converged()) {
        if (hits) state_.t = target;  // exactly, not as a sum of steps
        control.accepted(dt, error);
        last_dt_ = dt;
        take(observe(dt, step, error));
        return true;
      }
      ++summary_.rejected_steps;
      const bool inaccurate = step.status == solver::StepStatus::inaccurate;
      if (inaccurate ? control.rejected(dt, error) : control.failed(dt)) continue;
      fail(fmt::format("t = {:.6g} s: {} with the smallest step, {:.2g} s: {}", state_.t,
                       inaccurate ? "the tolerance is exceeded" : "no convergence", dt,
                       inaccurate
                           ? fmt::format("the error of {} is {:.2g} times the tolerance", step_error_.worst(), error)
                           : step.message));
      return false;
    }
  }

  // Steps to `target`, with halves of the step that is left wherever Newton does not converge.
  bool advance_to(double target) {
    double dt = target - state_.t;
    while (target - state_.t > 1e-12 * model_.simulation.step) {
      dt = std::min(dt, target - state_.t);
      const solver::StepSummary step = integrator_.step(*machine_.mechanism, state_, dt);
      if (step.converged()) {
        last_dt_ = dt;
        take(observe(dt, step));
        dt *= 2;
        continue;
      }
      ++summary_.rejected_steps;
      dt /= 2;
      if (dt < model_.simulation.smallest_step) {
        fail(fmt::format("t = {:.6g} s: no convergence with a step of {:.2g} s: {}", state_.t, 2 * dt, step.message));
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] StepRecord observe(double dt, const solver::StepSummary& step, double error = 0) {
    const Stopwatch watch(work_.recording());
    StepRecord record = observe_step(machine_, state_, kinds_);
    record.error = error;
    record.rejected_steps = summary_.rejected_steps;
    record.dt = dt;
    record.newton_iterations = step.iterations;
    record.newton_residual = step.residual;
    return record;
  }

  void take(const StepRecord& step) {
    const Stopwatch watch(work_.recording());
    work_.take(step);
    if (step.dt > 0) ++summary_.steps;
    summary_.worst_constraint_drift = std::max(summary_.worst_constraint_drift, step.constraint_drift);
    summary_.newton_iterations += step.newton_iterations;
    double moft = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < extremes_.size(); ++i) {
      extremes_[i].take(state_.t, step.dt, model_.bearings[i].film.c, step.bearings[i]);
      moft = std::min(moft, extremes_[i].summary().moft);
    }
    largest_power_ = std::max(largest_power_, step.power.largest());
    largest_error_ = std::max(largest_error_, std::abs(step.power.error()));
    settled_ = settling_.settled(step);
    recorder_.gather(step);
    if (cycles_.ends(state_.t)) end_cycle();
    write(step);
    report_progress(step, moft);
  }

  void end_cycle() {
    const CycleChange change = cycles_.take(recorder_.close_cycle());
    recorder_.write_cycle(state_.t, change.value);
    summary_.cycles = change.number;
    summary_.cycle_change = change.value;
    if (options_.on_cycle) options_.on_cycle({change.number, change.value, change.largest});
    repeats_ = cycles_.converged(change);
    if (repeats_)
      summary_.message =
          fmt::format("converged in cycle {}: {:.2g} % ({})", change.number, 100 * change.value, change.largest);
  }

  // At the end of a run whose cycles were to repeat.
  void tell_unconverged() {
    const auto& plan = model_.simulation.cycle;
    if (!plan || plan->tolerance == 0 || repeats_ || settled_ || summary_.status != Status::completed) return;
    summary_.message = summary_.cycles < 2 ? "fewer than two cycles, of which none can repeat"
                                           : fmt::format("not converged after {} cycles: {:.2g} %", summary_.cycles,
                                                         100 * summary_.cycle_change);
  }

  void write(const StepRecord& step) {
    const double slack = 1e-9 * model_.simulation.step;
    deformed_.write(state_.t, state_.t - model_.simulation.start, slack, step);
    if (is_row_due(slack)) recorder_.write_row(step);
    if (state_.t >= next_fields_ - slack || settled_ || repeats_) {
      recorder_.write_fields(step);
      next_fields_ =
          (next_fields_ < state_.t - model_.output.fields_every ? state_.t
                                                                : std::max(next_fields_, model_.simulation.start)) +
          model_.output.fields_every;
    }
    recorder_.flush_if_due();
  }

  // Rows by steps, or at the multiples of an interval and at the end of the run.
  [[nodiscard]] bool is_row_due(double slack) {
    const model::Output& output = model_.output;
    if (output.interval <= 0) return summary_.steps % output.every == 0;
    const double t = state_.t - model_.simulation.start;
    const bool is_due = t >= next_row_ * output.interval - slack;
    if (is_due) next_row_ = std::floor((t + slack) / output.interval) + 1;
    return is_due || settled_ || repeats_ || t >= model_.simulation.duration - slack;
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
      const Archive::Group group(archive, "integrator");
      integrator_.persist(archive);
    }
    {
      const Archive::Group group(archive, "steps");
      archive.io("reached", instant_), archive.io("length", last_dt_);
      if (control_) control_->persist(archive);
    }
    const Archive::Group group(archive, "record");
    persist_record(archive);
  }

  void persist_record(Archive& archive) {
    archive.io("steps", summary_.steps), archive.io("rejected_steps", summary_.rejected_steps);
    archive.io("newton_iterations", summary_.newton_iterations);
    archive.io("worst_constraint_drift", summary_.worst_constraint_drift);
    archive.io("largest_power", largest_power_), archive.io("largest_error", largest_error_);
    archive.io("next_fields", next_fields_), archive.io("next_row", next_row_);
    double wall_time = elapsed();
    archive.io("wall_time", wall_time);
    if (archive.restores()) before_ = wall_time;
    for (BearingExtremes& extremes : extremes_) {
      const Archive::Group group(archive, "extremes of " + extremes.name());
      extremes.persist(archive);
    }
    {
      const Archive::Group work(archive, "work");
      work_.persist(archive);
    }
    settling_.persist(archive);
    archive.io("cycles_ended", summary_.cycles), archive.io("cycle_change", summary_.cycle_change);
    {
      const Archive::Group cycle(archive, "cycle");
      cycles_.persist(archive);
    }
    {
      const Archive::Group meshes(archive, "deformed_meshes");
      deformed_.persist(archive);
    }
    recorder_.persist(archive, options_.results);
  }

  void write_checkpoint() {
    const Stopwatch watch(work_.recording());
    Archive archive;
    save_identity(archive, model_);
    persist(archive);
    results::write_checkpoint(checkpoint_file(options_.results), archive.content());
    checkpoints_.written(state_.t);
  }

  void restore(Archive::Content checkpoint) {
    plan_steps(observe(0, {}).mechanism);
    Archive archive(std::move(checkpoint));
    const std::filesystem::path file = checkpoint_file(options_.results);
    try {
      persist(archive);
    } catch (const ArchiveError& error) {
      throw results::ReadError(file, std::string("it does not fit this program: ") + error.what());
    }
    for (const std::string& name : archive.unread())
      if (!is_identity(name)) throw results::ReadError(file, "it does not fit this program: it holds '" + name + "'");
    checkpoints_.written(state_.t);
    resumes_ = true;
  }

  void report_progress(const StepRecord& step, double moft) const {
    if (!options_.on_progress) return;
    const model::Simulation& plan = model_.simulation;
    options_.on_progress({.t = state_.t,
                          .t_start = plan.start,
                          .t_end = plan.start + plan.duration,
                          .dt = step.dt,
                          .newton_iterations = step.newton_iterations,
                          .moft = moft,
                          .elapsed = elapsed()});
  }

  void fail(std::string message) {
    summary_.status = Status::failed;
    summary_.message = std::move(message);
  }

  void finish(results::Status status) {
    summary_.work = work_.work();
    try {
      recorder_.finish(status, summary_.message, elapsed(), summary_.work, summary_.steps);
    } catch (const results::WriteError& error) {
      fail(error.what());
    }
  }

  [[nodiscard]] double elapsed() const {
    return before_ + std::chrono::duration<double>(Clock::now() - began_).count();
  }

  const model::Model& model_;
  const Options& options_;
  Clock::time_point began_;
  model::Machine machine_;
  solver::State state_;
  solver::GeneralizedAlpha integrator_;
  WorkRecord work_;
  StepError step_error_;
  Recorder recorder_;
  DeformedMeshes deformed_;
  SettlingTest settling_;
  CycleConvergence cycles_;
  CheckpointSchedule checkpoints_;
  std::vector<BearingExtremes> extremes_;
  std::vector<ForceKind> kinds_;
  std::vector<double> bends_, targets_;         // under error control
  std::optional<solver::StepControl> control_;  // the same
  int instant_ = 0;                             // how many of the instants to hit have been reached
  bool resumes_ = false;
  double before_ = 0;  // computing time before the run was resumed [s]
  double next_fields_ = -std::numeric_limits<double>::infinity();
  double last_dt_ = 0;
  double next_row_ = 0;  // in intervals
  double largest_power_ = 0, largest_error_ = 0;
  bool settled_ = false, repeats_ = false;
  Summary summary_;
};

Summary resume(const model::Model& model, const Options& options) {
  Summary summary;
  const bool begun = has_results(options.results);
  if (begun && is_complete(model, options.results)) {
    summary.results = options.results;
    summary.t_end = summary.t_results = last_time(options.results);
    summary.message = "it was complete already";
    return summary;
  }
  const std::filesystem::path file = checkpoint_file(options.results);
  if (!begun || !std::filesystem::exists(file)) {
    Options anew = options;
    anew.overwrite = true;
    anew.resume = false;
    summary = simulate(model, anew);
    summary.warning = "there was no checkpoint to go on from: the run began anew";
    return summary;
  }
  Archive::Content checkpoint = results::read_checkpoint(file);
  std::string warning;
  require_identity(checkpoint, model, file, warning);
  try {
    summary = Simulation(model, options, std::move(checkpoint)).run();
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(unfinished_file(options.results), ignored);
    throw;
  }
  summary.warning = warning;
  return summary;
}

}  // namespace

std::vector<Fault> check(const model::Model& model) {
  if (model.is_of_bearings_alone()) return {};
  model::Machine machine = model::build(model);
  (void)starting_state(model, machine);
  std::vector<Fault> warnings = redundancy_warnings(model, *machine.mechanism);
  for (Fault& warning : offset_warnings(model)) warnings.push_back(std::move(warning));
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
  return Simulation(model, options, std::nullopt).run();
}

}  // namespace hersey::run
