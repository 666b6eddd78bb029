#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/model.h"
#include "hersey/model/read.h"
#include "hersey/model/study.h"
#include "hersey/run/simulation.h"
#include "hersey/run/summary.h"
#include "hersey/session/listener.h"
#include "hersey/session/run_options.h"
#include "hersey/study/bearing_study.h"
#include "hersey/study/sensitivity.h"
#include "hersey/study/study.h"

namespace hersey::session {

/// Name of the model in a file: `x` for x/model.yaml, else the file's name without its ending.
[[nodiscard]] std::string model_name(const std::string& file);

/// Warnings of a model, of its start and of all runs that its study writes out, each once.
struct Check {
  std::vector<Fault> warnings;
  std::size_t runs = 1;  ///< that `hersey run` would do
};

/// A model in hand: its text and overrides, the checked model, and everything that can be done with it: check, run,
/// step from outside, solve a bearing. Command line, Python package and FMU are its clients. It prints nothing and
/// catches no signal: events go to a Listener, faults are thrown, and outcomes returned.
///
/// The file is opened and parsed once; later changes of it have no effect. Constant functions may be called from
/// several threads.
/// @verified_by session_test.cpp
class Session {
 public:
  /// Opens the model file at `path`. @throws InputError with every fault of the file, the overrides and the tables.
  explicit Session(const std::string& path, std::vector<std::string> overrides = {});
  /// Takes the text of a model; `file` names it in faults and is where relative paths start. @throws InputError
  Session(std::string text, std::string file, std::vector<std::string> overrides);
  /// Of a file that has been opened. @throws InputError
  Session(model::ModelFile source, std::vector<std::string> overrides);

  /// The same text with other overrides, in place of the present ones. @throws InputError
  [[nodiscard]] Session with(std::vector<std::string> overrides) const;

  /// The file that the text comes from, as it was opened.
  [[nodiscard]] const model::ModelFile& source() const { return source_; }
  /// The text as it was given, without overrides.
  [[nodiscard]] const std::string& text() const { return source_.text(); }
  /// What names it in faults.
  [[nodiscard]] const std::string& file() const { return source_.file(); }
  [[nodiscard]] const std::vector<std::string>& overrides() const { return overrides_; }
  [[nodiscard]] const model::Model& model() const { return model_; }
  /// For what no text can say, such as a client's own functions. It concerns `run`, `simulation` and `solve_bearing`;
  /// runs of a study are read from the text.
  [[nodiscard]] model::Model& model() { return model_; }
  /// The model's own file and all that it names: they must not be overwritten.
  [[nodiscard]] std::vector<std::filesystem::path> files() const;
  /// Where results go if the client does not say: results/<model_name>.
  [[nodiscard]] std::filesystem::path results_folder() const;

  /// Finds everything that can be found wrong without simulating.
  /// @throws InputError with the faults of the model, its study and its start.
  [[nodiscard]] Check check() const;
  /// Runs that the study writes out; empty without one, and if the overrides fix all its parameters.
  /// @throws InputError as model::expand_study
  [[nodiscard]] std::vector<model::StudyRun> runs() const;
  /// Parameters of the study that vary, each checked at all its values. @throws InputError as model::check_study
  [[nodiscard]] std::vector<model::StudyParameter> study_parameters() const;
  /// Every combination of `parameters`, which need not stand in the text, with `overrides` in place of the present
  /// ones; without parameters those of the study. @throws InputError as model::expand_parameters
  [[nodiscard]] std::vector<model::StudyRun> runs(const std::vector<std::string>& overrides,
                                                  const std::vector<model::StudyParameter>& parameters) const;

  /// Simulates the model into the file `results`, whose folder is made. The results are closed on return: up to the
  /// stop or the failure, if it ended early.
  /// @throws InputError if `results` is an input of the model, or the model cannot start; results::FileExists,
  /// FileBusy,
  ///         WriteError if the results cannot be begun. Nothing is written then, and Listener::finished not called.
  run::Summary run(const std::filesystem::path& results, const RunOptions& options, Listener& listener) const;
  /// Simulates `runs` into `folder`/<slug>.h5, several at a time. A run that fails does not stop the others.
  /// @throws InputError, results::FileError as `run`, before any run has begun.
  std::vector<study::RunResult> run_all(const std::vector<model::StudyRun>& runs, const std::filesystem::path& folder,
                                        const RunOptions& options, Listener& listener) const;
  /// The machine at its start, to be stepped from outside.
  /// @param results  file to write as the steps go; empty: none
  /// @throws as `run`
  [[nodiscard]] run::Simulation simulation(const std::filesystem::path& results = {}, bool overwrite = false) const;

  /// Solves one bearing at its operating point, with the bodies that `solver` knows. @throws InputError
  [[nodiscard]] study::BearingSolution solve_bearing(const study::BearingSolver& solver,
                                                     const study::BearingStudyOptions& options) const;
  /// Solves one bearing at every run of `runs`, which are overrides of this text. @throws InputError
  [[nodiscard]] std::vector<study::BearingSolution> solve_bearings(const std::vector<model::StudyRun>& runs,
                                                                   study::BearingStudyOptions options) const;
  /// Derivatives of the figures of `solution`, a solution of this text, by `keys` and, if `usual`, by the keys that
  /// decide about a bearing. @throws InputError if a key is not a number of the text.
  [[nodiscard]] std::vector<study::Sensitivity> sensitivities(const study::BearingSolution& solution,
                                                              const study::BearingStudyOptions& options,
                                                              std::vector<std::string> keys, bool usual) const;

 private:
  void prepare(const std::vector<std::filesystem::path>& results, const RunOptions& options) const;

  model::ModelFile source_;
  std::vector<std::string> overrides_;
  model::Model model_;
};

}  // namespace hersey::session
