#pragma once

#include <string_view>

namespace hersey::workbench {

/// A file of the page, built by web/ and committed; empty content if there is no file of this path.
struct Asset {
  std::string_view content, type;
};

/// @param path  "/", "/workbench.js", "/workbench.css" or "/licences.txt"
[[nodiscard]] Asset asset(std::string_view path);

}  // namespace hersey::workbench
