#pragma once

#include <vector>

#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Gmsh's number of a solid's shape, and the place in Gmsh's numbering of each of its nodes in Abaqus' order.
struct GmshSolid {
  ElementType type = ElementType::tet4;
  long number = 0;
  std::vector<int> order;  ///< empty: the same
};

/// All solids that are read and written. @see Gmsh reference manual 4.8, sections "Node ordering", "MSH file format"
[[nodiscard]] const std::vector<GmshSolid>& gmsh_solids();

}  // namespace hersey::fem
