#pragma once

#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hersey/core/archive.h"
#include "hersey/core/outcome.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/run/options.h"
#include "hersey/run/summary.h"
#include "hersey/solver/equations.h"
#include "hersey/solver/linearise.h"
#include "observation/power_balance.h"
#include "record/run_record.h"
#include "series/work_record.h"
#include "time_stepping/checkpoint.h"
#include "time_stepping/fmu_exchange.h"
#include "time_stepping/fmu_inputs.h"
#include "time_stepping/motion.h"
#include "time_stepping/periodic_start.h"
#include "time_stepping/time_stepper.h"

namespace hersey::run {

/// Integrates a machine over time: owns the machine, its state and its record. A whole run and a program that changes
/// inputs between the steps take the same steps.
class MachineRun {
 public:
  /// @param model, options  outlive this; without options.results nothing is written
  /// @param checkpoint  state from which an interrupted run continues; none: the run starts at its beginning
  /// @throws InputError where an FMU of the model cannot be started, or is given what is not there
  /// @param start  of a run that is not resumed; without cycles: that of the model
  MachineRun(const model::Model& model, const Options& options, std::optional<Archive::Content> checkpoint = {},
             PeriodicStart start = {});

  /// Chooses the steps and records the start; a resumed run has done so before. To be called before the first step.
  void begin();

  [[nodiscard]] bool is_at_end() const { return stepper_.is_at_end() || record_.ends_run(); }
  /// Message of a run that ended normally; may be empty.
  [[nodiscard]] std::string ending() const;
  /// Message about gear meshes whose teeth would have parted; empty if there are none.
  [[nodiscard]] std::string parted_teeth() const { return record_.parted_teeth(); }
  /// What FMUs have warned of; empty if there is nothing.
  [[nodiscard]] std::string fmu_warnings() const { return exchange_ ? exchange_->warnings() : std::string(); }

  /// Takes one accepted step, at most to `limit` [s].
  /// @returns unsolved, with the reason why there is no step, or why none can follow it
  /// @pre begun, not at the end, state().t < limit
  [[nodiscard]] Outcome step(double limit = std::numeric_limits<double>::infinity());

  /// Restarts the integrator after a jump of what acts on the machine: TimeStepper::take_jump.
  void take_jump(bool moves);
  /// Returns the motion at the end of the last step.
  [[nodiscard]] Motion motion();
  /// Goes on in `motion`, of this machine at the same instant of another period, in place of its own. Joints keep the
  /// whole revolutions that they have made.
  void move_to(const Motion& motion);

  /// True: steps are solved down to round-off.
  void solve_to_round_off(bool is_on) { stepper_.solve_to_round_off(is_on); }
  /// Distance below which two instants count as one [s].
  [[nodiscard]] double slack() const { return stepper_.slack(); }

  [[nodiscard]] solver::State& state() { return state_; }
  [[nodiscard]] const solver::State& state() const { return state_; }
  [[nodiscard]] mbd::Mechanism& mechanism() { return *machine_.mechanism; }
  [[nodiscard]] model::Machine& machine() { return machine_; }
  [[nodiscard]] double last_dt() const { return stepper_.last_dt(); }

  /// Records the state without a step.
  void record_here() { record(TimeStep{}); }
  void write_modes(const solver::Modes& found) { record_.write_modes(state_, found); }
  /// The last record, and the energies since the start.
  [[nodiscard]] const StepRecord& last_step() const { return last_step_; }
  [[nodiscard]] const EnergySummary& energy() const { return record_.energy(); }

  /// Writes a checkpoint beside the results if one is due, or in any case; none where the lead-in was stopped, so that
  /// the run begins anew with it, and none with FMUs that cannot save their state.
  void write_checkpoint(bool in_any_case);

  /// Closes the results.
  /// @returns unsolved, with the reason, if that failed
  /// @param coarse  summary of the run with steps twice as long; null if no step error is requested
  [[nodiscard]] Outcome finish(Status status, const std::string& message, const Summary* coarse);

  /// Time of the row last passed to the results [s]; none since the run was begun or resumed.
  [[nodiscard]] std::optional<double> last_row() const { return record_.last_row(); }

  /// The figures of all steps so far.
  [[nodiscard]] Summary summary() const;

  /// Stores or restores everything on which the rest of the run depends.
  void persist(Archive& archive);
  /// Continues from a stored state.
  /// @throws ArchiveError if it belongs to another machine or program
  void restore(Archive& archive);

 private:
  using Clock = std::chrono::steady_clock;
  struct Cost {
    double wall_time = 0;  // [s]
    Work work;
  };

  void restore_file(Archive::Content checkpoint);
  void persist_motion(Archive& archive);
  void place_surfaces();
  [[nodiscard]] StepRecord observe(const TimeStep& step);
  void begin_exchange(StepRecord& start);
  [[nodiscard]] Outcome exchange_signals();
  void record(const TimeStep& step);
  void record(StepRecord step);
  void report_progress(const StepRecord& step) const;
  [[nodiscard]] double elapsed() const;
  [[nodiscard]] Cost cost() const { return {elapsed(), work_.work()}; }

  std::unique_ptr<FmuExchange> exchange_;  ///< null: the model has no FMUs
  const model::Model& model_;              ///< the given one, or that of the exchange
  const Options& options_;
  Clock::time_point began_;
  model::Machine machine_;
  solver::State state_;
  PeriodicStart start_;
  std::vector<ForceKind> kinds_;
  TimeStepper stepper_;
  WorkRecord work_;
  RunRecord record_;
  CheckpointSchedule checkpoints_;
  StepRecord last_step_;
  std::optional<FmuInputs> fmu_inputs_;
  bool resumes_ = false;
  std::optional<Cost> cost_;  // the cost with which the results were closed; the summary reports the same
  double before_ = 0;         // computing time before the run was resumed [s]
};

}  // namespace hersey::run
