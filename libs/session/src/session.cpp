#include "hersey/session/session.h"

#include <algorithm>
#include <utility>

#include "hersey/results/error.h"
#include "hersey/results/output_lock.h"
#include "hersey/run/checkpoint.h"
#include "hersey/run/simulate.h"
#include "hersey/session/output_file.h"

namespace hersey::session {
namespace {

using Path = std::filesystem::path;

/// Adds warnings that are new: runs of a study share most of them.
void add_new(const std::vector<Fault>& more, std::vector<Fault>& warnings) {
  for (const Fault& warning : more) {
    const bool known = std::any_of(warnings.begin(), warnings.end(),
                                   [&](const Fault& other) { return other.text() == warning.text(); });
    if (!known) warnings.push_back(warning);
  }
}

void make_folder(const Path& folder) {
  if (folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw results::WriteError(folder, "the folder cannot be made: " + error.message());
}

bool resumes(Existing existing, const Path& results) {
  if (existing == Existing::resume_or_replace) return std::filesystem::exists(run::checkpoint_file(results));
  return existing == Existing::resume;
}

bool replaces(Existing existing) { return existing == Existing::replace || existing == Existing::resume_or_replace; }

}  // namespace

std::string model_name(const std::string& file) {
  const Path path = std::filesystem::absolute(file).lexically_normal();
  const bool plain = path.stem() == "model" && !path.parent_path().filename().empty();
  return (plain ? path.parent_path().filename() : path.stem()).string();
}

Session::Session(const std::string& path, std::vector<std::string> overrides)
    : Session(model::ModelFile(path), std::move(overrides)) {}

Session::Session(std::string text, std::string file, std::vector<std::string> overrides)
    : Session(model::ModelFile(std::move(text), std::move(file)), std::move(overrides)) {}

Session::Session(model::ModelFile source, std::vector<std::string> overrides)
    : source_(std::move(source)), overrides_(std::move(overrides)), model_(source_.read(overrides_)) {}

Session Session::with(std::vector<std::string> overrides) const { return {source_, std::move(overrides)}; }

std::vector<Path> Session::files() const {
  const Path file = this->file();
  std::vector<Path> files{file};
  for (const auto& [name, digest] : model_.files) files.push_back(file.parent_path() / name);
  return files;
}

Path Session::results_folder() const { return Path("results") / model_name(file()); }

Check Session::check() const {
  Check found;
  std::vector<model::StudyRun> runs;
  if (!model_.study || model_.study->is_written_out())
    runs = this->runs();
  else
    (void)study_parameters();
  found.warnings = run::warnings_of(model_);
  for (const model::StudyRun& run : runs) add_new(run::warnings_of(source_.read(run.overrides)), found.warnings);
  found.runs = std::max<std::size_t>(runs.size(), 1);
  return found;
}

std::vector<model::StudyRun> Session::runs() const {
  if (!model_.study) return {};  // the text is not read anew for that
  return model::expand_study(source_, overrides_);
}

std::vector<model::StudyParameter> Session::study_parameters() const { return model::check_study(source_, overrides_); }

std::vector<model::StudyRun> Session::runs(const std::vector<std::string>& overrides,
                                           const std::vector<model::StudyParameter>& parameters) const {
  return parameters.empty() ? model::expand_study(source_, overrides)
                            : model::expand_parameters(source_, overrides, parameters);
}

// Refuses results that may not be written; makes nothing.
void Session::prepare(const std::vector<Path>& results, const RunOptions& options) const {
  std::vector<OutputFile> outputs;
  for (const Path& page : options.pages) outputs.push_back({"--output", page});
  for (const Path& file : results) {
    outputs.push_back({"--output", file});
    outputs.push_back({"--output", run::checkpoint_file(file)});
  }
  require_separate(outputs, files());
  for (const Path& file : results) {
    results::require_idle(file);  // a file that is being written can neither be replaced nor resumed
    if (options.existing == Existing::keep && std::filesystem::exists(file)) throw results::FileExists(file);
  }
}

run::Summary Session::run(const Path& results, const RunOptions& options, Listener& listener) const {
  run::require_machine(model_);
  prepare({results}, options);
  if (options.check_start) listener.warned(0, run::warnings_of(model_));
  make_folder(results.parent_path());
  run::Options own;
  own.results = results;
  own.resume = resumes(options.existing, results);
  own.overwrite = replaces(options.existing) && !own.resume;
  own.step_error = options.step_error;
  own.stop = options.stop;
  own.study_parameters = options.study_parameters;
  own.on_progress = [&](const run::Progress& progress) { listener.stepped(0, progress); };
  own.on_cycle = [&](const run::CycleProgress& cycle) { listener.cycle_ended(0, cycle); };
  own.on_stopping = [&] { listener.stopping(); };
  study::RunResult result;
  result.run.overrides = overrides_;
  result.summary = run::simulate(model_, own);
  result.status = study::RunEnding::solved;
  listener.finished(0, result);
  return std::move(result.summary);
}

std::vector<study::RunResult> Session::run_all(const std::vector<model::StudyRun>& runs, const Path& folder,
                                               const RunOptions& options, Listener& listener) const {
  run::require_machine(model_);
  study::Options own;
  own.directory = folder;
  own.resume = options.existing == Existing::resume;
  own.overwrite = replaces(options.existing);
  own.step_error = options.step_error;
  own.threads = options.threads;
  own.stop = options.stop;
  own.on_progress = [&](std::size_t run, const run::Progress& progress) { listener.stepped(run, progress); };
  own.on_stopping = [&] { listener.stopping(); };
  own.on_finished = [&](std::size_t run, const study::RunResult& result) { listener.finished(run, result); };
  if (options.check_start)
    own.on_warnings = [&](std::size_t run, const std::vector<Fault>& warnings) { listener.warned(run, warnings); };
  std::vector<Path> planned;
  for (const model::StudyRun& run : runs) planned.push_back(study::results_file(own, run));
  prepare(planned, options);
  make_folder(folder);
  const auto read = [&](const std::vector<std::string>& overrides) { return source_.read(overrides); };
  return study::simulate_all(study::ModelReader(read), runs, own);
}

run::Simulation Session::simulation(const Path& results, bool overwrite) const {
  run::Options own;
  own.results = results;
  own.overwrite = overwrite;
  if (!results.empty()) {
    prepare({results}, {.existing = overwrite ? Existing::replace : Existing::keep});
    make_folder(results.parent_path());
  }
  return run::Simulation(model_, own);
}

study::BearingSolution Session::solve_bearing(const study::BearingSolver& solver,
                                              const study::BearingStudyOptions& options) const {
  study::BearingSolution solution = solver.solve(model_, options);
  solution.run.overrides = overrides_;
  return solution;
}

std::vector<study::BearingSolution> Session::solve_bearings(const std::vector<model::StudyRun>& runs,
                                                            study::BearingStudyOptions options) const {
  if (!runs.empty() && runs.front().overrides == overrides_) options.first = &model_;
  const auto read = [&](const std::vector<std::string>& overrides) { return source_.read(overrides); };
  return study::solve_bearings(study::ModelReader(read), runs, options);
}

std::vector<study::Sensitivity> Session::sensitivities(const study::BearingSolution& solution,
                                                       const study::BearingStudyOptions& options,
                                                       std::vector<std::string> keys, bool usual) const {
  if (usual)
    for (std::string& key : study::usual_parameters(text(), file(), solution.run.overrides, options.bearing))
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(std::move(key));
  return study::sensitivities(text(), file(), solution, options, keys);
}

}  // namespace hersey::session
