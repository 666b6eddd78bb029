#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/fem/include_loader.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Formats of mesh files: Gmsh .msh (2.2 and 4.1, ASCII), Abaqus and CalculiX .inp, Nastran bulk data .bdf, .nas, .dat.
enum class MeshFormat { gmsh, abaqus, nastran };

/// Returns the format of a file by its ending; none for an unknown ending.
[[nodiscard]] std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path);

/// Reads a mesh file in the format given by its ending (docs/mesh-files.md says what is read of each format).
///
/// Elements are in Abaqus' node order, named sets and surfaces as in the file; every element set and surface without a
/// node set of its name gets one, of its nodes. Nodes that no element uses are dropped with a warning. Files are
/// included from the mesh's own folder and below it only, unless HERSEY_INCLUDE_ANYWHERE is 1 in the environment.
/// @param length_unit metres in one unit of the file (0.001 for millimetres). Materials are taken to be in the
/// consistent system of that length, newton and second: with millimetres MPa and t/mm^3.
/// @param warnings receives what the file contains and this reader ignores; nullptr: not reported.
/// @param material_faults receives the reasons why elements have no material, or more than one: sections of materials
/// or sets that the file does not define, elements without a section. They matter only where the materials of the file
/// are used; nullptr: not reported.
/// @param part name of the part to read from an Abaqus file with several parts; empty: the file has one part.
/// @throws InputError with file and line: what was found, what is allowed.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path, double length_unit,
                             std::vector<Fault>* warnings = nullptr, std::vector<Fault>* material_faults = nullptr,
                             const std::string& part = {});

/// Reads the mesh from the text of a file called `name` in messages.
[[nodiscard]] Mesh parse_mesh(std::string_view text, MeshFormat format, const std::string& name, double length_unit,
                              std::vector<Fault>* warnings = nullptr, const IncludeLoader& include = {},
                              std::vector<Fault>* material_faults = nullptr, const std::string& part = {});

}  // namespace hersey::fem
