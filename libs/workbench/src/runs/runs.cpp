#include "runs/runs.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "hersey/core/version.h"
#include "hersey/core/write_file.h"
#include "hersey/results/output_lock.h"
#include "hersey/session/session.h"
#include "runs/study_start.h"

namespace hersey::workbench {
namespace {

using nlohmann::json;
using Path = std::filesystem::path;

constexpr std::size_t kMostRuns = 500;
constexpr std::uintmax_t kMostLog = 256 << 10;
constexpr std::uintmax_t kMostModel = std::uintmax_t{16} << 20;
constexpr std::uintmax_t kMostTail = 64 << 10;
constexpr std::uintmax_t kMostRecord = 1 << 20;
constexpr double kReportTime = 300;  // [s]
constexpr const char* kLost = "its process ended without a word: it was killed, or the machine was";
constexpr const char* kNoObject = "?";  // in place of the beginning of a line, the rest of which is to be left out

double now() { return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(); }

/// Size and time of change of a regular file, of no link: what a run has written is no link, and others may lead
/// anywhere.
struct stat status_of_own(const Path& file) {
  struct stat status {};
  if (::lstat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  return status;
}

bool is_own_folder(const Path& folder) {
  struct stat status {};
  return ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode);
}

std::uintmax_t size_of(const Path& file) { return static_cast<std::uintmax_t>(status_of_own(file).st_size); }

/// [s] since 1970; 0 if there is no such file.
double time_of(const Path& file) {
  const struct stat status = status_of_own(file);
  return static_cast<double>(status.st_mtim.tv_sec) + 1e-9 * static_cast<double>(status.st_mtim.tv_nsec);
}

/// Differs between two contents of a file that is replaced as a whole: the second may follow the first within one tick
/// of the clock that times files, but is another file.
std::string record_mark(const Path& file) {
  const struct stat status = status_of_own(file);
  return fmt::format("{}.{:09} {} {}", status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_ino, status.st_size);
}

/// Bytes of a file from `begin` on, at most `most`; empty if it cannot be read.
std::string part_of(const Path& file, std::uintmax_t begin, std::uintmax_t most) {
  const std::uintmax_t size = size_of(file);
  if (size <= begin) return {};
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(begin));
  std::string text(std::min(most, size - begin), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return text;
}

std::string tail_of(const Path& file, std::uintmax_t most) {
  const std::uintmax_t size = size_of(file);
  return part_of(file, size > most ? size - most : 0, most);
}

/// False for JSON of more levels than the program writes: writing it again takes a call for each.
bool is_shallow(const std::string& text) {
  constexpr int kMostLevels = 32;
  int level = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\') ++i;
    if (c == '"') in_string = !in_string;
    if (in_string) continue;
    if ((c == '{' || c == '[') && ++level > kMostLevels) return false;
    if (c == '}' || c == ']') --level;
  }
  return true;
}

/// An object from a line, null if it is none: files may have been cut off, or written by someone else.
json object_of(const std::string& text) {
  if (!is_shallow(text)) return {};
  json value = json::parse(text, nullptr, false);
  return value.is_object() ? value : json();
}

std::string record_text(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

double record_number(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : 0;
}

std::vector<std::string> record_texts(const json& object, const char* key) {
  std::vector<std::string> texts;
  const auto found = object.find(key);
  if (found != object.end() && found->is_array())
    for (const json& text : *found)
      if (text.is_string()) texts.push_back(text.get<std::string>());
  return texts;
}

bool record_flag(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_boolean() && found->get<bool>();
}

ProcessId process_in(const json& record) {
  const auto found = record.find("process");
  if (found == record.end() || !found->is_object()) return {};
  const double pid = record_number(*found, "pid"), start = record_number(*found, "start");
  if (!(pid > 0 && pid < 1e9 && start > 0 && start < 1e18)) return {};
  return {static_cast<int>(pid), static_cast<std::uint64_t>(start)};
}

/// Letters, digits, '-' and '_' alone: names of folders that no shell and no page has to quote.
std::string plain(const std::string& name) {
  std::string text;
  for (const char c : name.substr(0, 60)) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
    text += is_plain ? c : '_';
  }
  return text.empty() ? "run" : text;
}

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
  const std::string records = part_of(folder / "records.jsonl", 0, kMostModel);
  const auto done = static_cast<double>(std::count(records.begin(), records.end(), '\n'));
  return all > 0 ? std::min(done / all, 1.0) : 0;
}

