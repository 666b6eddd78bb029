#pragma once

#include <string_view>

namespace hersey::workbench {

/// A file of the page, built by web/ and committed; empty content if there is no file of this path.
struct Asset {
  std::string_view content, type;
};

/// @param path  "/", "/workbench.js" or "/workbench.css"
[[nodiscard]] Asset asset(std::string_view path);

}  // namespace hersey::workbench
