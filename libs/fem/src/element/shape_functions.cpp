#include "hersey/fem/shape_functions.h"

#include <array>

#include "element/element_kind.h"
#include "element/interpolation.h"
#include "hersey/core/contract.h"

namespace hersey::fem {

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

FaceShape face_shape(int nodes, double xi, double eta) {
  HERSEY_REQUIRE(nodes == 3 || nodes == 4 || nodes == 6 || nodes == 8, "faces are triangles or squares");
  constexpr std::array<Edge, 3> triangle_edges = {{{0, 1}, {1, 2}, {2, 0}}};
  constexpr std::array<Edge, 4> square_edges = {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  constexpr std::array<Signs, 4> square_corners = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};
  const Vector3 at(xi, eta, 0);
  const ShapeFunctions s = nodes == 3   ? linear_simplex(Barycentric(at, 2), 3)
                           : nodes == 6 ? quadratic_simplex(Barycentric(at, 2), 3, triangle_edges)
                           : nodes == 4 ? multilinear(2, square_corners, at)
                                        : serendipity(2, square_corners, square_edges, at);
  return {s.N, s.dN.leftCols<2>()};
}

}  // namespace hersey::fem
