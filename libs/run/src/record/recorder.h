#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cycle/cycle_maps.h"
#include "cycle/engine_friction.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/results/writer.h"
#include "hersey/run/options.h"
#include "hersey/run/summary.h"
#include "hersey/solver/linearise.h"
#include "observation/power_balance.h"
#include "observation/step_record.h"
#include "series/beam_record.h"
#include "series/bearing_record.h"
#include "series/body_record.h"
#include "series/circuit_record.h"
#include "series/contact_record.h"
#include "series/effort_record.h"
#include "series/flexible_record.h"
#include "series/fmu_record.h"
#include "series/group_record.h"
#include "series/joint_record.h"
#include "series/mesh_record.h"
#include "series/mode_record.h"
#include "series/multiplier_record.h"
#include "series/ring_record.h"
#include "series/surface_load_record.h"
#include "series/system_record.h"
#include "series/thermal_record.h"

namespace hersey::run {

/// File that gathers the results of a resumed run until it contains all results of the interrupted one.
[[nodiscard]] std::filesystem::path unfinished_file(const std::filesystem::path& results);

/// Writes steps to the results file (layout: docs/results-file.md), with one record for each kind of thing.
class Recorder {
 public:
  /// @param start    state at the start of the run, to report where it differs from the given one
  /// @param resumes  the file is written under another name, and replaces `options.results` in `persist`
  /// @param options  without options.results no file is written, and `latest` returns the rows
  /// @throws results::FileExists, results::WriteError.
  Recorder(const model::Model& model, const model::Machine& machine, const solver::State& start, const Options& options,
           bool resumes = false);

  /// @param energy  since the start of the run
  void write_row(const StepRecord& step, const EnergySummary& energy);
  void write_fields(const StepRecord& step);
  /// Adds an accepted step to the bearings' maps and losses over a cycle.
  void gather(const StepRecord& step) {
    cycle_maps_->take(step.mechanism.t, step.bearings);
    friction_sums_.take(step.mechanism);
  }
  /// A cycle of the machine ends with the step last gathered.
  std::vector<BearingCycle> close_cycle() {
    std::vector<BearingCycle> cycles = cycle_maps_->close();
    friction_ = friction_sums_.close(cycles);
    return cycles;
  }
  /// Small motions about `state`.
  void write_multipliers(const std::vector<std::complex<double>>& found) const {
    multipliers_->write(found, model_.simulation.cycle->period);
  }
  void write_modes(const solver::State& state, const solver::Modes& found) { modes_->append(state, found); }
  void flush_if_due() { writer_.flush_if_due(); }
  void flush() { writer_.flush(); }
  /// The rows written last; only without a results file.
  [[nodiscard]] const std::vector<results::LatestRow>& latest() const { return writer_.latest(); }
  /// Stores or restores the number of rows; restoring takes that many from the results of the interrupted run.
  /// @throws results::ReadError if these have fewer
  void persist(Archive& archive, const std::filesystem::path& results);
  /// Writes the difference between the cycle that ended at `t` and the one before: CycleChange::value.
  void write_cycle(double t, double change) const { cycles_->append({t, change, friction_}); }
  /// Reserves space for the data that `finish` writes, so that it does not change the structure of the file: a program
  /// killed then leaves a readable file. To be called before the first row.
  /// @param work  of zero steps
  void declare_cost(const Work& work);
  void write_step_errors(const std::string& bearing, const StepErrors& errors);
  void finish(results::Status status, const std::string& message, double wall_time, const Work& work, int steps);

 private:
  void declare();

  const model::Model& model_;
  const model::Machine& machine_;
  results::Writer writer_;
  std::vector<std::size_t> shown_bodies_, shown_joints_;  ///< bodies and joints of the mechanism: all but the inner
                                                          ///< nodes of beams
  std::optional<SystemRecord> system_;
  std::vector<BodyRecord> bodies_;
  std::vector<JointRecord> joints_;
  std::optional<EffortRecord> efforts_;
  std::vector<FmuRecord> fmus_;
  std::vector<FlexibleRecord> flexibles_;
  std::optional<SurfaceLoadRecord> surface_loads_;
  std::vector<BeamRecord> beams_;
  std::vector<ContactRecord> contacts_;
  std::vector<RingRecord> rings_;
  std::vector<MeshRecord> meshes_;
  std::vector<BearingRecord> bearings_;
  std::optional<ThermalRecord> thermal_;
  std::optional<CircuitRecord> circuit_;
  std::vector<GroupRecord> groups_;  ///< bearings of several films
  std::optional<CycleMaps> cycle_maps_;
  EngineFrictionSums friction_sums_;
  EngineFriction friction_;  ///< of the cycle last closed
  std::optional<CycleRecord> cycles_;
  std::optional<MultiplierRecord> multipliers_;
  std::optional<ModeRecord> modes_;
};

}  // namespace hersey::run
