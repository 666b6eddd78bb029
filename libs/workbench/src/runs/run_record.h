#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "runs/process.h"

/// Records and events of runs, JSON that may have been cut off, or written by someone else: what is not as it should be
/// reads as empty or 0.
namespace hersey::workbench {

[[nodiscard]] double seconds_since_1970();
/// An object from a line; null if it is none.
[[nodiscard]] nlohmann::json object_of(const std::string& text);
[[nodiscard]] std::string record_text(const nlohmann::json& object, const char* key);
[[nodiscard]] double record_number(const nlohmann::json& object, const char* key);
[[nodiscard]] std::vector<std::string> record_texts(const nlohmann::json& object, const char* key);
[[nodiscard]] bool record_flag(const nlohmann::json& object, const char* key);
[[nodiscard]] ProcessId process_in(const nlohmann::json& record);

/// What run.json holds; null if it is no record.
[[nodiscard]] nlohmann::json record_in(const std::filesystem::path& file);
/// @throws Refused 507
void write_record(const std::filesystem::path& file, const nlohmann::json& record);
/// @throws Refused 507
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace hersey::workbench
