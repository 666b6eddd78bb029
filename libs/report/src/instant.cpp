#include "hersey/report/instant.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base64.h"

namespace hersey::report {
namespace {

using Json = nlohmann::json;
using Groups = std::map<std::string, const std::map<std::string, results::Kept::Attribute>*>;

// Written as it goes, not by way of a tree of values: a machine of a thousand bodies has 15,000 datasets, and is asked
// for with every key that is typed.

std::string json_text(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

void append_quoted(std::string_view text, std::string& json) {
  const auto is_plain = [](unsigned char c) { return c >= 0x20 && c < 0x7f && c != '"' && c != '\\'; };
  if (!std::all_of(text.begin(), text.end(), is_plain)) {
    json += json_text(text);
    return;
  }
  json += '"';
  json.append(text).append("\"");
}

/// Puts a comma before all members of an object but the first.
void append_key(std::string_view key, std::string& json) {
  if (json.back() != '{') json += ',';
  append_quoted(key, json);
  json += ':';
}

void append_attributes(const Groups& groups, std::string& json) {
  json += '{';
  for (const auto& [path, attributes] : groups) {
    append_key(path, json);
    json += '{';
    if (attributes != nullptr)
      for (const auto& [name, attribute] : *attributes) {
        append_key(name, json);
        json += std::visit([](const auto& value) { return json_text(value); }, attribute);
      }
    json += '}';
  }
  json += '}';
}

void append_dataset(const std::string& path, const std::vector<std::size_t>& shape, const std::string& unit,
                    bool is_exact, const std::vector<double>& values, std::string& json) {
  append_key(path, json);
  json += "{\"unit\":";
  append_quoted(unit, json);
  json += ",\"shape\":[";
  for (const std::size_t size : shape) json.append(json.back() == '[' ? "" : ",").append(std::to_string(size));
  json += is_exact ? "],\"type\":\"f8\",\"data\":\"" : "],\"type\":\"f4\",\"data\":\"";
  json += is_exact ? base64_float64(values) : base64_float32(values);
  json += "\"}";
}

}  // namespace

std::string instant_json(const results::Writer& writer, const std::string& name) {
  const std::vector<results::LatestRow> rows = writer.latest();
  Groups groups;
  std::string_view last;
  // Groups are known by their attributes: those above have none of their own.
  const auto add_groups = [&](const std::string& path) {
    const std::string_view parent = std::string_view(path).substr(0, path.rfind('/'));
    if (parent == last) return;  // of the dataset before
    last = parent;
    for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1))
      groups.try_emplace(path.substr(0, slash), nullptr);
  };
  for (const auto& [object, named] : writer.kept().attributes) {
    if (object != "/") add_groups(object);
    groups[object] = &named;
  }
  for (const auto& [path, constant] : writer.kept().constants) add_groups(path);
  for (const results::LatestRow& row : rows) add_groups(row.path);
  std::string json = "{\"file\":";
  append_quoted(name, json);
  append_key("name", json);
  append_quoted(name, json);
  for (const char* key : {"rows", "series_stride", "field_stride", "around_stride"}) {
    append_key(key, json);
    json += '1';
  }
  json += ",\"assumptions\":[],\"summary\":[],\"attributes\":";
  append_attributes(groups, json);
  json += ",\"datasets\":{";
  for (const auto& [path, constant] : writer.kept().constants) {
    const bool is_exact = constant.values.size() <= 16;  // positions and axes; shapes are large and only drawn
    append_dataset(path, {constant.values.size()}, constant.unit, is_exact, constant.values, json);
  }
  for (const results::LatestRow& row : rows) {
    if (row.values.empty()) continue;
    std::vector<std::size_t> shape{1};
    shape.insert(shape.end(), row.shape.begin(), row.shape.end());
    append_dataset(row.path, shape, row.unit, true, row.values, json);
  }
  return json + "}}";
}

}  // namespace hersey::report
