#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "hersey/model/study.h"
#include "hersey/run/simulate.h"
#include "hersey/study/model_reader.h"

namespace hersey::study {

enum class RunEnding {
  failed,     ///< it could not start or write its results
  not_begun,  ///< a stop was requested before it began
  solved,     ///< simulated; its summary gives the outcome
};

/// One run of a study. Solved, it has a summary with the run's outcome; else `summary` is empty.
struct [[nodiscard]] RunResult : OutcomeOf<RunEnding, RunEnding::solved> {
  model::StudyRun run;
  run::Summary summary;
};

struct Options {
  std::filesystem::path directory;  ///< results go to directory/<slug>.h5
  bool overwrite = false;
  bool resume = false;      ///< completed runs are left as they are, others go on where they ended
  bool step_error = false;  ///< each run once more with steps twice as long: run::Options
  int threads = 0;          ///< runs at the same time; 0: one per core
  /// Called from the run's own thread, one call at a time.
  std::function<void(std::size_t run, const run::Progress&)> on_progress;
  /// called before a run begins with the warnings of its model and its start (model::Model::warnings, run::check)
  std::function<void(std::size_t run, const std::vector<Fault>&)> on_warnings;
  std::function<void(std::size_t run, const RunResult&)> on_finished;
  const std::atomic<bool>* stop = nullptr;  ///< set from a signal handler: runs end after their step, no other begins
  std::function<void()> on_stopping;        ///< all that had begun have ended so (run::Options::on_stopping)
};

/// The results file of one run.
[[nodiscard]] std::filesystem::path results_file(const Options& options, const model::StudyRun& run);

/// Simulates every run of `runs` (model::expand_study) with the model that `read` returns, several at a time. A run
/// that fails does not stop the others.
[[nodiscard]] std::vector<RunResult> simulate_all(const ModelReader& read, const std::vector<model::StudyRun>& runs,
                                                  const Options& options);
/// Simulates the runs of the model file at `path`.
[[nodiscard]] std::vector<RunResult> simulate_all(const std::string& path, const std::vector<model::StudyRun>& runs,
                                                  const Options& options);

}  // namespace hersey::study
