#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "hersey/core/version.h"
#include "hersey/session/session.h"
#include "runs/run_files.h"
#include "runs/run_record.h"
#include "runs/runs.h"
#include "runs/study_start.h"

namespace hersey::workbench {
namespace {

using nlohmann::json;
using Path = std::filesystem::path;

void check_override(const std::string& change) {
  const bool is_plain =
      std::none_of(change.begin(), change.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (!is_plain || change.find('=') == std::string::npos || change.size() > 10'000)
    throw Refused(422, fmt::format("'{}' changes nothing", change), "write it as load=500N");
}

json json_with(const ProcessId& process) { return {{"pid", process.pid}, {"start", process.start}}; }

}  // namespace

std::string Runs::start(const json& request) {
  const std::string path = record_text(request, "path");
  const FileText model = folder_.read(path);
  if (const std::string etag = record_text(request, "etag"); !etag.empty() && etag != model.etag)
    throw Refused(409, path + " has been changed since", "save it, then run it");
  const std::vector<std::string> overrides = record_texts(request, "set");
  for (const std::string& change : overrides) check_override(change);
  // What is refused leaves no folder.
  json record{{"version", version()}, {"model", path}, {"set", overrides}, {"started", seconds_since_1970()}};
  if (record_flag(request, "study")) note_study(request, record);
  const std::lock_guard lock(starting_);
  const std::string name = plain_name(session::model_name((folder_.path() / path).string()));
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
  write_text(runs / id / "model.txt", model.text);
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
  const auto save = [&] { write_record(folder / "run.json", record); };
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
  json record = record_in(file);
  if (record.is_null() || !link_among(file.parent_path()).empty()) return;
  record["stopping"] = seconds_since_1970();
  try {
    write_record(file, record);
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
  json record = record_in(file);
  if (record.is_null() || run.folder != "runs/" + id)
    throw Refused(409, "this run was not started here", "resume it by `hersey run --resume`");
  record["resumed"] = seconds_since_1970();
  launch(id, std::move(record), true);
}

}  // namespace hersey::workbench
