#include "hersey/fem/quadrature.h"

#include "element/element_kind.h"
#include "element/quadrature_rules.h"
#include "hersey/core/contract.h"

namespace hersey::fem {

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

const std::vector<QuadraturePoint>& face_points(int nodes) {
  static const QuadratureRule triangle = triangle_degree_5(), square = square_rule(gauss_3());
  HERSEY_REQUIRE(nodes == 3 || nodes == 4 || nodes == 6 || nodes == 8, "faces are triangles or squares");
  return nodes == 3 || nodes == 6 ? triangle : square;
}

}  // namespace hersey::fem
