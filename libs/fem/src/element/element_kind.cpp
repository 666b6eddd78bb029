#include "element/element_kind.h"

#include <algorithm>

#include "element/element_families.h"

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

}  // namespace hersey::fem
