#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace hersey::report {

/// The report's page with `data` in its data element. @throws results::WriteError if `out` cannot be written.
void write_page(const nlohmann::json& data, const std::filesystem::path& out);

}  // namespace hersey::report
