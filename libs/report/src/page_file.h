#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace hersey::report {

/// The report's page with `data` in its data element. @throws results::WriteError if `out` cannot be written.
void write_page(const nlohmann::json& data, const std::filesystem::path& out);

/// A script that calls a function of the page: pages opened from a folder load scripts, and no other files.
/// @throws results::WriteError if `out` cannot be written.
void write_script(const std::string& function, const nlohmann::json& argument, const std::filesystem::path& out);

}  // namespace hersey::report
