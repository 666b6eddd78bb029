#include "hersey/run/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>

#include "extremes.h"
#include "hersey/core/input_error.h"
#include "hersey/model/build.h"
#include "hersey/results/reader.h"
#include "hersey/results/writer.h"
#include "hersey/solver/generalized_alpha.h"
#include "recorder.h"
#include "start.h"

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

// Says whether every journal is where it was `over` ago.
class SettlingTest {
 public:
  explicit SettlingTest(const model::Model& model) : model_(model) {}

  [[nodiscard]] bool settled(const StepRecord& step) {
    const std::optional<model::Settle>& settle = model_.simulation.settle;
    if (!settle || step.bearings.empty()) return false;
    const double t = step.mechanism.t;
    if (!next_ || t >= *next_) {
      const bool repeats = !last_.empty() && change(step) <= settle->tolerance;
      last_ = step.bearings;
      next_ = t + settle->over * (1 - 1e-9);
      return repeats;
    }
    return false;
  }

 private:
  [[nodiscard]] double change(const StepRecord& step) const {
    double largest = 0;
    for (std::size_t i = 0; i < last_.size(); ++i) {
      largest = std::max(largest, (step.bearings[i].e - last_[i].e).norm() / model_.bearings[i].film.c);
    }
    return largest;
  }

  const model::Model& model_;
  std::vector<bearing::BearingObservation> last_;
  std::optional<double> next_;
};

// One simulation: owns the machine, its state and its record.
class Simulation {
 public:
  Simulation(const model::Model& model, const Options& options)
      : model_(model),
        options_(options),
        began_(Clock::now()),
        machine_(model::build(model)),
        state_(starting_state(model, machine_)),
        integrator_(integrator_options(model)),
        recorder_(model, machine_, options),
        settling_(model) {
    is_bearing_.resize(machine_.mechanism->spec().forces.size(), false);
    for (const model::BuiltBearing& bearing : machine_.bearings) {
      is_bearing_[static_cast<std::size_t>(bearing.force.index)] = true;
      extremes_.emplace_back(bearing.bearing->name());
    }
    summary_.results = options.results;
  }

  Summary run() {
    try {
      take(observe(0, {}));
      march();
      finish(summary_.status == Status::completed ? results::Status::completed
             : summary_.status == Status::stopped ? results::Status::stopped
                                                  : results::Status::failed);
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
  void march() {
    const model::Simulation& plan = model_.simulation;
    const int intervals = std::max(1, static_cast<int>(std::ceil(plan.duration / plan.step - 1e-9)));
    for (int k = 1; k <= intervals; ++k) {
      const double target = k == intervals ? plan.start + plan.duration : plan.start + k * plan.step;
      if (!advance_to(target)) return;
      if (options_.stop && options_.stop->load()) {
        summary_.status = Status::stopped;
        summary_.message = fmt::format("stopped on request at t = {:.6g} s", state_.t);
        return;
      }
      if (settled_) {
        summary_.message = fmt::format("settled at t = {:.6g} s", state_.t);
        return;
      }
    }
  }

  // Steps to `target`, with halves of the step that is left wherever Newton does not converge.
  bool advance_to(double target) {
    double dt = target - state_.t;
    while (target - state_.t > 1e-12 * model_.simulation.step) {
      dt = std::min(dt, target - state_.t);
      const solver::StepSummary step = integrator_.step(*machine_.mechanism, state_, dt);
      if (step.converged()) {
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

  [[nodiscard]] StepRecord observe(double dt, const solver::StepSummary& step) {
    StepRecord record;
    record.dt = dt;
    record.newton_iterations = step.iterations;
    record.newton_residual = step.residual;
    record.mechanism = machine_.mechanism->observe(state_);
    for (const model::BuiltBearing& bearing : machine_.bearings) {
      record.journal_motions.push_back(machine_.mechanism->relative_motion(state_, bearing.force));
      record.bearings.push_back(bearing.bearing->observe(record.journal_motions.back()));
    }
    record.power = power_balance(machine_.mechanism->spec(), record.mechanism, is_bearing_);
    return record;
  }

  void take(const StepRecord& step) {
    if (step.dt > 0) ++summary_.steps;
    summary_.newton_iterations += step.newton_iterations;
    double moft = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < extremes_.size(); ++i) {
      extremes_[i].take(state_.t, step.dt, model_.bearings[i].film.c, step.bearings[i]);
      moft = std::min(moft, extremes_[i].summary().moft);
    }
    largest_power_ = std::max(largest_power_, step.power.largest());
    largest_error_ = std::max(largest_error_, std::abs(step.power.error()));
    settled_ = settling_.settled(step);
    write(step);
    report_progress(step, moft);
  }

  void write(const StepRecord& step) {
    const double slack = 1e-9 * model_.simulation.step;
    if (summary_.steps % model_.output.every == 0) recorder_.write_row(step);
    if (state_.t >= next_fields_ - slack || settled_) {
      recorder_.write_fields(step);
      next_fields_ =
          (next_fields_ < state_.t - model_.output.fields_every ? state_.t
                                                                : std::max(next_fields_, model_.simulation.start)) +
          model_.output.fields_every;
    }
    recorder_.flush_if_due();
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
    try {
      recorder_.finish(status, summary_.message, elapsed());
    } catch (const results::WriteError& error) {
      fail(error.what());
    }
  }

  [[nodiscard]] double elapsed() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

  const model::Model& model_;
  const Options& options_;
  Clock::time_point began_;
  model::Machine machine_;
  solver::State state_;
  solver::GeneralizedAlpha integrator_;
  Recorder recorder_;
  SettlingTest settling_;
  std::vector<BearingExtremes> extremes_;
  std::vector<bool> is_bearing_;
  double next_fields_ = -std::numeric_limits<double>::infinity();
  double largest_power_ = 0, largest_error_ = 0;
  bool settled_ = false;
  Summary summary_;
};

}  // namespace

void check(const model::Model& model) {
  if (model.is_of_bearings_alone()) return;
  model::Machine machine = model::build(model);
  (void)starting_state(model, machine);
}

Summary simulate(const model::Model& model, const Options& options) {
  if (model.is_of_bearings_alone()) {
    throw InputError(Fault{{model.file, 0, 0},
                           "",
                           "bearings alone",
                           "bodies and a simulation to run",
                           "'hersey bearing' solves bearings by themselves"});
  }
  return Simulation(model, options).run();
}

}  // namespace hersey::run
