#pragma once

#include <optional>
#include <string>

#include "hersey/mbd/shape.h"

namespace hersey::model {

struct StlResult {
  mbd::TriangleMesh mesh;  ///< corners that coincide are one
  std::string fault;       ///< what is wrong with the file; empty: nothing
};

/// Reads the content of an STL file, text or binary; lengths as in the file.
[[nodiscard]] StlResult parse_stl(const std::string& content);

}  // namespace hersey::model
