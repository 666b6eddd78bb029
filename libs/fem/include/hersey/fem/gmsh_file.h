#pragma once

#include <filesystem>

#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Writes a mesh of solids in Gmsh's format 2.2, ASCII, in metres: `read_mesh` with 1 m returns the same nodes,
/// elements, sets and surfaces. Materials are not written because the format has none.
/// @pre no beams. @throws std::runtime_error where it cannot be written. @verified_by gmsh_file_test.cpp
void write_gmsh(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace hersey::fem
