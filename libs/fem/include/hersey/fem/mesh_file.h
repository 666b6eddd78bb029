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

/// The format that a file's ending tells; none for an unknown ending.
[[nodiscard]] std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path);

/// Reads a mesh file in the format that its ending tells (docs/mesh-files.md says what of each format is read).
///
/// Elements are in Abaqus' node order, named sets and surfaces as in the file; every element set and surface without a
/// node set of its name gets one, of its nodes. Nodes that no element uses are left out with a warning. Files are
/// included from the mesh's own folder and below it only, unless HERSEY_INCLUDE_ANYWHERE is 1 in the environment.
/// @param length_unit metres in one unit of the file (0.001 for millimetres). Materials are taken to be in the
///   consistent system of that length, newton and second: with millimetres MPa and t/mm^3.
/// @param warnings what the file says and this reader leaves out is added here; nullptr: dropped.
/// @param material_faults why elements have no material, or more than one, is added here: sections of materials or sets
///   that the file does not define, elements without a section. For whoever computes with the materials of the file;
///   nullptr: dropped.
/// @param part of an Abaqus file with several: the name of the one that is read; empty: it has no other.
/// @throws InputError with file and line: what was found, what is allowed.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path, double length_unit,
                             std::vector<Fault>* warnings = nullptr, std::vector<Fault>* material_faults = nullptr,
                             const std::string& part = {});

/// The same from the text of a file called `name` in messages.
[[nodiscard]] Mesh parse_mesh(std::string_view text, MeshFormat format, const std::string& name, double length_unit,
                              std::vector<Fault>* warnings = nullptr, const IncludeLoader& include = {},
                              std::vector<Fault>* material_faults = nullptr, const std::string& part = {});

}  // namespace hersey::fem
