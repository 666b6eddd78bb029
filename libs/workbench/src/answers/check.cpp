#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "answers/kept.h"
#include "answers/repairs.h"
#include "answers/request.h"
#include "answers/scene.h"
#include "hersey/model/read.h"
#include "hersey/model/study.h"
#include "hersey/model/text_map.h"
#include "hersey/run/simulate.h"
#include "hersey/session/session.h"
#include "hersey/workbench/answers.h"

namespace hersey::workbench {
namespace {

using Clock = std::chrono::steady_clock;
using model::TextEntry;
using model::TextMap;

constexpr std::size_t kDeepestOutline = 2;
constexpr std::size_t kMostListed = 500;  // of faults, warnings, missing parts and parts of the outline each

/// Runs that the study of a model would do, without reading each of them.
std::size_t count_runs(const model::Model& model) {
  if (!model.study) return 1;
  const model::Study& study = *model.study;
  if (!study.is_written_out()) return static_cast<std::size_t>(std::max(study.samples, 1));
  std::size_t runs = 1;
  for (const model::StudyParameter& parameter : study.parameters) {
    const std::size_t values = std::max<std::size_t>(parameter.values.size(), 1);
    runs = study.plan == model::StudyPlan::list ? std::max(runs, values) : runs * values;
  }
  return runs;
}

std::vector<std::string> missing_of_model(const model::Model& model) {
  std::vector<std::string> missing;
  if (!model.is_of_bearings_alone()) return missing;
  const bool has_point =
      std::any_of(model.bearings.begin(), model.bearings.end(),
                  [](const model::Bearing& bearing) { return bearing.operating_point.has_value(); }) ||
      std::any_of(model.composites.begin(), model.composites.end(),
                  [](const auto& composite) { return composite.bearing.operating_point.has_value(); });
  if (!has_point) missing.emplace_back("bearings: an `operating_point` of a bearing, to solve it by itself");
  missing.emplace_back("bodies: at least one body, to run the bearings in a machine");
  missing.emplace_back("simulation: `duration` and `step`, to run it");
  return missing;
}

std::vector<std::string> missing_of_faults(const std::vector<Fault>& faults) {
  std::vector<std::string> missing;
  for (const Fault& fault : faults) {
    const bool is_key = fault.found.starts_with("missing key '");
    const bool is_one_of_keys = fault.found.starts_with("none of the keys ");
    if (!is_key && !is_one_of_keys) continue;
    const std::string where = fault.path.empty() ? "the model" : fault.path;
    const std::string what = is_key ? fault.found.substr(12) : "one of " + fault.found.substr(17);
    missing.push_back(where + ": " + what + (is_key ? " - " + fault.expected : ""));
    if (missing.size() == kMostListed) break;
  }
  return missing;
}

/// Parameters as they are written, of a text that need not be a good model.
Json parameters_in(const TextMap& map) {
  Json parameters = Json::object();
  const TextEntry* section = map.find("parameters");
  if (section == nullptr) return parameters;
  for (const std::size_t child : section->children) {
    const TextEntry& entry = map.entries()[child];
    const std::size_t begin = map.offset(entry.value_at.line, entry.value_at.column);
    parameters[entry.key] =
        map.text().substr(begin, map.offset(entry.value_at.end_line, entry.value_at.end_column) - begin);
  }
  return parameters;
}

Json parameters_of(const model::Model& model) {
  Json parameters = Json::object();
  for (const model::Parameter& parameter : model.parameters) parameters[parameter.name] = parameter.text;
  return parameters;
}

/// @param left_out  number of parts that are too many to be listed
Json outline_of(const TextMap& map, const TextColumns& columns, std::size_t& left_out) {
  Json outline = Json::array();
  for (const TextEntry& entry : map.entries()) {
    if (entry.path.empty() || map.entries()[entry.parent].kind == TextEntry::Kind::list) continue;
    const auto depth = static_cast<std::size_t>(std::count(entry.path.begin(), entry.path.end(), '.')) + 1;
    if (depth > kDeepestOutline) continue;
    if (outline.size() == kMostListed) {
      ++left_out;
      continue;
    }
    outline.push_back({{"path", entry.path},
                       {"line", entry.key_at.line},
                       {"column", columns.utf16(entry.key_at.line, entry.key_at.column)},
                       {"endLine", std::max(entry.key_at.line, entry.value_at.end_line)}});
  }
  return outline;
}

/// What has been found out about a text.
struct Findings {
  std::vector<Fault> faults, warnings;
  std::shared_ptr<const session::Session> session;  // null where it cannot be read
  std::size_t runs = 1;

