#pragma once

#include <string>
#include <string_view>

#include "hersey/fem/mesh_file.h"
#include "raw_mesh.h"

namespace hersey::fem {

/// The readers of the three formats; each @throws InputError at the first thing it cannot read.
[[nodiscard]] RawMesh read_gmsh(std::string_view text, const std::string& name);
[[nodiscard]] RawMesh read_abaqus(std::string_view text, const std::string& name, const IncludeLoader& include);
[[nodiscard]] RawMesh read_nastran(std::string_view text, const std::string& name, const IncludeLoader& include);

}  // namespace hersey::fem
