#pragma once

#include <string>
#include <string_view>

#include "hersey/fem/include_loader.h"
#include "mesh/raw_mesh.h"

namespace hersey::fem {

/// The readers of the three formats; each @throws InputError at the first thing it cannot read.
[[nodiscard]] RawMesh read_gmsh(std::string_view text, const std::string& name);
[[nodiscard]] RawMesh read_abaqus(std::string_view text, const std::string& name, const IncludeLoader& include,
                                  const std::string& part);
[[nodiscard]] RawMesh read_nastran(std::string_view text, const std::string& name, const IncludeLoader& include);

/// Returns the text of an included file at a depth from 0.
/// @throws std::runtime_error that says what was found instead
[[nodiscard]] std::string included_text(const IncludeLoader& include, const std::string& name, int depth);

inline constexpr const char* kIncludeExpected = "a file in the mesh's folder, at most 8 deep";

}  // namespace hersey::fem
