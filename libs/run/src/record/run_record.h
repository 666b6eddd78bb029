#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cycle/cycle_convergence.h"
#include "cycle/settling.h"
#include "hersey/core/archive.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/run/options.h"
#include "hersey/run/summary.h"
#include "observation/energy_balance.h"
#include "observation/extremes.h"
#include "observation/parted_teeth.h"
#include "record/deformed_meshes.h"
#include "record/recorder.h"

namespace hersey::run {

/// Collects the accepted steps of a run: rows and fields in the results file, deformed meshes, cycles, extremes for the
/// summary. Detects that a run has settled or is periodic.
class RunRecord {
 public:
  /// @param start, resumes  Recorder
  /// @throws as Recorder
  RunRecord(const model::Model& model, const model::Machine& machine, const solver::State& start,
            const Options& options, bool resumes);

  /// The start of the run, then every accepted step.
  void take(const StepRecord& step);
  void declare_cost(const Work& work);
  /// Writes the rows that wait in memory to the file.
  void flush() { recorder_.flush(); }
  /// Time of the row last passed to the file [s]; none since the run was begun or resumed.
  [[nodiscard]] std::optional<double> last_row() const { return last_row_; }
  void write_multipliers(const std::vector<std::complex<double>>& found) { recorder_.write_multipliers(found); }
  void write_modes(const solver::State& state, const solver::Modes& found) { recorder_.write_modes(state, found); }
  void finish(results::Status status, const std::string& message, double wall_time, const Work& work);

  /// True if a cycle of the machine ends with the accepted step that ended at `t`.
  [[nodiscard]] bool ends_cycle(double t) const { return cycles_.ends(t); }
  /// True if nothing changes any more, or cycles repeat each other: the run ends with the step last taken.
  [[nodiscard]] bool ends_run() const { return settled_ || repeats_; }
  /// Message about this end, or about cycles that did not repeat, when the run ends at `t`; may be empty.
  [[nodiscard]] std::string ending(double t) const;

  /// Smallest film thickness so far of all bearings [m].
  [[nodiscard]] double moft() const;
  /// Message about films of smooth surfaces that almost touch, for a run that finds no further step; empty if there are
  /// none.
  [[nodiscard]] std::string thin_films() const;
  /// Message about gear meshes whose teeth would have parted; empty if there are none.
  [[nodiscard]] std::string parted_teeth() const { return parted_.warning(); }
  /// Books energies from here on as they are behind a jump: EnergyBalance::go_on_from.
  void go_on_from(const StepRecord& step) { energy_.go_on_from(step); }
  /// Energy balance since the start of the run.
  [[nodiscard]] const EnergySummary& energy() const { return energy_.sums(); }
  /// Fills in the figures of all steps taken.
  void summarise(Summary& summary) const;

  /// Writes the errors that the steps cause in each bearing's figures. To be called before finish().
  /// @param coarse  summary of the run with steps twice as long
  void write_step_errors(const Summary& coarse);

  void persist(Archive& archive);

 private:
  void end_cycle(double t);
  void take_starvation(const StepRecord& step);
  [[nodiscard]] std::vector<std::string> starvation_warnings(const model::Bearing& bearing) const;
  void write(const StepRecord& step);
  [[nodiscard]] bool is_row_due(double t, double slack);
  [[nodiscard]] bool are_fields_due(double t, double slack);

  const model::Model& model_;
  const Options& options_;
  Recorder recorder_;
  DeformedMeshes deformed_;
  SettlingTest settling_;
  CycleConvergence cycles_;
  std::vector<BearingExtremes> extremes_;
  PartedTeeth parted_;
  EnergyBalance energy_;
  Eigen::VectorXd starved_time_, lowest_fill_;  ///< of each node of the circuit [s, -]
  Eigen::VectorXd lowest_at_axis_;              ///< of each of its drillings through an axis [Pa]
  double circuit_time_ = 0;                     ///< [s]
  int steps_ = 0, newton_iterations_ = 0;
  std::vector<StepErrors> step_errors_;  ///< errors for each bearing, if requested
  double step_error_ = 0;                ///< largest of a step
  double constraint_drift_ = 0, largest_power_ = 0, largest_error_ = 0;
  CycleChange last_cycle_;
  bool settled_ = false, repeats_ = false;
  double next_fields_ = -std::numeric_limits<double>::infinity();
  double next_row_ = 0;  ///< in intervals
  std::optional<double> last_row_;
};

}  // namespace hersey::run
