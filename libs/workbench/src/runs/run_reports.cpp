#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "runs/run_record.h"
#include "runs/runs.h"
#include "runs/temporary_folder.h"

namespace hersey::workbench {
namespace {

using nlohmann::json;
using Path = std::filesystem::path;

constexpr double kReportTime = 300;  // [s]

/// A name as the list on the command line takes it: the comma parts names, and a page has little room.
std::string label_of(const std::string& name, const std::string& id) {
  constexpr std::size_t kMostLabel = 200;
  std::string label;
  for (const char c : name) {
    const auto code = static_cast<unsigned char>(c);
    label += c == ',' ? ';' : code < 0x20 || code == 0x7f ? ' ' : c;
  }
  if (label.find_first_not_of(' ') == std::string::npos || label.size() > kMostLabel) return id;
  return label;
}

}  // namespace

Path Runs::report(const std::vector<std::string>& ids, const std::vector<std::string>& names) {
  if (!names.empty() && names.size() != ids.size())
    throw Refused(400, "the runs have other names than they are", "reload the page");
  std::vector<std::string> words{program_.string(), "report"}, labels;
  std::optional<Path> ready;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::string& id = ids[i];
    const RunEntry run = find(id);
    const std::string name = names.empty() ? id : label_of(names[i], id);
    if (run.results.empty() && run.report.empty())
      throw Refused(409, id + " has no results yet", "wait for the first of them, or look at its log");
    for (const std::string& file : run.results) {
      words.push_back((folder_.path() / file).string());
      labels.push_back(run.results.size() == 1 ? name : name + " " + Path(file).stem().string());
    }
    if (!run.report.empty() && run.state != "running") ready = folder_.path() / run.report;
  }
  if (ids.size() == 1 && ready) return *ready;
  const std::lock_guard lock(reporting_);
  const Path page = next_report();
  words.insert(words.end(), {"--output", page.string()});
  if (ids.size() > 1) {
    std::string joined;
    for (const std::string& label : labels) joined += (joined.empty() ? "" : ",") + label;
    words.push_back("--names=" + joined);
  }
  std::string output;
  if (run_to_end(words, folder_.path(), kReportTime, output) != 0)
    throw Refused(422, "no report can be made: " + output.substr(0, output.find('\n')), "look at the log of the run");
  return page;
}

Path Runs::bearing_report(const json& request) {
  const Path model = folder_.resolve(request.at("path").get<std::string>());
  const std::lock_guard lock(reporting_);
  const Path page = next_report();
  const TemporaryFolder temporary;
  const Path text = temporary.file("text");
  write_text(text, request.at("text").get<std::string>());
  std::vector<std::string> words{
      program_.string(), "bearing",  model.string(), "--text",
      text.string(),     "--report", page.string(),  "--bearing=" + request.at("bearing").get<std::string>()};
  for (const json& change : request.value("set", json::array())) words.push_back("--set=" + change.get<std::string>());
  std::string output;
  if (run_to_end(words, folder_.path(), kReportTime, output) != 0)
    throw Refused(422, "no report can be made: " + output.substr(0, output.find('\n')), "change the operating point");
  return page;
}

Path Runs::next_report() {
  if (reports_.empty()) {
    std::string pattern = (std::filesystem::temp_directory_path() / "hersey-reports-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr)
      throw Refused(507, fmt::format("no temporary folder can be made: {}", std::strerror(errno)),
                    "make room on the disk");
    reports_ = pattern;
  }
  return reports_ / fmt::format("{}.html", ++report_count_);
}

void Runs::forget_report(const Path& page) {
  const std::lock_guard lock(reporting_);
  if (reports_.empty() || page.parent_path() != reports_) return;
  std::error_code ignored;
  std::filesystem::remove(page, ignored);
  std::filesystem::remove_all(reports_ / (page.stem().string() + "_fields"), ignored);
}

}  // namespace hersey::workbench
