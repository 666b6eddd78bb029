#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "events/event_log.h"
#include "folder/folder.h"
#include "runs/process.h"

namespace hersey::workbench {

/// What is known of a run from the files in its folder.
struct RunEntry {
  std::string id;  ///< name of its folder in runs/; of results made elsewhere their path with ':' for '/'
  std::string model;
  std::vector<std::string> overrides;
  std::string folder;             ///< relative
  std::string state;              ///< running, completed, failed, stopped or lost
  double share = 0;               ///< done, from 0 to 1
  double started = 0, ended = 0;  ///< seconds since 1970; 0: not known
  std::string message;
  std::string at_path, at_file;  ///< of a failed run: the part of its model that the message is about; empty: none
  int at_line = 0;
  std::vector<std::string> results;  ///< relative paths
  std::string report;                ///< relative path; empty: none yet
  bool can_resume = false;
  bool is_study = false;
  ProcessId process;
};

/// Runs of the models in a folder, each a process of its own with a folder of its own, runs/NAME: its results, report,
/// log, the model's text, events.ndjson and run.json. Nothing about them is kept in this program: one that is started
/// later finds them by these files.
/// @verified_by tests/workbench/runs_test.py
class Runs {
 public:
  Runs(Folder& folder, EventLog& events, std::filesystem::path program);
  Runs(const Runs&) = delete;
  Runs& operator=(const Runs&) = delete;
  ~Runs();

  /// The program that runs are started with.
  [[nodiscard]] const std::filesystem::path& program() const { return program_; }

  /// All runs, the newest first: at most 500.
  [[nodiscard]] std::vector<RunEntry> list() const;
  /// @throws Refused 404
  [[nodiscard]] RunEntry find(const std::string& id) const;
  /// Starts a run of a saved model. @returns its id
  /// @param request  {path, set, etag?, study?, on?, jobs?, partition?}; the last three of a study
  /// @throws Refused 409 if the file no longer has the mark `etag`; 403, 507 if its folder cannot be made
  std::string start(const nlohmann::json& request);
  /// Asks it to stop as Ctrl-C does, and notes so in its record: it may not have come so far as to report it itself.
  void stop(const std::string& id);
  void resume(const std::string& id);
  /// Removes a run with its folder, or a results file that was made elsewhere with what belongs to it. No link is
  /// followed, and nothing is removed where the folder has anything that no run makes.
  /// @throws Refused 404; 409 if it goes on or something else is there; 403 without the right, and for links
  void remove(const std::string& id);
  /// The end of what it printed, at most 256 kB.
  [[nodiscard]] std::string log(const std::string& id) const;
  /// Text of its model as it was started, for comparisons.
  [[nodiscard]] std::string model_text(const std::string& id) const;
  /// Its events, steps thinned out to at most `most`, one line of JSON each.
  [[nodiscard]] std::string history(const std::string& id, std::size_t most) const;
  /// The same of a run of a study, as long as it goes on; empty before and afterwards. @throws Refused 404
  [[nodiscard]] std::string history_in_study(const std::string& id, const std::string& run, std::size_t most) const;
  /// Makes the report of runs, of several as a comparison, in a temporary folder where it is not there already.
  /// @param names  of the runs in a comparison, in their order; empty: their ids
  /// @throws Refused 409 if there are no results yet, 422 if no report can be made of them
  std::filesystem::path report(const std::vector<std::string>& ids, const std::vector<std::string>& names = {});
  /// Makes the report of one bearing by itself: `{path, text, bearing, set}` -> as `hersey bearing --report` of that
  /// text.
  /// @throws Refused 422 where there is no solution
  std::filesystem::path bearing_report(const nlohmann::json& request);
  /// Removes a report that was made in the temporary folder; one in the folder of a run stays.
  void forget_report(const std::filesystem::path& page);

  /// Passes on what runs have written since the last call. To be called several times a second, by one thread.
  void follow();

 private:
  /// How far the events of a run have been passed on.
  struct Tail {
    std::uintmax_t read = 0;
    std::string rest;         // of a line that is not complete
    std::string record_mark;  // of the record that was read last
    bool runs = false;
  };
  [[nodiscard]] RunEntry entry_of(const std::string& id) const;
  [[nodiscard]] std::vector<RunEntry> results_made_elsewhere() const;
  /// The next file in the temporary folder of reports, which is made with the first; with `reporting_` locked.
  std::filesystem::path next_report();
  void launch(const std::string& id, nlohmann::json record, bool resumes);
  void look_for_runs();
  void follow_run(const std::string& id, Tail& tail);

  Folder& folder_;
  EventLog& events_;
  std::filesystem::path program_;
  std::mutex starting_;
  std::map<std::string, Tail> tails_;
  int calls_ = 0;
  std::mutex reporting_;
  std::filesystem::path reports_;  // temporary folder
  int report_count_ = 0;
};

}  // namespace hersey::workbench
