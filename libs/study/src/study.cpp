#include "hersey/study/study.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "hersey/core/error_text.h"
#include "hersey/core/task_pool.h"
#include "hersey/model/read.h"

namespace hersey::study {
namespace {

// Work shared by the threads: the next run, and one lock for everything that talks to the caller.
struct Queue {
  std::atomic<std::size_t> next{0};
  std::mutex speak;
  std::atomic<int> computing{0};
};

/// A run while it computes: until it ends, or has noticed the stop.
class Computing {
 public:
  Computing(Queue& queue, const Options& options) : queue_(queue), options_(options) { ++queue_.computing; }
  Computing(const Computing&) = delete;
  Computing& operator=(const Computing&) = delete;
  ~Computing() { end(); }

  void end() {
    const bool was = std::exchange(computes_, false);
    if (was && --queue_.computing == 0 && options_.stop != nullptr && *options_.stop && options_.on_stopping)
      options_.on_stopping();
  }

 private:
  Queue& queue_;
  const Options& options_;
  bool computes_ = true;
};

RunResult simulate_one(const ModelReader& read, const model::StudyRun& run, const Options& options, std::size_t index,
                       Queue& queue) {
  RunResult result;
  result.run = run;
  Computing computing(queue, options);
  if (options.stop != nullptr && *options.stop) {
    result.status = RunEnding::not_begun;
    result.message = "stopped on request before it began";
    return result;
  }
  run::Options run_options;
  run_options.results = results_file(options, run);
  run_options.overwrite = options.overwrite;
  run_options.resume = options.resume;
  run_options.step_error = options.step_error;
  run_options.stop = options.stop;
  run_options.on_stopping = [&computing] { computing.end(); };
  for (const model::StudyValue& value : run.values) run_options.study_parameters.push_back({value.name, value.text});
  run_options.on_progress = [&](const run::Progress& progress) {
    if (!options.on_progress) return;
    const std::scoped_lock lock(queue.speak);
    options.on_progress(index, progress);
  };
  try {
    const model::Model model = read(run.overrides);
    if (options.on_warnings) {
      const std::vector<Fault> warnings = run::warnings_of(model);
      const std::scoped_lock lock(queue.speak);
      options.on_warnings(index, warnings);
    }
    result.summary = run::simulate(model, run_options);
    result.status = RunEnding::solved;
  } catch (const std::exception& error) {
    result.fail(error_text(error));
  }
  return result;
}

}  // namespace

std::filesystem::path results_file(const Options& options, const model::StudyRun& run) {
  return options.directory / (run.slug + ".h5");
}

std::vector<RunResult> simulate_all(const ModelReader& read, const std::vector<model::StudyRun>& runs,
                                    const Options& options) {
  std::vector<RunResult> results(runs.size());
  Queue queue;
  const auto work = [&] {
    const TaskPool::OwnThread one(TaskPool::shared());
    for (std::size_t i = queue.next++; i < runs.size(); i = queue.next++) {
      results[i] = simulate_one(read, runs[i], options, i, queue);
      const std::scoped_lock lock(queue.speak);
      if (options.on_finished) options.on_finished(i, results[i]);
    }
  };
  const auto wanted = static_cast<std::size_t>(options.threads > 0 ? options.threads : TaskPool::shared().threads());
  std::vector<std::jthread> threads;
  for (std::size_t i = 1; i < std::min(std::max<std::size_t>(wanted, 1), runs.size()); ++i) threads.emplace_back(work);
  work();
  threads.clear();
  return results;
}

std::vector<RunResult> simulate_all(const std::string& path, const std::vector<model::StudyRun>& runs,
                                    const Options& options) {
  return simulate_all([&](const std::vector<std::string>& overrides) { return model::read(path, overrides); }, runs,
                      options);
}

}  // namespace hersey::study
