#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cycle/cycle_maps.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/results/writer.h"
#include "hersey/run/options.h"
#include "hersey/run/summary.h"
#include "hersey/solver/linearise.h"
#include "record/beam_record.h"
#include "record/bearing_record.h"
#include "record/body_record.h"
#include "record/contact_record.h"
#include "record/effort_record.h"
#include "record/flexible_record.h"
#include "record/joint_record.h"
#include "record/mode_record.h"
#include "record/power_balance.h"
#include "record/step_record.h"
#include "record/surface_load_record.h"
#include "record/system_record.h"
#include "record/thermal_record.h"

namespace hersey::run {

/// Where the results of a resumed run are gathered until they hold all that the interrupted one had.
[[nodiscard]] std::filesystem::path unfinished_file(const std::filesystem::path& results);

/// Puts steps into the results file (layout: docs/results-file.md), each kind of thing by a record of its own.
class Recorder {
 public:
  /// @param start    what the run starts from, to tell where that is not what the model gives
  /// @param resumes  the file is written under another name, to take the place of `options.results` in `persist`
  /// @param options  without options.results no file is written: `latest` tells what would be
  /// @throws results::FileExists, results::WriteError.
  Recorder(const model::Model& model, const model::Machine& machine, const solver::State& start, const Options& options,
           bool resumes = false);

  /// @param energy  since the start of the run
  void write_row(const StepRecord& step, const EnergySummary& energy);
  void write_fields(const StepRecord& step);
  /// What the bearings' maps and losses over a cycle are made of: every accepted step.
  void gather(const StepRecord& step) { cycle_maps_->take(step.mechanism.t, step.bearings); }
  /// A cycle of the machine ends with the step last gathered.
  std::vector<BearingCycle> close_cycle() { return cycle_maps_->close(); }
  /// Small motions about `state`.
  void write_modes(const solver::State& state, const solver::Modes& found) { modes_->append(state, found); }
  void flush_if_due() { writer_.flush_if_due(); }
  void flush() { writer_.flush(); }
  /// Without a results file: what was written last.
  [[nodiscard]] const std::vector<results::LatestRow>& latest() const { return writer_.latest(); }
  /// How many rows there are; restoring takes so many from the results of the run that was interrupted.
  /// @throws results::ReadError where these have fewer
  void persist(Archive& archive, const std::filesystem::path& results);
  /// How far the cycle that ended at `t` repeats the one before: CycleChange::value.
  void write_cycle(double t, double change) const { cycles_->append(t, change); }
  /// Makes room for what `finish` writes, so that it changes nothing of the file's structure: a program killed then
  /// leaves a file that can be read. Before the first row.
  /// @param work  of no steps yet
  void declare_cost(const Work& work);
  void write_step_errors(const std::string& bearing, const StepErrors& errors);
  void finish(results::Status status, const std::string& message, double wall_time, const Work& work, int steps);

 private:
  void declare();

  const model::Model& model_;
  const model::Machine& machine_;
  results::Writer writer_;
  std::vector<std::size_t> shown_bodies_, shown_joints_;  ///< of the mechanism: all but the inner nodes of beams
  std::optional<SystemRecord> system_;
  std::vector<BodyRecord> bodies_;
  std::vector<JointRecord> joints_;
  std::optional<EffortRecord> efforts_;
  std::vector<FlexibleRecord> flexibles_;
  std::optional<SurfaceLoadRecord> surface_loads_;
  std::vector<BeamRecord> beams_;
  std::vector<ContactRecord> contacts_;
  std::vector<BearingRecord> bearings_;
  std::optional<ThermalRecord> thermal_;
  std::optional<CycleMaps> cycle_maps_;
  std::optional<CycleRecord> cycles_;
  std::optional<ModeRecord> modes_;
};

}  // namespace hersey::run
