#include "time_stepping/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>

#include "hersey/core/input_error.h"
#include "hersey/core/input_file.h"
#include "hersey/core/version.h"
#include "hersey/results/checkpoint.h"
#include "hersey/results/reader.h"
#include "hersey/results/writer.h"
#include "hersey/run/checkpoint.h"

namespace hersey::run {
namespace {

constexpr double kLongStep = 0.5;      // [s]
constexpr double kLargestShare = 0.1;  // of a long step, for the checkpoint behind it

constexpr const char* kModel = "identity/model";
constexpr const char* kVersion = "identity/version";
constexpr const char* kFiles = "identity/files/";

std::string digits(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

[[noreturn]] void refuse(const model::Model& model, const std::string& difference) {
  throw InputError(Fault{{model.file, 0, 0},
                         "",
                         "a model that has changed since the run began: " + difference,
                         "the model and the overrides of that run",
                         "run it anew with --force, or undo the change"});
}

}  // namespace

CheckpointSchedule::CheckpointSchedule(const model::Simulation& plan)
    : plan_(plan.checkpoint),
      start_(plan.start),
      slack_(1e-9 * plan.step),
      next_(plan_.every > 0 ? start_ + plan_.every : std::numeric_limits<double>::infinity()) {}

bool CheckpointSchedule::is_due(double t) {
  const Clock::time_point now = Clock::now();
  const std::chrono::duration<double> since = now - last_, step = now - std::exchange(step_, now);
  const bool was_long = step.count() > kLongStep && cost_ < kLargestShare * step.count();
  return was_long || t >= next_ - slack_ || since.count() >= plan_.wall_time;
}

void CheckpointSchedule::written(double t, double cost) {
  last_ = step_ = Clock::now();
  cost_ = cost;
  if (plan_.every > 0) next_ = start_ + plan_.every * (std::floor((t - start_ + slack_) / plan_.every) + 1);
}

void save_identity(Archive& archive, const model::Model& model) {
  std::string text = model.resolved_text, program = version();
  archive.io(kModel, text);
  archive.io(kVersion, program);
  for (const auto& [name, hash] : model.files) {
    std::string value = digits(hash);
    const Archive::Group group(archive, "identity");
    const Archive::Group files(archive, "files");
    const Archive::Group file(archive, name);
    archive.io("content", value);
  }
}

std::string difference_of(const std::string& before, const std::string& now) {
  if (before == now) return {};
  std::istringstream old_lines(before), new_lines(now);
  std::string was, is;
  for (int line = 1;; ++line) {
    const bool had = static_cast<bool>(std::getline(old_lines, was));
    const bool has = static_cast<bool>(std::getline(new_lines, is));
    if (!had && !has) return "the end of its last line";
    if (!has) return fmt::format("line {} was '{}' and is gone", line, was);
    if (!had) return fmt::format("line {}, '{}', is new", line, is);
    if (was != is) return fmt::format("line {} was '{}' and is '{}'", line, was, is);
  }
}

bool is_identity(const std::string& name) { return name.starts_with("identity/"); }

void require_same_text(const std::string& before, const model::Model& model) {
  if (const std::string difference = difference_of(before, model.resolved_text); !difference.empty())
    refuse(model, difference);
}

void require_identity(const Archive::Content& stored, const model::Model& model, const std::filesystem::path& file,
                      std::string& warning) {
  const auto text = [&](const std::string& name) {
    const auto found = stored.texts.find(name);
    return found == stored.texts.end() ? std::string() : found->second;
  };
  require_same_text(text(kModel), model);
  Archive now;
  save_identity(now, model);
  for (const auto& [name, value] : now.content().texts)
    if (name.starts_with(kFiles) && text(name) != value) {
      const std::string path = name.substr(std::string(kFiles).size());
      refuse(model, "the content of " + path.substr(0, path.rfind('/')));
    }
  if (const std::string before = text(kVersion); before != version())
    warning = fmt::format("{} was written by hersey {}, this is {}: numbers may differ in their last digits",
                          file.string(), before, version());
}

bool is_complete(const model::Model& model, const std::filesystem::path& results) {
  const results::Reader reader(results);
  // The program was killed before the model was written, so there is nothing that could belong to another model.
  if (!reader.has("/model")) return false;
  require_same_text(reader.text("/model"), model);
  return reader.text_attribute("/", "status") == results::to_string(results::Status::completed);
}

bool has_results(const std::filesystem::path& results) {
  if (unreadable(results)) return false;
  std::ifstream stream(results, std::ios::binary);
  std::array<char, 8> first{};
  stream.read(first.data(), first.size());
  return std::any_of(first.begin(), first.end(), [](char byte) { return byte != 0; });
}

void discard_checkpoint(const std::filesystem::path& results) { results::remove_checkpoint(checkpoint_file(results)); }

std::filesystem::path checkpoint_file(const std::filesystem::path& results) {
  std::filesystem::path path = results;
  path.replace_extension(".checkpoint");
  return path;
}

}  // namespace hersey::run
