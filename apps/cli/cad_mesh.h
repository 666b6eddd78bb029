#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hersey/fem/mesh.h"

namespace hersey::cli {

/// How a CAD file is meshed.
struct CadOptions {
  double size = 0;         ///< of an element's edges, at most about [m]
  int order = 2;           ///< of the elements, 1 or 2
  int around = 16;         ///< elements around a full turn of a curved surface, at least about
  double time_limit = 0;   ///< [s]
  double length_unit = 0;  ///< of a BREP file, which has none [m]
};

/// Whether a file's ending is that of STEP, IGES or BREP.
[[nodiscard]] bool is_cad_file(const std::filesystem::path& path);
/// BREP files do not tell what their numbers mean.
[[nodiscard]] bool has_no_unit(const std::filesystem::path& path);

/// What of a STEP file's own words is the unit of length, "millimetres"; empty where it does not say.
[[nodiscard]] std::string unit_stated_in(const std::filesystem::path& path);

/// The solids of a CAD file as one mesh in metres, made by the program gmsh on PATH; solids that touch share their
/// nodes. @returns nothing where the user has stopped it.
/// @throws InputError for a file that cannot be read; std::runtime_error where gmsh is missing, fails or takes longer
/// than the limit, with its messages.
[[nodiscard]] std::optional<fem::Mesh> mesh_of_cad(const std::filesystem::path& path, const CadOptions& options);

}  // namespace hersey::cli
