#include "runs/studies.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <system_error>
#include <vector>

#include "hersey/core/write_file.h"
#include "hersey/workbench/refused.h"
#include "runs/process.h"
#include "runs/run_files.h"
#include "runs/run_record.h"
#include "runs/temporary_folder.h"

namespace hersey::workbench {
namespace {

using nlohmann::json;
using StudyPath = std::filesystem::path;

constexpr double kPlanTime = 60;  // [s]
constexpr std::size_t kMostRecordsAtOnce = 1000;
constexpr std::uintmax_t kMostPart = std::uintmax_t{4} << 20;  // of a file of records at a time

/// A name with a blank or with bytes beyond ASCII would not come back whole in the `after` of the next request.
bool is_name_of_shard(const std::string& name) {
  return name.ends_with(".jsonl") && std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c < 0x7f; });
}

/// Lines of a file that are complete, from a place on; one too long to be read whole is stepped over.
class StudyLines {
 public:
  StudyLines(const StudyPath& file, std::uintmax_t& place) : place_(place) {
    // The byte before tells whether the place is amid a line that was too long.
    const std::uintmax_t begin = place == 0 ? 0 : place - 1;
    text_ = part_of(file, begin, kMostPart);
    is_full_ = text_.size() == kMostPart;
    if (place == 0 || text_.empty()) return;
    const std::size_t end = text_.find('\n');
    next_ = end == std::string::npos ? text_.size() : end + 1;
    if (end != std::string::npos || is_full_) place_ = begin + next_;
    has_line_ = next_ > 1;
  }

  /// @returns false at the end of what could be read at once
  bool next(std::string& line) {
    const std::size_t end = text_.find('\n', next_);
    if (end == std::string::npos) {
      // The line is too long: its rest is looked for the next time.
      if (is_full_ && !has_line_ && next_ < text_.size()) place_ += text_.size() - next_;
      return false;
    }
    has_line_ = true;
    line = text_.substr(next_, end - next_);
    place_ += end + 1 - next_;
    next_ = end + 1;
    return true;
  }

  /// True where the file may go on behind what could be read at once.
  [[nodiscard]] bool may_go_on() const { return is_full_; }

 private:
  std::uintmax_t& place_;
  std::string text_;
  std::size_t next_ = 0;
  bool is_full_ = false, has_line_ = false;
};

/// Records of the study itself, and those of tasks of a cluster, by their names relative to the folder.
std::vector<std::string> record_files(const StudyPath& folder) {
  std::vector<std::string> names{"records.jsonl"};
  std::error_code error;
  if (std::filesystem::is_symlink(folder / "shards", error)) return names;
  std::filesystem::directory_iterator entry(folder / "shards", error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    if (const std::string name = entry->path().filename().string(); is_name_of_shard(name))
      names.push_back("shards/" + name);
  std::sort(names.begin() + 1, names.end());
  return names;
}

/// The runs of a study that go on, by what they write about themselves: `{run, values, share}`.
json runs_under_way(const StudyPath& folder) {
  constexpr std::size_t kMostUnderWay = 256;
  constexpr std::uintmax_t kMostLine = 64 << 10;
  json list = json::array();
  const StudyPath runs = folder / "runs";
  if (!is_own_folder(runs)) return list;
  for (const StudyPath& file : entries_of(runs)) {
    if (file.extension() != ".events" || list.size() == kMostUnderWay) continue;
    const std::string head = part_of(file, 0, kMostLine);
    const json first = object_of(head.substr(0, head.find('\n')));
    if (first.is_null() || record_text(first, "run") != file.stem().string()) continue;
    json run{{"run", record_text(first, "run")}, {"values", json::array()}, {"share", 0}};
    if (const auto values = first.find("values"); values != first.end() && values->is_array())
      for (const json& pair : *values)
        run["values"].push_back(pair.is_array() && pair.size() == 2 && pair.at(1).is_string() ? pair.at(1) : json());
    std::string tail = tail_of(file, kMostLine);
    tail.erase(tail.rfind('\n') == std::string::npos ? 0 : tail.rfind('\n'));
    const std::size_t begin = tail.rfind('\n');
    if (const json last = object_of(begin == std::string::npos ? tail : tail.substr(begin + 1)); !last.is_null())
      run["share"] = record_number(last, "share");
    list.push_back(std::move(run));
  }
  return list;
}

/// How far each file has been read: "120 shards/a.jsonl:300" without the first one's name.
std::map<std::string, std::uintmax_t> places_of(const std::string& after) {
  std::map<std::string, std::uintmax_t> places;
  std::istringstream words(after);
  for (std::string word; std::getline(words, word, ' ');) {
    const std::size_t colon = word.rfind(':');
    std::uintmax_t place = 0;
    if (colon == std::string::npos) continue;
    const auto [end, error] = std::from_chars(word.data() + colon + 1, word.data() + word.size(), place);
    if (error != std::errc{} || end != word.data() + word.size())
      throw Refused(400, "after is no place in a study", "reload the page");
    places[word.substr(0, colon)] = place;
  }
  return places;
}

std::vector<std::string> wanted_in(const json& plan) {
  std::vector<std::string> names;
  if (const auto found = plan.find("wanted"); found != plan.end() && found->is_array())
    for (const json& name : *found)
      if (name.is_string()) names.push_back(name.get<std::string>());
  return names;
}

/// Where a study names no figure, its runs show these.
std::vector<std::string> usual_figures(const json& figures) {
  std::vector<std::string> names;
  for (const auto& [name, value] : figures.items())
    for (const char* ending : {".h_min", ".p_max", ".power_film", ".moft", ".pofp", ".film_loss"})
      if (name.ends_with(ending) && std::count(name.begin(), name.end(), '.') == 2) names.push_back(name);
  constexpr std::size_t kMost = 8;
  for (auto figure = figures.begin(); names.empty() && figure != figures.end() && names.size() < kMost; ++figure)
    names.push_back(figure.key());
  if (names.size() > kMost) names.resize(kMost);
  return names;
}

/// @throws json::exception for a record of another form
json shown_record(const json& record, const std::vector<std::string>& wanted) {
  json shown{{"run", record.value("run", "")}, {"status", record.value("status", "")}, {"values", json::array()}};
  if (const auto found = record.find("values"); found != record.end() && found->is_array())
    for (const json& pair : *found)
      shown["values"].push_back(pair.is_array() && pair.size() == 2 ? pair.at(1) : json(nullptr));
  if (record.contains("error")) shown["error"] = record["error"];
  json figures = json::object();
  if (const auto found = record.find("figures"); found != record.end() && found->is_object())
    for (const std::string& name : wanted.empty() ? usual_figures(*found) : wanted)
      figures[name] = found->value(name, json(nullptr));
  shown["figures"] = std::move(figures);
  return shown;
}

/// Adds what a line says, units or the record of a run; one of another form is left out.
void add_line(const json& record, const std::vector<std::string>& wanted, json& answer) {
  try {
    if (record.is_null()) return;
    if (const auto units = record.find("describe"); units != record.end() && units->is_object())
      for (const auto& [figure, described] : units->items())
        answer["units"][figure] = {{"unit", described.value("unit", "")}, {"si", described.value("si", 1.0)}};
    else if (record.contains("run") && record.contains("values"))
      answer["records"].push_back(shown_record(record, wanted));
  } catch (const json::exception&) {
    return;
  }
}

}  // namespace

