#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hersey/fem/mesh.h"

namespace hersey::cli {

/// Options for meshing a CAD file.
struct CadOptions {
  double size = 0;         ///< of an element's edges, at most about [m]
  int order = 2;           ///< of the elements, 1 or 2
  int around = 16;         ///< least approximate number of elements around a full circle of a curved surface
  double time_limit = 0;   ///< [s]
  double length_unit = 0;  ///< of a BREP file, which has none [m]
};

/// True if a file's ending is that of STEP, IGES or BREP.
[[nodiscard]] bool is_cad_file(const std::filesystem::path& path);
/// True for BREP files, which do not state their unit of length.
[[nodiscard]] bool has_no_unit(const std::filesystem::path& path);

/// Returns the unit of length that a STEP file states, "millimetres"; empty if it states none.
[[nodiscard]] std::string unit_stated_in(const std::filesystem::path& path);

/// Returns the solids of a CAD file as one mesh in metres, made by the program gmsh on PATH; solids that touch share
/// their nodes.
/// @returns nothing if the user has stopped it.
/// @throws InputError for a file that cannot be read; std::runtime_error with gmsh's messages if it is missing, fails
///         or takes longer than the limit.
[[nodiscard]] std::optional<fem::Mesh> mesh_of_cad(const std::filesystem::path& path, const CadOptions& options);

}  // namespace hersey::cli
