#include "runs/run_record.h"

#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "hersey/core/write_file.h"
#include "hersey/workbench/refused.h"
#include "runs/run_files.h"

namespace hersey::workbench {
namespace {

using nlohmann::json;
using Path = std::filesystem::path;

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

}  // namespace

double seconds_since_1970() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

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

json record_in(const Path& file) {
  constexpr std::uintmax_t kMostRecord = 1 << 20;
  return object_of(part_of(file, 0, kMostRecord));
}

void write_record(const Path& file, const json& record) {
  write_text(file, record.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
}

void write_text(const Path& file, const std::string& text) {
  try {
    write_file(file, {text});
  } catch (const std::runtime_error& error) {
    throw Refused(507, error.what(), "make room on the disk, then start the run again");
  }
}

}  // namespace hersey::workbench
