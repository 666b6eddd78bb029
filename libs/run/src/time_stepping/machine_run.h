#pragma once

#include <chrono>
#include <limits>
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
#include "record/power_balance.h"
#include "record/run_record.h"
#include "record/work_record.h"
#include "time_stepping/checkpoint.h"
#include "time_stepping/time_stepper.h"

namespace hersey::run {

/// A machine on its way through time: owns it, its state and its record. Whoever steps it, a whole run or a program
/// that changes inputs between the steps, takes the same steps.
class MachineRun {
 public:
  /// @param model, options  outlive this; without options.results nothing is written
  /// @param checkpoint  where an interrupted run goes on; none: from the start
  MachineRun(const model::Model& model, const Options& options, std::optional<Archive::Content> checkpoint = {});

  /// Chooses the steps and records the start; of a run that is gone on with it has been done. Before the first step.
  void begin();

  [[nodiscard]] bool is_at_end() const { return stepper_.is_at_end() || record_.ends_run(); }
  /// What to say of a run that ended in order; may be empty.
  [[nodiscard]] std::string ending() const { return record_.ending(state_.t); }

  /// One accepted step, at most to `limit` [s].
  /// @returns unsolved, why there is none, or why none can follow it
  /// @pre begun, not at the end, state().t < limit
  [[nodiscard]] Outcome step(double limit = std::numeric_limits<double>::infinity());

  /// What acts has jumped: TimeStepper::take_jump.
  void take_jump(bool moves) { stepper_.take_jump(state_, moves); }
  /// How close two instants are that count as one [s].
  [[nodiscard]] double slack() const { return stepper_.slack(); }

  [[nodiscard]] solver::State& state() { return state_; }
  [[nodiscard]] const solver::State& state() const { return state_; }
  [[nodiscard]] mbd::Mechanism& mechanism() { return *machine_.mechanism; }
  [[nodiscard]] model::Machine& machine() { return machine_; }
  [[nodiscard]] double last_dt() const { return stepper_.last_dt(); }

  /// Records the state as it is, of no step.
  void record_here() { record(TimeStep{}); }
  void write_modes(const solver::Modes& found) { record_.write_modes(state_, found); }
  /// What was recorded last, and the energies since the start.
  [[nodiscard]] const StepRecord& last_step() const { return last_step_; }
  [[nodiscard]] const EnergySummary& energy() const { return record_.energy(); }

  /// Writes a checkpoint beside the results where one is due, or in any case.
  void write_checkpoint(bool in_any_case);

  /// Closes the results. @returns unsolved, why that failed
  /// @param coarse  summary of the run with steps twice as long; null where no step error is asked for
  [[nodiscard]] Outcome finish(Status status, const std::string& message, const Summary* coarse);

  /// Time of the row that was handed to the results last [s]; none since the run was begun or resumed.
  [[nodiscard]] std::optional<double> last_row() const { return record_.last_row(); }

  /// The figures of all steps so far.
  [[nodiscard]] Summary summary() const;

  /// Everything that the rest of the run depends on.
  void persist(Archive& archive);
  /// Goes on from what was stored. @throws ArchiveError where that is not of this machine and program
  void restore(Archive& archive);

 private:
  using Clock = std::chrono::steady_clock;
  struct Cost {
    double wall_time = 0;  // [s]
    Work work;
  };

  void restore_file(Archive::Content checkpoint);
  [[nodiscard]] StepRecord observe(const TimeStep& step);
  void record(const TimeStep& step);
  void record(StepRecord step);
  void report_progress(const StepRecord& step) const;
  [[nodiscard]] double elapsed() const;
  [[nodiscard]] Cost cost() const { return {elapsed(), work_.work()}; }

  const model::Model& model_;
  const Options& options_;
  Clock::time_point began_;
  model::Machine machine_;
  solver::State state_;
  std::vector<ForceKind> kinds_;
  TimeStepper stepper_;
  WorkRecord work_;
  RunRecord record_;
  CheckpointSchedule checkpoints_;
  StepRecord last_step_;
  bool resumes_ = false;
  std::optional<Cost> cost_;  // as the results were closed with it: the summary tells the same
  double before_ = 0;         // computing time before the run was resumed [s]
};

}  // namespace hersey::run
