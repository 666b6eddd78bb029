#include "element/quadrature_rules.h"

#include <cmath>

#include "hersey/core/contract.h"

namespace hersey::fem {
namespace {

/// The four points of a tetrahedron with barycentric coordinates (b, a, a, a) and its permutations.
void add_corners(QuadratureRule& points, double a, double w) {
  const double b = 1 - 3 * a;
  for (const Vector3& xi : {Vector3(a, a, a), Vector3(b, a, a), Vector3(a, b, a), Vector3(a, a, b)})
    points.push_back({xi, w});
}

}  // namespace

const LineRule& gauss_2() {
  static const LineRule rule = {{-1 / std::sqrt(3.0), 1}, {1 / std::sqrt(3.0), 1}};
  return rule;
}

const LineRule& gauss_3() {
  static const LineRule rule = {{-std::sqrt(0.6), 5.0 / 9}, {0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}};
  return rule;
}

const LineRule& gauss_4() {
  static const LineRule rule = [] {
    LineRule points;
    for (const double sign : {-1.0, 1.0}) {
      const double x = std::sqrt(3.0 / 7 - sign * 2.0 / 7 * std::sqrt(1.2)), w = (18 + sign * std::sqrt(30.0)) / 36;
      points.push_back({-x, w});
      points.push_back({x, w});
    }
    return points;
  }();
  return rule;
}

QuadratureRule cube_rule(const LineRule& line) {
  QuadratureRule points;
  points.reserve(line.size() * line.size() * line.size());
  for (const LinePoint& c : line)
    for (const LinePoint& b : line)
      for (const LinePoint& a : line) points.push_back({{a.x, b.x, c.x}, a.w * b.w * c.w});
  return points;
}

QuadratureRule square_rule(const LineRule& line) {
  QuadratureRule points;
  points.reserve(line.size() * line.size());
  for (const LinePoint& b : line)
    for (const LinePoint& a : line) points.push_back({{a.x, b.x, 0}, a.w * b.w});
  return points;
}

QuadratureRule triangle_degree_2() {
  const double w = 1.0 / 6;
  return {{{w, w, 0}, w}, {{4 * w, w, 0}, w}, {{w, 4 * w, 0}, w}};
}

// Strang and Fix (1973), seven points.
QuadratureRule triangle_degree_5() {
  QuadratureRule points = {{{1.0 / 3, 1.0 / 3, 0}, 9.0 / 80}};
  for (const double sign : {1.0, -1.0}) {
    const double root = sign * std::sqrt(15.0), a = (6 + root) / 21, w = (155 + root) / 2400;
    for (const Vector3& xi : {Vector3(a, a, 0), Vector3(1 - 2 * a, a, 0), Vector3(a, 1 - 2 * a, 0)})
      points.push_back({xi, w});
  }
  return points;
}

QuadratureRule wedge_rule(const QuadratureRule& triangle, const LineRule& line) {
  QuadratureRule points;
  points.reserve(triangle.size() * line.size());
  for (const LinePoint& c : line)
    for (const QuadraturePoint& t : triangle) points.push_back({{t.xi[0], t.xi[1], c.x}, t.weight * c.w});
  return points;
}

QuadratureRule tetrahedron_degree_2() {
  QuadratureRule points;
  add_corners(points, (5 - std::sqrt(5.0)) / 20, 1.0 / 24);
  return points;
}

// Keast (1986), Comput. Methods Appl. Mech. Eng. 55, 339: fifteen points.
QuadratureRule tetrahedron_degree_5() {
  QuadratureRule points = {{{0.25, 0.25, 0.25}, 6544.0 / 36015 / 6}};
  add_corners(points, 1.0 / 3, 81.0 / 2240 / 6);
  add_corners(points, 1.0 / 11, 161051.0 / 2304960 / 6);
  const double a = 0.25 - std::sqrt(91.0) / 52, b = 0.5 - a, w = 338.0 / 5145 / 6;
  for (const Vector3& xi :
       {Vector3(a, a, b), Vector3(a, b, a), Vector3(b, a, a), Vector3(a, b, b), Vector3(b, a, b), Vector3(b, b, a)})
    points.push_back({xi, w});
  return points;
}

QuadratureRule tetrahedron_centre() { return {{{0.25, 0.25, 0.25}, 1.0 / 6}}; }

const std::vector<QuadraturePoint>& face_points(int nodes) {
  static const QuadratureRule triangle = triangle_degree_5(), square = square_rule(gauss_3());
  HERSEY_REQUIRE(nodes == 3 || nodes == 4 || nodes == 6 || nodes == 8, "faces are triangles or squares");
  return nodes == 3 || nodes == 6 ? triangle : square;
}

}  // namespace hersey::fem
