#pragma once

#include <algorithm>
#include <string>

namespace hersey::run {

/// "/bearings/big_end/h_min" as "bearings.big_end.h_min".
[[nodiscard]] inline std::string output_name(const std::string& path) {
  std::string name = path.substr(1);
  std::replace(name.begin(), name.end(), '/', '.');
  return name;
}

/// True of rows that grow step by step, not of fields and cycles, which have instants of their own.
[[nodiscard]] inline bool is_row_of_steps(const std::string& path) {
  return path.find("/fields/") == std::string::npos && path.find("/cycles/") == std::string::npos;
}

}  // namespace hersey::run
