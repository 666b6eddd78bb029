#include "mesh/gmsh_types.h"

namespace hersey::fem {

const std::vector<GmshSolid>& gmsh_solids() {
  static const std::vector<GmshSolid> solids = {
      {ElementType::tet4, 4, {}},
      {ElementType::hex8, 5, {}},
      {ElementType::wedge6, 6, {}},
      {ElementType::tet10, 11, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
      {ElementType::hex20, 17, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15}},
      {ElementType::wedge15, 18, {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11}},
  };
  return solids;
}

}  // namespace hersey::fem
