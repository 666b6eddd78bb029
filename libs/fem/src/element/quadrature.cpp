#include "hersey/fem/quadrature.h"

#include <array>
#include <cmath>

#include "hersey/core/contract.h"

namespace hersey::fem {
namespace {

using Points = std::vector<QuadraturePoint>;

struct LinePoint {
  double x, w;
};

const std::vector<LinePoint> gauss_2 = {{-1 / std::sqrt(3.0), 1}, {1 / std::sqrt(3.0), 1}};
const std::vector<LinePoint> gauss_3 = {{-std::sqrt(0.6), 5.0 / 9}, {0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}};

Points cube(const std::vector<LinePoint>& line) {
  Points points;
  points.reserve(line.size() * line.size() * line.size());
  for (const LinePoint& c : line)
    for (const LinePoint& b : line)
      for (const LinePoint& a : line) points.push_back({{a.x, b.x, c.x}, a.w * b.w * c.w});
  return points;
}

Points square(const std::vector<LinePoint>& line) {
  Points points;
  points.reserve(line.size() * line.size());
  for (const LinePoint& b : line)
    for (const LinePoint& a : line) points.push_back({{a.x, b.x, 0}, a.w * b.w});
  return points;
}

Points triangle_degree_2() {
  const double w = 1.0 / 6;
  return {{{w, w, 0}, w}, {{4 * w, w, 0}, w}, {{w, 4 * w, 0}, w}};
}

// Strang and Fix (1973), seven points.
Points triangle_degree_5() {
  Points points = {{{1.0 / 3, 1.0 / 3, 0}, 9.0 / 80}};
  for (const double sign : {1.0, -1.0}) {
    const double root = sign * std::sqrt(15.0), a = (6 + root) / 21, w = (155 + root) / 2400;
    for (const Vector3& xi : {Vector3(a, a, 0), Vector3(1 - 2 * a, a, 0), Vector3(a, 1 - 2 * a, 0)})
      points.push_back({xi, w});
  }
  return points;
}

Points wedge(const Points& triangle, const std::vector<LinePoint>& line) {
  Points points;
  points.reserve(triangle.size() * line.size());
  for (const LinePoint& c : line)
    for (const QuadraturePoint& t : triangle) points.push_back({{t.xi[0], t.xi[1], c.x}, t.weight * c.w});
  return points;
}

/// The four points of a tetrahedron with barycentric coordinates (b, a, a, a) and its permutations.
void add_corners(Points& points, double a, double w) {
  const double b = 1 - 3 * a;
  for (const Vector3& xi : {Vector3(a, a, a), Vector3(b, a, a), Vector3(a, b, a), Vector3(a, a, b)})
    points.push_back({xi, w});
}

Points tetrahedron_degree_2() {
  Points points;
  add_corners(points, (5 - std::sqrt(5.0)) / 20, 1.0 / 24);
  return points;
}

// Keast (1986), Comput. Methods Appl. Mech. Eng. 55, 339: fifteen points.
Points tetrahedron_degree_5() {
  Points points = {{{0.25, 0.25, 0.25}, 6544.0 / 36015 / 6}};
  add_corners(points, 1.0 / 3, 81.0 / 2240 / 6);
  add_corners(points, 1.0 / 11, 161051.0 / 2304960 / 6);
  const double a = 0.25 - std::sqrt(91.0) / 52, b = 0.5 - a, w = 338.0 / 5145 / 6;
  for (const Vector3& xi :
       {Vector3(a, a, b), Vector3(a, b, a), Vector3(b, a, a), Vector3(a, b, b), Vector3(b, a, b), Vector3(b, b, a)})
    points.push_back({xi, w});
  return points;
}

}  // namespace

const std::vector<QuadraturePoint>& stiffness_points(ElementType type, Integration rule) {
  static const Points tet4 = {{{0.25, 0.25, 0.25}, 1.0 / 6}}, tet10 = tetrahedron_degree_2();
  static const Points wedge6 = wedge(triangle_degree_2(), gauss_2), wedge15 = wedge(triangle_degree_2(), gauss_3);
  static const Points hex8 = cube(gauss_2), hex20 = cube(gauss_3);
  HERSEY_REQUIRE(type != ElementType::beam2, "a beam is no solid");
  switch (type) {
    case ElementType::tet4:
      return tet4;
    case ElementType::tet10:
      return tet10;
    case ElementType::wedge6:
      return wedge6;
    case ElementType::wedge15:
      return wedge15;
    case ElementType::hex20:
      return rule == Integration::full ? hex20 : hex8;
    default:
      return hex8;
  }
}

const std::vector<QuadraturePoint>& mass_points(ElementType type) {
  static const Points tet4 = tetrahedron_degree_2(), tet10 = tetrahedron_degree_5();
  static const Points wedges = wedge(triangle_degree_5(), gauss_3), hexes = cube(gauss_3);
  HERSEY_REQUIRE(type != ElementType::beam2, "a beam is no solid");
  switch (type) {
    case ElementType::tet4:
      return tet4;
    case ElementType::tet10:
      return tet10;
    case ElementType::wedge6:
    case ElementType::wedge15:
      return wedges;
    default:
      return hexes;
  }
}

const std::vector<QuadraturePoint>& face_points(int nodes) {
  static const Points triangle = triangle_degree_5(), quad = square(gauss_3);
  HERSEY_REQUIRE(nodes == 3 || nodes == 4 || nodes == 6 || nodes == 8, "faces are triangles or squares");
  return nodes == 3 || nodes == 6 ? triangle : quad;
}

}  // namespace hersey::fem
