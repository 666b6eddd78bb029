#pragma once

#include <array>

#include "element/element_kind.h"

namespace hersey::fem {

std::vector<ElementKind> tetrahedra();
std::vector<ElementKind> wedges();
std::vector<ElementKind> hexahedra();
std::vector<ElementKind> beams();
std::vector<ElementKind> pyramids();

/// All that there are.
inline constexpr std::array element_families = {tetrahedra, wedges, hexahedra, beams, pyramids};

}  // namespace hersey::fem
