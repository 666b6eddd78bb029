#pragma once

#include "mesh/raw_mesh.h"

namespace hersey::fem {

/// Gives each element the material of its section; a file of one material and no section gives it to all. Sections of
/// materials or sets that the file does not define, elements without a section and elements with two different ones go
/// into RawMesh::material_faults: they matter only to whoever takes the materials from the file.
/// @param marks places of the marks of each element set: a section of shells that mark faces concerns no solid
void assign_materials(RawMesh& raw, const std::map<std::string, std::vector<int>>& marks, Mesh& mesh);

/// Leaves out materials that lack a constant and that no element has: they would only be asked for.
void drop_unused_materials(Mesh& mesh);

}  // namespace hersey::fem
