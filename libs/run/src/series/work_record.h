#pragma once

#include <chrono>
#include <vector>

#include "hersey/core/archive.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/run/work.h"
#include "hersey/solver/integrator.h"
#include "observation/step_record.h"
#include "table/quantity.h"

namespace hersey::run {

/// Frequencies of a count per step.
class StepCounts {
 public:
  void take(int count);
  [[nodiscard]] PerStep per_step() const;
  /// Number of steps with a count of zero.
  [[nodiscard]] int without() const { return times_.empty() ? 0 : times_.front(); }
  void persist(Archive& archive, const char* name) { archive.io(name, times_); }

 private:
  std::vector<int> times_;  ///< entry k: steps that took k
};

/// Measures the cost of the steps of a run.
class WorkRecord {
 public:
  WorkRecord(const model::Model& model, const model::Machine& machine, const solver::Integrator& integrator);

  /// The machine is at its start: from here on the run steps.
  void begin();
  /// An accepted step.
  void take(const StepRecord& step);
  /// Time of observing steps and writing them down is to be added here [s].
  [[nodiscard]] double& recording() { return recording_; }
  /// Time of exchanges with FMUs, and of their steps, likewise [s].
  [[nodiscard]] double& fmus() { return fmus_; }
  [[nodiscard]] Work work() const;
  void persist(Archive& archive);

 private:
  using Clock = std::chrono::steady_clock;

  /// Time spent since the program began, in the order of Work::parts.
  [[nodiscard]] std::vector<double> spent() const;
  [[nodiscard]] std::vector<FilmCost> films() const;
  [[nodiscard]] double start_up() const;
  [[nodiscard]] std::vector<double> stepping() const;  ///< the same since `begin`, and before an interruption

  const model::Model& model_;
  const model::Machine& machine_;
  const solver::Integrator& integrator_;
  Clock::time_point made_, began_;
  bool is_begun_ = false;
  double recording_ = 0, fmus_ = 0;
  double start_up_before_ = 0;                         ///< of the parts of a resumed run
  std::vector<double> spent_at_begin_, spent_before_;  ///< the latter: of the parts of a resumed run
  std::vector<FilmCost> films_before_;                 ///< of a resumed run
  StepCounts newton_iterations_;
  std::vector<StepCounts> film_iterations_, exchanges_;
};

/// Writes the cost of the run to the results file, as attributes, because computing times differ from run to run.
/// @param wall_time  of the whole run [s]
void write_work(const Work& work, double wall_time, int steps, results::Writer& writer);

[[nodiscard]] std::vector<QuantityGroup> describe_work();

}  // namespace hersey::run