bool Studies::has_cluster() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (!folder.empty() && ::access((folder + "/sbatch").c_str(), X_OK) == 0) return true;
  return false;
}

std::string Studies::plan(const json& request) const {
  const StudyPath model = folder_.resolve(request.at("path").get<std::string>());
  const TemporaryFolder temporary;
  const StudyPath text = temporary.file("text"), file = temporary.file("plan.json");
  const auto content = request.at("text").get<std::string>();
  try {
    (void)write_new_file(text, content);
  } catch (const std::runtime_error& error) {
    throw Refused(507, fmt::format("the text cannot be written to be planned: {}", error.what()),
                  "make room on the disk");
  }
  std::vector<std::string> words{program_.string(), "study",  model.string(), "--plan",
                                 file.string(),     "--text", text.string()};
  for (const json& change : request.value("set", json::array())) words.push_back("--set=" + change.get<std::string>());
  std::string output;
  if (run_to_end(words, folder_.path(), kPlanTime, output) != 0) {
    output.erase(std::min(output.find_last_not_of(" \n") + 1, output.size()));
    throw Refused(422, output.empty() ? "the study cannot be planned" : output, "");
  }
  std::string plan = part_of(file, 0, std::uintmax_t{16} << 20);
  if (object_of(plan).is_null()) throw Refused(507, "the plan cannot be written", "make room on the disk");
  return plan;
}

std::string Studies::course(const std::string& id, const std::string& after) const {
  const RunEntry run = runs_.find(id);
  if (!run.is_study) throw Refused(404, "this run is no study", "choose one of the list");
  const StudyPath folder = folder_.path() / run.folder;
  const json plan = object_of(part_of(folder / "plan.json", 0, std::uintmax_t{16} << 20));
  const std::vector<std::string> wanted = plan.is_null() ? std::vector<std::string>{} : wanted_in(plan);
  std::map<std::string, std::uintmax_t> places = places_of(after);
  json answer{{"units", json::object()}, {"records", json::array()}};
  if (after.empty()) answer["plan"] = plan;
  bool goes_on = false;
  const auto is_full = [&] { return answer["records"].size() >= kMostRecordsAtOnce; };
  for (const std::string& name : record_files(folder)) {
    if (is_full()) break;
    StudyLines lines(folder / name, places[name]);
    for (std::string line; !is_full() && lines.next(line);) add_line(object_of(line), wanted, answer);
    goes_on = goes_on || lines.may_go_on();
  }
  std::string at;
  for (const auto& [name, place] : places) at += fmt::format("{}{}:{}", at.empty() ? "" : " ", name, place);
  answer["at"] = at;
  answer["more"] = goes_on || is_full();
  answer["state"] = run.state;
  answer["running"] = run.state == "running" ? runs_under_way(folder) : json::array();
  return answer.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace hersey::workbench
