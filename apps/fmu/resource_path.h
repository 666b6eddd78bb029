#pragma once

#include <filesystem>
#include <string>

namespace hersey::fmu {

/// The path of "file:///tmp/a%20b/resources"; a plain path stays as it is.
/// @throws std::invalid_argument for other schemes
[[nodiscard]] std::filesystem::path path_of_uri(const std::string& uri);

}  // namespace hersey::fmu
