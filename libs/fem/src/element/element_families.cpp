#include "element/element_families.h"

#include <algorithm>

#include "hersey/core/contract.h"

namespace hersey::fem {

const std::vector<ElementKind>& element_kinds() {
  static const std::vector<ElementKind> all = [] {
    std::vector<ElementKind> kinds;
    for (const auto& family : element_families)
      for (ElementKind& kind : family()) kinds.push_back(std::move(kind));
    std::sort(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a.type < b.type; });
    return kinds;
  }();
  return all;
}

const ElementKind& kind_of(ElementType type) { return element_kinds()[static_cast<std::size_t>(type)]; }

std::vector<ElementKind> beams() {
  return {{.type = ElementType::beam2, .name = "beam2", .nodes = 2, .corners = 2, .files = {.vtk = 3}}};
}

int node_count(ElementType type) { return kind_of(type).nodes; }
int face_count(ElementType type) { return static_cast<int>(kind_of(type).faces.size()); }
const char* name_of(ElementType type) { return kind_of(type).name; }
const std::vector<int>& face_nodes(ElementType type, int face) {
  return kind_of(type).faces[static_cast<std::size_t>(face)];
}

ShapeFunctions shape_functions(ElementType type, const Vector3& xi) {
  const ElementKind& kind = kind_of(type);
  HERSEY_REQUIRE(kind.shape, "a beam is no solid");
  return kind.shape(xi);
}

Eigen::Matrix3Xd natural_nodes(ElementType type) {
  const ElementKind& kind = kind_of(type);
  HERSEY_REQUIRE(kind.shape, "a beam is no solid");
  return kind.natural_nodes;
}

const std::vector<QuadraturePoint>& stiffness_points(ElementType type, Integration rule) {
  const ElementKind& kind = kind_of(type);
  HERSEY_REQUIRE(kind.shape, "a beam is no solid");
  return rule == Integration::full ? kind.stiffness_points : kind.reduced_points;
}

const std::vector<QuadraturePoint>& mass_points(ElementType type) {
  const ElementKind& kind = kind_of(type);
  HERSEY_REQUIRE(kind.shape, "a beam is no solid");
  return kind.mass_points;
}

}  // namespace hersey::fem