  [[nodiscard]] const model::Model* model() const { return session ? &session->model() : nullptr; }
};

/// Reads a text unless `known` is its session, and with `starts` finds the starts of its runs.
Findings examine(const model::ModelFile& file, const std::vector<std::string>& set, bool starts, Kept& kept,
                 std::shared_ptr<const session::Session> known) {
  Findings found;
  try {
    if (known)
      found.session = std::move(known);
    else
      found.session = set.empty() ? kept.read_session(file) : std::make_shared<const session::Session>(file, set);
    const model::Model& model = found.session->model();
    found.runs = count_runs(model);
    found.warnings = model.warnings;
    if (!starts) return found;
    session::Check check = found.session->check();
    found.warnings = std::move(check.warnings);
    if (!model.study || model.study->is_written_out()) found.runs = check.runs;
  } catch (const InputError& error) {
    found.faults = error.faults();
  }
  return found;
}

std::string scene_of(const model::Model& model, const TextMap& map, const TextColumns& columns) {
  try {
    return scene_json(model, run::Picture(model), map, columns);
  } catch (const InputError&) {
    return "null";  // no mechanism: the faults say why
  }
}

}  // namespace

std::string Answers::check(std::string_view request) const {
  const Clock::time_point began = Clock::now();
  const Json given = request_object(request);
  const std::string text = text_in(given, "text"), file = kept_->file(text_in(given, "path"));
  const std::string depth = text_in(given, "depth", "start");
  if (depth != "text" && depth != "start")
    throw Refused(400, "The depth '" + depth + "' of a check is unknown.", "Ask for 'text' or 'start'.");
  const std::vector<std::string> set = texts_in(given, "set");
  std::shared_ptr<const session::Session> known = set.empty() ? kept_->known_session(text, file) : nullptr;
  const model::ModelFile opened = known ? known->source() : model::ModelFile(text, file);
  const Findings found = examine(opened, set, depth == "start", *kept_, std::move(known));
  const model::Model* model = found.model();
  // Who asks again, about the start, has the picture already.
  const bool is_drawn = given.value("scene", true);
  const bool needs_map = is_drawn || model == nullptr || !found.faults.empty() || !found.warnings.empty();
  const std::optional<TextMap> map = needs_map ? opened.map() : std::nullopt;
  const TextColumns columns(text);
  const auto listed = [&](const std::vector<Fault>& faults) {
    Json list = Json::array();
    for (std::size_t i = 0; i < std::min(faults.size(), kMostListed); ++i)
      list.push_back(json_of(faults[i], text, map ? &*map : nullptr, columns, file, kept_->folder()));
    return list;
  };
  Json answer{{"faults", listed(found.faults)}, {"warnings", listed(found.warnings)}, {"runs", found.runs}};
  if (model != nullptr)
    answer["parameters"] = parameters_of(*model);
  else
    answer["parameters"] = map ? parameters_in(*map) : Json::object();
  answer["missing"] = model != nullptr ? missing_of_model(*model) : missing_of_faults(found.faults);
  std::size_t outline_left_out = 0;
  answer["outline"] = map && is_drawn ? outline_of(*map, columns, outline_left_out) : Json::array();
  const auto beyond = [](std::size_t count) { return count - std::min(count, kMostListed); };
  answer["left_out"] = {{"faults", beyond(found.faults.size())},
                        {"warnings", beyond(found.warnings.size())},
                        {"outline", outline_left_out}};
  answer["depth"] = depth;
  const std::string scene = is_drawn && model != nullptr && map ? scene_of(*model, *map, columns) : "null";
  answer["time"] = std::chrono::duration<double>(Clock::now() - began).count();
  std::string whole = dumped(answer);
  whole.back() = ',';
  return whole + "\"scene\":" + scene + "}";
}

}  // namespace hersey::workbench
