#pragma once

#include <string>
#include <string_view>

namespace hersey::results {

/// The path of an object in a file, from its root.
[[nodiscard]] inline std::string absolute(std::string_view path) {
  return path.starts_with('/') ? std::string(path) : "/" + std::string(path);
}

}  // namespace hersey::results
