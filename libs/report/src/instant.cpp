#include "hersey/report/instant.h"

#include <nlohmann/json.hpp>

#include "base64.h"

namespace hersey::report {
namespace {

using Json = nlohmann::json;

Json as_json(const results::Kept::Attribute& attribute) {
  return std::visit([](const auto& value) { return Json(value); }, attribute);
}

Json as_dataset(std::vector<std::size_t> shape, const std::string& unit, const std::string& text,
                const std::vector<double>& values) {
  return {{"unit", unit},
          {"description", text},
          {"shape", std::move(shape)},
          {"type", "f8"},
          {"data", base64_float64(values)}};
}

}  // namespace

std::string instant_json(const results::Writer& writer, const std::string& name) {
  Json run{{"file", name},
           {"name", name},
           {"rows", 1},
           {"series_stride", 1},
           {"field_stride", 1},
           {"around_stride", 1},
           {"assumptions", Json::array()},
           {"summary", Json::array()},
           {"attributes", Json::object()},
           {"datasets", Json::object()}};
  Json& attributes = run["attributes"];
  // Groups are known by their attributes: those above have none of their own.
  const auto add_groups = [&](const std::string& path) {
    for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1))
      attributes.emplace(path.substr(0, slash), Json::object());
  };
  for (const auto& [object, named] : writer.kept().attributes) {
    add_groups(object + "/");
    for (const auto& [key, value] : named) attributes[object][key] = as_json(value);
  }
  for (const auto& [path, constant] : writer.kept().constants) {
    add_groups(path);
    const bool is_exact = constant.values.size() <= 16;  // positions and axes; shapes are large and only drawn
    Json dataset = as_dataset({constant.values.size()}, constant.unit, constant.text, {});
    dataset["type"] = is_exact ? "f8" : "f4";
    dataset["data"] = is_exact ? base64_float64(constant.values) : base64_float32(constant.values);
    run["datasets"][path] = std::move(dataset);
  }
  for (const results::LatestRow& row : writer.latest()) {
    add_groups(row.path);
    if (row.values.empty()) continue;
    std::vector<std::size_t> shape{1};
    shape.insert(shape.end(), row.shape.begin(), row.shape.end());
    run["datasets"][row.path] = as_dataset(std::move(shape), row.unit, row.text, row.values);
  }
  return run.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace hersey::report
