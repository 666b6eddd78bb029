#pragma once

#include <chrono>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/model.h"
#include "hersey/model/study.h"
#include "hersey/run/named_part.h"
#include "hersey/run/options.h"
#include "hersey/study/study.h"

namespace hersey::cli {

/// Writes what happens in a run to a file, one line of JSON for each event (docs/workbench.md), for programs that show
/// it while it goes on. Lines are appended as a whole. A file that cannot be written, or no longer, ends the events and
/// not the run.
///
/// Steps are written at most ten times a second, and seldom enough that a long run writes no more than some hundred
/// thousand of them: the pause grows to 1/10000 of the time that the run has taken.
class RunEvents {
 public:
  /// @param file  empty: nothing is written
  explicit RunEvents(const std::filesystem::path& file);
  RunEvents(const RunEvents&) = delete;
  RunEvents& operator=(const RunEvents&) = delete;
  ~RunEvents();

  /// @param runs  of a study; empty: a single run
  void started(const model::Model& model, const std::vector<model::StudyRun>& runs);
  void warned(std::size_t run, const std::vector<Fault>& warnings);
  void stepped(std::size_t run, const run::Progress& progress);
  void cycle_ended(std::size_t run, const run::CycleProgress& cycle);
  void finished(std::size_t run, const study::RunResult& result);
  /// All runs have ended, and the report is written. @param code  ExitCode of the command
  void ended(int code);
  /// The command ends by an error.
  void failed(const std::exception& error);

 private:
  using Clock = std::chrono::steady_clock;

  void write(const nlohmann::ordered_json& event);
  /// With the part of the model that the message is about, where it is known.
  void write_end(nlohmann::ordered_json& event);

  int fd_ = -1;
  std::size_t runs_ = 1, finished_ = 0;
  Clock::time_point last_step_;
  double t_ = 0;
  std::string message_;  // of the run that finished last
  std::optional<run::NamedPart> place_;
  std::map<std::string, SourcePosition> positions_;  // of the keys of the model
};

}  // namespace hersey::cli