void check_override(const std::string& change) {
  const bool is_plain =
      std::none_of(change.begin(), change.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (!is_plain || change.find('=') == std::string::npos || change.size() > 10'000)
    throw Refused(422, fmt::format("'{}' changes nothing", change), "write it as load=500N");
}

/// What the events say of the last start of a run.
struct Course {
  std::string status, message;  // of its end; empty: none yet
  double share = 0, ended = 0;
};

Course course_of(const Path& events) {
  Course course;
  std::istringstream lines(tail_of(events, kMostTail));
  for (std::string line; std::getline(lines, line);) {
    const json event = object_of(line);
    if (event.is_null()) continue;
    const std::string kind = record_text(event, "kind");
    if (kind == "started") course = {};
    if (kind == "stepped" || kind == "run_finished") course.share = record_number(event, "share");
    if (kind != "finished") continue;
    course.status = record_text(event, "status");
    course.message = record_text(event, "message");
    if (course.status == "completed") course.share = 1;
    course.ended = time_of(events);
  }
  return course;
}

json json_with(const ProcessId& process) { return {{"pid", process.pid}, {"start", process.start}}; }

void cannot_make(const Path& folder, const std::error_code& error) {
  const bool is_full = error == std::errc::no_space_on_device;
  throw Refused(is_full ? 507 : 403, fmt::format("{} cannot be made: {}", folder.string(), error.message()),
                is_full ? "make room on the disk" : "open a folder in which you may write");
}

/// What lies in a folder; none of it if the folder cannot be read.
std::vector<Path> entries_of(const Path& folder) {
  std::vector<Path> entries;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    entries.push_back(entry->path());
  return entries;
}

/// Names of the runs in `folder`/runs.
std::vector<std::string> own_runs(const Path& folder) {
  std::vector<std::string> ids;
  if (!is_own_folder(folder / "runs")) return ids;
  for (const Path& run : entries_of(folder / "runs")) {
    std::string id = run.filename().string();
    if (id == plain(id) && is_own_folder(run) && time_of(run / "run.json") > 0) ids.push_back(std::move(id));
  }
  return ids;
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

/// Name of a link in the folder of a run, empty if there is none. One in the place of any file, of those that are
/// replaced through a temporary file as well, would be followed when it is written.
std::string link_among(const Path& folder) {
  std::error_code error;
  std::filesystem::recursive_directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::recursive_directory_iterator(); entry.increment(error))
    if (std::error_code unknown; entry->is_symlink(unknown)) return entry->path().lexically_relative(folder).string();
  if (error) cannot_make(folder, error);
  return {};
}

std::string text_of_record(const json& record) {
  return record.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

void write_record(const Path& file, const std::string& text) {
  try {
    write_file(file, {text});
  } catch (const std::runtime_error& error) {
    throw Refused(507, error.what(), "make room on the disk, then start the run again");
  }
}

}  // namespace

Runs::Runs(Folder& folder, EventLog& events, Path program)
    : folder_(folder), events_(events), program_(std::move(program)) {
  look_for_runs();
  calls_ = 1;
}

Runs::~Runs() {
  std::error_code ignored;
  if (!reports_.empty()) std::filesystem::remove_all(reports_, ignored);
}

RunEntry Runs::entry_of(const std::string& id) const {
  const Path folder = folder_.path() / "runs" / id;
  RunEntry run;
  run.id = id;
  run.folder = "runs/" + id;
  const json record = object_of(part_of(folder / "run.json", 0, kMostRecord));
  run.model = record_text(record, "model");
  run.overrides = record_texts(record, "set");
  run.started = record_number(record, "started");
  run.is_study = record_flag(record, "study");
  run.process = process_in(record);
  const Course course = course_of(folder / "events.ndjson");
  run.share = course.share, run.message = course.message, run.ended = course.ended;
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
  const bool is_starting = run.process.pid == 0 && course.status.empty() && now() - run.started < kStartTime;
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

std::string Runs::start(const json& request) {
  const std::string path = record_text(request, "path");
  const FileText model = folder_.read(path);
  if (const std::string etag = record_text(request, "etag"); !etag.empty() && etag != model.etag)
    throw Refused(409, path + " has been changed since", "save it, then run it");
  const std::vector<std::string> overrides = record_texts(request, "set");
  for (const std::string& change : overrides) check_override(change);
  const std::lock_guard lock(starting_);
  const std::string name = plain(session::model_name((folder_.path() / path).string()));
  const Path runs = folder_.path() / "runs";
  std::error_code error;
  std::filesystem::create_directories(runs, error);
  if (error) cannot_make(runs, error);
  if (!is_own_folder(runs)) throw Refused(403, "runs is a link, which may lead anywhere", "make it a folder");
  std::string id;
  for (int number = 1; id.empty(); ++number) {
    const std::string next = fmt::format("{}-{:03d}", name, number);
    if (std::filesystem::create_directory(runs / next, error)) id = next;
    if (error) cannot_make(runs / next, error);
  }
  json record{{"version", version()}, {"model", path}, {"set", overrides}, {"started", now()}};
  if (record_flag(request, "study")) note_study(request, record);
  write_record(runs / id / "model.txt", model.text);
  launch(id, std::move(record), false);
  return id;
}

void Runs::launch(const std::string& id, json record, bool resumes) {
  const Path folder = folder_.path() / "runs" / id;
  const bool is_study = record_flag(record, "study");
  const Path model = folder_.resolve(record_text(record, "model"));
  std::vector<std::string> words{program_.string(), is_study ? "study" : "run", model.string(), "--output",
                                 folder.string()};
  for (const std::string& change : record_texts(record, "set")) {
    check_override(change);
    words.push_back("--set=" + change);
  }
  if (is_study) {
    add_study_words(record, words);
  } else {
    words.insert(words.end(), {"--events", (folder / "events.ndjson").string()});
    if (resumes) words.emplace_back("--resume");
  }
  if (const std::string link = link_among(folder); !link.empty())
    throw Refused(403, fmt::format("{} of this run is a link, which may lead anywhere", link), "start the run anew");
  record["command"] = words;
  const auto save = [&] { write_record(folder / "run.json", text_of_record(record)); };
  record.erase("process");
  record.erase("stopping");
  save();
  // Studies report no events: a shell notes how they end. It outlives Ctrl-C, which both get.
  if (is_study) {
    std::error_code ignored;
    std::filesystem::remove(folder / "exit.txt", ignored);
    words.insert(words.begin(),
                 {"/bin/sh", "-c", "trap : INT TERM; \"$@\"; echo $? > \"$0\"", (folder / "exit.txt").string()});
  }
  record["process"] = json_with(start_detached(words, folder_.path(), folder / "log.txt"));
  save();
  events_.add("runs", json{{"id", id}}.dump());
}

void Runs::stop(const std::string& id) {
  const std::lock_guard lock(starting_);
  const RunEntry run = find(id);
  if (run.state != "running") throw Refused(409, "this run has ended already", "");
  const Path file = folder_.path() / run.folder / "run.json";
  if (!interrupt(run.process, (folder_.path() / run.folder).string()))
    throw Refused(409, "this run was not started here, or has just ended", "stop it where it was started");
  json record = object_of(part_of(file, 0, kMostRecord));
  if (record.is_null() || !link_among(file.parent_path()).empty()) return;
  record["stopping"] = now();
  try {
    write_record(file, text_of_record(record));
  } catch (const Refused&) {
    return;  // it stops without the note as well
  }
}

void Runs::resume(const std::string& id) {
  const std::lock_guard lock(starting_);
  const RunEntry run = find(id);
  if (!run.can_resume)
    throw Refused(409, run.state == "running" ? "this run goes on already" : "there is nothing to resume from",
                  "start it anew");
  const Path file = folder_.path() / run.folder / "run.json";
  json record = object_of(part_of(file, 0, kMostRecord));
  if (record.is_null() || run.folder != "runs/" + id)
    throw Refused(409, "this run was not started here", "resume it by `hersey run --resume`");
  record["resumed"] = now();
  launch(id, std::move(record), true);
}

std::string Runs::log(const std::string& id) const {
  return tail_of(folder_.path() / find(id).folder / "log.txt", kMostLog);
}

std::string Runs::model_text(const std::string& id) const {
  const Path file = folder_.path() / find(id).folder / "model.txt";
  if (size_of(file) == 0) throw Refused(404, "the model of this run is not known", "");
  return tail_of(file, kMostModel);
}

std::string Runs::history(const std::string& id, std::size_t most) const {
  const Path file = folder_.path() / find(id).folder / "events.ndjson";
  if (size_of(file) == 0) return {};
  const auto each_line = [&](auto&& act) {
    std::ifstream stream(file, std::ios::binary);
    for (std::string line; std::getline(stream, line);)
      if (!stream.eof() && !line.empty()) act(line);
  };
  constexpr std::string_view kStepped = "{\"kind\":\"stepped\"";
  std::size_t steps = 0;
  each_line([&](const std::string& line) { steps += line.starts_with(kStepped) ? 1 : 0; });
  const std::size_t every = std::max<std::size_t>((steps + most - 1) / std::max<std::size_t>(most, 1), 1);
  std::string text;
  std::size_t step = 0;
  each_line([&](const std::string& line) {
    const bool is_step = line.starts_with(kStepped);
    // The last step counts, so that the end of each curve is there.
    if (is_step && (++step % every != 0) && step != steps) return;
    text += line + "\n";
  });
  return text;
}

Path Runs::report(const std::vector<std::string>& ids) {
  std::vector<std::string> words{program_.string(), "report"}, names;
  std::optional<Path> ready;
  for (const std::string& id : ids) {
    const RunEntry run = find(id);
    if (run.results.empty() && run.report.empty())
      throw Refused(409, id + " has no results yet", "wait for the first of them, or look at its log");
    for (const std::string& file : run.results) {
      words.push_back((folder_.path() / file).string());
      names.push_back(run.results.size() == 1 ? id : id + " " + Path(file).stem().string());
    }
    if (!run.report.empty() && run.state != "running") ready = folder_.path() / run.report;
  }
  if (ids.size() == 1 && ready) return *ready;
  const std::lock_guard lock(reporting_);
  if (reports_.empty()) {
    std::string pattern = (std::filesystem::temp_directory_path() / "hersey-reports-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr)
      throw Refused(507, fmt::format("no temporary folder can be made: {}", std::strerror(errno)),
                    "make room on the disk");
    reports_ = pattern;
  }
  const Path page = reports_ / fmt::format("{}.html", ++report_count_);
  words.insert(words.end(), {"--output", page.string()});
  if (ids.size() > 1) {
    std::string joined;
    for (const std::string& name : names) joined += (joined.empty() ? "" : ",") + name;
    words.push_back("--names=" + joined);
  }
  std::string output;
  if (run_to_end(words, folder_.path(), kReportTime, output) != 0)
    throw Refused(422, "no report can be made: " + output.substr(0, output.find('\n')), "look at the log of the run");
  return page;
}

void Runs::forget_report(const Path& page) {
  const std::lock_guard lock(reporting_);
  if (reports_.empty() || page.parent_path() != reports_) return;
  std::error_code ignored;
  std::filesystem::remove(page, ignored);
  std::filesystem::remove_all(reports_ / (page.stem().string() + "_fields"), ignored);
}

void Runs::follow_run(const std::string& id, Tail& tail) {
  const Path file = folder_.path() / "runs" / id / "events.ndjson";
  const std::uintmax_t size = size_of(file);
  if (size <= tail.read) return;
  constexpr std::uintmax_t kMostAtOnce = 1 << 20;
  constexpr std::size_t kMostLine = 1 << 20;
  const std::string text = part_of(file, tail.read, std::min(size - tail.read, kMostAtOnce));
  tail.read += text.size();
  std::istringstream lines(tail.rest + text);
  tail.rest.clear();
  for (std::string line; std::getline(lines, line);) {
    if (lines.eof()) {
      tail.rest = line.size() > kMostLine ? kNoObject : line;
      break;
    }
    json event = object_of(line);
    if (event.is_null()) continue;
    event["id"] = id;
    events_.add("run", event.dump(-1, ' ', false, json::error_handler_t::replace));
  }
}

void Runs::look_for_runs() {
  const bool is_first_look = calls_ == 0;
  bool is_list_new = false;
  std::set<std::string> there;
  for (const std::string& id : own_runs(folder_.path())) {
    const Path folder = folder_.path() / "runs" / id, record = folder / "run.json";
    const std::string mark = record_mark(record);
    there.insert(id);
    const auto [entry, is_new] = tails_.try_emplace(id);
    Tail& tail = entry->second;
    // What was written before this program began is history, which pages ask for; the rest of a line in the middle of
    // being written is no object.
    if (is_new && is_first_look) tail.read = size_of(folder / "events.ndjson"), tail.rest = kNoObject;
    if (!is_new && tail.record_mark == mark && !tail.runs) continue;
    tail.record_mark = mark;
    const bool runs = is_running(process_in(object_of(part_of(record, 0, kMostRecord))));
    is_list_new = is_list_new || is_new || runs != tail.runs;
    if (!runs) follow_run(id, tail);  // what it wrote at its end
    tail.runs = runs;
  }
  for (auto tail = tails_.begin(); tail != tails_.end();) {
    const bool is_gone = there.count(tail->first) == 0;
    is_list_new = is_list_new || is_gone;
    tail = is_gone ? tails_.erase(tail) : std::next(tail);
  }
  if (is_list_new && !is_first_look) events_.add("runs", "{}");
}

void Runs::follow() {
  constexpr int kCallsPerLook = 5;  // folders are listed more seldom than events are read
  if (calls_ % kCallsPerLook == 0) look_for_runs();
  ++calls_;
  for (auto& [id, tail] : tails_)
    if (tail.runs) follow_run(id, tail);
}

}  // namespace hersey::workbench
