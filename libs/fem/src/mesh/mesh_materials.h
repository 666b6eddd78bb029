#pragma once

#include "mesh/raw_mesh.h"

namespace hersey::fem {

/// Assigns to each element the material of its section; a file of one material and no section assigns it to all.
/// Sections of materials or sets that the file does not define, elements without a section and elements with two
/// different ones are recorded in RawMesh::material_faults: they matter only where the materials of the file are used.
/// @param marks indices of the marks of each element set: a section of shells that mark faces concerns no solid
void assign_materials(RawMesh& raw, const std::map<std::string, std::vector<int>>& marks, Mesh& mesh);

/// Removes materials that lack a constant and that no element has: the user would be asked for constants that nothing
/// needs.
void drop_unused_materials(Mesh& mesh);

}  // namespace hersey::fem
