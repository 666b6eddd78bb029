#pragma once

#include <cstddef>
#include <string>

#include "hersey/mbd/shape.h"

namespace hersey::model {

struct StlResult {
  mbd::TriangleMesh mesh;  ///< corners that coincide are one
  std::string fault;       ///< fault of the file, with the line of a text; empty: none
  std::size_t flat = 0;    ///< triangles without area, which are left out of the mesh
  std::size_t facets = 0;  ///< of the file
};

/// Reads the content of an STL file, text or binary; lengths as in the file. A file that is cut short, has facets that
/// are no triangles, or says anything else than STL does, is a fault.
[[nodiscard]] StlResult parse_stl(const std::string& content);

}  // namespace hersey::model
