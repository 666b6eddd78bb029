#include "runs/study_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "hersey/workbench/refused.h"

namespace hersey::workbench {
namespace {

using nlohmann::json;

constexpr int kMostJobs = 4096;  // at the same time

std::string study_text(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

double study_number(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : 0;
}

bool is_number_of_jobs(double jobs) { return jobs >= 1 && jobs <= kMostJobs; }

/// A name that no program takes for an option.
bool is_partition(const std::string& name) {
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  return !name.empty() && name.size() <= 60 && name.front() != '-' && std::all_of(name.begin(), name.end(), is_plain);
}

}  // namespace

void note_study(const json& request, json& record) {
  record["study"] = true;
  record["on"] = study_text(request, "on") == "slurm" ? "slurm" : "local";
  if (const double jobs = study_number(request, "jobs"); jobs != 0) {
    if (!is_number_of_jobs(jobs))
      throw Refused(422, fmt::format("{} jobs at the same time", jobs),
                    fmt::format("a number from 1 to {}", kMostJobs));
    record["jobs"] = static_cast<int>(jobs);
  }
  if (const std::string partition = study_text(request, "partition"); !partition.empty()) {
    if (!is_partition(partition))
      throw Refused(422, fmt::format("'{}' is no name of a partition", partition), "letters, digits, - and _");
    record["partition"] = partition;
  }
}

void add_study_words(const json& record, std::vector<std::string>& words) {
  words.insert(words.end(), {"--on", study_text(record, "on") == "slurm" ? "slurm" : "local"});
  if (const double jobs = study_number(record, "jobs"); is_number_of_jobs(jobs))
    words.push_back(fmt::format("--jobs={:.0f}", jobs));
  if (const std::string partition = study_text(record, "partition"); is_partition(partition))
    words.push_back("--partition=" + partition);
}

}  // namespace hersey::workbench
