#include "mesh/raw_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace hersey::fem {
void RawMesh::add_node(long label, const Vector3& r, FileLocation location) {
  nodes.push_back(r);
  node_labels.push_back(label);
  node_locations.push_back(location);
}

void RawMesh::add_element(ElementType type, long label, std::span<const long> element_nodes, FileLocation location) {
  RawElement element;
  element.type = type;
  element.label = label;
  element.location = location;
  element.first = connectivity.size();
  elements.push_back(element);
  connectivity.insert(connectivity.end(), element_nodes.begin(), element_nodes.end());
}

void RawMesh::add_mark(long label, std::span<const long> mark_nodes, int corner_count, FileLocation location) {
  RawMark mark;
  mark.label = label;
  mark.location = location;
  mark.node_count = static_cast<int>(mark_nodes.size());
  mark.corner_count = corner_count;
  std::copy(mark_nodes.begin(), mark_nodes.end(), mark.nodes.begin());
  marks.push_back(mark);
}

void RawMesh::add_rigid_tie(long node, const Vector3& r, long body, const Vector3& origin, const Vector3& direction,
                            bool of_rotation, FileLocation location) {
  if (node == body) return;
  RawTie tie{location, {{node, of_rotation, direction}, {body, of_rotation, -direction}}};
  // e . (theta x (r - o)) = theta . ((r - o) x e)
  if (!of_rotation) tie.terms.push_back({body, true, -(r - origin).cross(direction)});
  ties.push_back(std::move(tie));
}

long RawMesh::new_reference() { return std::numeric_limits<long>::min() + references_++; }

MeshMaterial& RawMesh::add_material(const std::string& name, FileLocation location) {
  for (std::size_t m = 0; m < materials.size(); ++m)
    if (materials[m].name == name)
      fail(location, fmt::format("material '{}' is already defined in line {}", name, material_locations[m].line),
           "each material once");
  material_locations.push_back(location);
  materials.emplace_back().name = name;
  return materials.back();
}

Fault RawMesh::fault(FileLocation location, std::string found, std::string expected, std::string suggestion) const {
  return {{files[static_cast<std::size_t>(location.file)], location.line, 0},
          "",
          std::move(found),
          std::move(expected),
          std::move(suggestion)};
}

void RawMesh::warn(FileLocation location, std::string found, std::string expected, std::string suggestion) {
  warnings.push_back(fault(location, std::move(found), std::move(expected), std::move(suggestion)));
}

void RawMesh::fail(FileLocation location, std::string found, std::string expected, std::string suggestion) const {
  throw InputError(fault(location, std::move(found), std::move(expected), std::move(suggestion)));
}

}  // namespace hersey::fem
