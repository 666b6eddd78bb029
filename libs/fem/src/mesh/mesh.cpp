#include "hersey/fem/mesh.h"

#include "element/element_kind.h"

namespace hersey::fem {

int node_count(ElementType type) { return kind_of(type).nodes; }
int face_count(ElementType type) { return static_cast<int>(kind_of(type).faces.size()); }
const char* name_of(ElementType type) { return kind_of(type).name; }
const std::vector<int>& face_nodes(ElementType type, int face) {
  return kind_of(type).faces[static_cast<std::size_t>(face)];
}

}  // namespace hersey::fem
