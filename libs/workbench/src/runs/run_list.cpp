#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "hersey/results/output_lock.h"
#include "runs/run_files.h"
#include "runs/run_record.h"
#include "runs/runs.h"

namespace hersey::workbench {
namespace {

using nlohmann::json;
using Path = std::filesystem::path;

constexpr std::size_t kMostRuns = 500;
constexpr std::uintmax_t kMostTail = 64 << 10;
constexpr std::uintmax_t kMostRecords = std::uintmax_t{16} << 20;  // of a study
constexpr const char* kLost = "its process ended without a word: it was killed, or the machine was";

std::string last_line(std::string text) {
  text.erase(std::min(text.find_last_not_of(" \n") + 1, text.size()));
  const std::size_t begin = text.rfind('\n');
  return begin == std::string::npos ? text : text.substr(begin + 1);
}

/// Part of a study that is done: the runs on record, of as many as it says in lines like "3/8 runs, 3.35 per second".
double share_of_study(const Path& folder) {
  const std::string log = tail_of(folder / "log.txt", kMostTail);
  const std::size_t end = log.rfind(" runs, ");
  const std::size_t slash = end == std::string::npos ? end : log.rfind('/', end);
  if (slash == std::string::npos) return 0;
  const double all = std::atof(log.substr(slash + 1, end - slash - 1).c_str());
  const std::string records = part_of(folder / "records.jsonl", 0, kMostRecords);
  const auto done = static_cast<double>(std::count(records.begin(), records.end(), '\n'));
  return all > 0 ? std::min(done / all, 1.0) : 0;
}

/// The part of a model that the failure of a run is about.
struct PlaceInText {
  std::string path, file;
  int line = 0;
};

/// What the events say of the last start of a run.
struct Course {
  std::string status, message;       // of its end; empty: none yet
  std::optional<PlaceInText> place;  // of its failure, where it is known
  double share = 0, ended = 0;
};

std::optional<PlaceInText> place_in(const json& event) {
  const auto at = event.find("at");
  if (at == event.end() || !at->is_object()) return std::nullopt;
  const double line = std::clamp(record_number(*at, "line"), 0.0, 1e9);
  return PlaceInText{record_text(*at, "path"), record_text(*at, "file"), static_cast<int>(line)};
}

Course course_of(const Path& events) {
  Course course;
  std::istringstream lines(tail_of(events, kMostTail));
  for (std::string line; std::getline(lines, line);) {
    const json event = object_of(line);
    if (event.is_null()) continue;
    const std::string kind = record_text(event, "kind");
    if (kind == "started") course = {};
    if (kind == "stepped" || kind == "run_finished") course.share = record_number(event, "share");
    // Of a study the first run that failed.
    if (kind == "run_finished" && record_text(event, "status") == "failed" && !course.place)
      course.place = place_in(event);
    if (kind != "finished") continue;
    if (std::optional<PlaceInText> place = place_in(event)) course.place = std::move(place);
    course.status = record_text(event, "status");
    course.message = record_text(event, "message");
    if (course.status == "completed") course.share = 1;
    course.ended = time_of(events);
  }
  return course;
}

/// True while a run writes this file. The lock's file alone proves nothing: it outlives a run that was killed.
bool is_being_written(const Path& results) {
  try {
    results::require_idle(results);
    return false;
  } catch (const results::FileBusy&) {
    return true;
  }
}

}  // namespace

RunEntry Runs::entry_of(const std::string& id) const {
  const Path folder = folder_.path() / "runs" / id;
  RunEntry run;
  run.id = id;
  run.folder = "runs/" + id;
  const json record = record_in(folder / "run.json");
  run.model = record_text(record, "model");
  run.overrides = record_texts(record, "set");
  run.started = record_number(record, "started");
  run.is_study = record_flag(record, "study");
  run.process = process_in(record);
  const Course course = course_of(folder / "events.ndjson");
  run.share = course.share, run.message = course.message, run.ended = course.ended;
  if (course.place) {
    run.at_path = course.place->path;
    run.at_line = course.place->line;
    const Path file = Path(course.place->file).lexically_relative(folder_.path());
    run.at_file = file.empty() || *file.begin() == ".." ? "" : file.generic_string();
  }
  double reported = 0;
  std::error_code error;
  for (const Path& file : entries_of(folder)) {
    const Path name = file.filename();
    if (std::filesystem::is_symlink(file, error)) continue;
    if (name.extension() == ".h5") run.results.push_back(run.folder + "/" + name.string());
    if (name == "report.html" || name == "study.html")
      run.report = run.folder + "/" + name.string(), reported = time_of(file);
    if (name.extension() == ".checkpoint") run.can_resume = true;
  }
  std::sort(run.results.begin(), run.results.end());
  constexpr double kStartTime = 5;  // [s]: more than it takes until the process is known
  const bool is_starting =
      run.process.pid == 0 && course.status.empty() && seconds_since_1970() - run.started < kStartTime;
  if (is_starting || is_running(run.process)) {
    run.state = "running";
    run.ended = 0;
    run.can_resume = false;
    if (run.is_study) run.share = share_of_study(folder);
  } else if (!course.status.empty()) {
    run.state = course.status;
  } else if (const std::string code = part_of(folder / "exit.txt", 0, 8); run.is_study && !code.empty()) {
    run.state = code == "0\n" ? "completed" : code == "130\n" ? "stopped" : "failed";
    run.share = run.state == "completed" ? 1 : 0;
    run.ended = time_of(folder / "exit.txt");
    if (run.state != "completed") run.message = last_line(tail_of(folder / "log.txt", kMostTail));
  } else if (const double began = std::max(run.started, record_number(record, "resumed"));
             reported > began && !run.can_resume) {
    // Its events ended before it did, on a full disk perhaps; a checkpoint would be there if it had not come to its
    // end.
    run.state = "completed";
    run.share = 1;
    run.ended = reported;
  } else if (record_number(record, "stopping") > 0) {
    run.state = "stopped";
    run.message = "stopped on request";
    run.ended = record_number(record, "stopping");
  } else {
    run.state = "lost";
    run.message = fmt::format("{}; the log may say more", kLost);
  }
  run.can_resume =
      run.state != "running" && run.state != "completed" && (run.can_resume || run.is_study || !run.results.empty());
  return run;
}

std::vector<RunEntry> Runs::results_made_elsewhere() const {
  std::vector<RunEntry> found;
  for (const FileEntry& file : folder_.list()) {
    if (file.kind != "results" || file.path.starts_with("runs/")) continue;
    const Path path = folder_.path() / file.path;
    RunEntry run;
    run.id = file.path;
    std::replace(run.id.begin(), run.id.end(), '/', ':');
    run.folder = Path(file.path).parent_path().generic_string();
    run.results = {file.path};
    run.ended = file.changed;
    run.share = 1;
    // What a run leaves behind that was killed.
    const bool is_left = time_of(path.string() + ".lock") > 0;
    const bool is_cut_off = std::filesystem::exists(Path(path).replace_extension(".checkpoint"));
    run.state = is_being_written(path) ? "running" : is_left ? "lost" : is_cut_off ? "stopped" : "completed";
    if (run.state == "lost") run.message = kLost;
    const Path page = path.parent_path() / "report.html";
    if (size_of(page) > 0 && path.filename() == "results.h5")
      run.report = page.lexically_relative(folder_.path()).generic_string();
    found.push_back(std::move(run));
  }
  return found;
}

std::vector<RunEntry> Runs::list() const {
  std::vector<std::pair<double, std::string>> ids;
  for (const std::string& id : own_runs(folder_.path()))
    ids.emplace_back(time_of(folder_.path() / "runs" / id / "run.json"), id);
  std::sort(ids.rbegin(), ids.rend());
  if (ids.size() > kMostRuns) ids.resize(kMostRuns);
  std::vector<RunEntry> runs;
  for (const auto& [time, id] : ids) runs.push_back(entry_of(id));
  for (RunEntry& run : results_made_elsewhere()) runs.push_back(std::move(run));
  std::stable_sort(runs.begin(), runs.end(), [](const RunEntry& a, const RunEntry& b) {
    return std::max(a.started, a.ended) > std::max(b.started, b.ended);
  });
  if (runs.size() > kMostRuns) runs.resize(kMostRuns);
  return runs;
}

RunEntry Runs::find(const std::string& id) const {
  const std::vector<std::string> own = own_runs(folder_.path());
  if (std::find(own.begin(), own.end(), id) != own.end()) return entry_of(id);
  for (RunEntry& run : results_made_elsewhere())
    if (run.id == id) return std::move(run);
  throw Refused(404, "there is no run of this name", "choose one of the list");
}

}  // namespace hersey::workbench
