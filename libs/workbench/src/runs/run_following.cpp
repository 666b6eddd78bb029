#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "runs/run_files.h"
#include "runs/run_record.h"
#include "runs/runs.h"

namespace hersey::workbench {
namespace {

using nlohmann::json;
using Path = std::filesystem::path;

constexpr const char* kNoObject = "?";  // in place of the beginning of a line, the rest of which is to be left out

}  // namespace

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
    const bool runs = is_running(process_in(record_in(record)));
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
