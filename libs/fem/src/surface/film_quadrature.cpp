// Integration over the part of a face that a film lies on, (film-surface.4).
#include "surface/film_quadrature.h"

#include <cmath>

#include "hersey/fem/element_point.h"
#include "hersey/fem/quadrature.h"
#include "surface/film_coordinates.h"

namespace hersey::fem {
namespace {

using Eigen::Vector2d;
using NaturalTriangle = std::array<Vector2d, 3>;

void add_square(std::vector<NaturalTriangle>& triangles, const Vector2d& corner, const Vector2d& a, const Vector2d& b) {
  triangles.push_back({corner, corner + a, corner + a + b});
  triangles.push_back({corner, corner + a + b, corner + b});
}

/// The natural domain of a face with `nodes` nodes, divided.
std::vector<NaturalTriangle> natural_triangles(std::size_t nodes, int parts) {
  std::vector<NaturalTriangle> triangles;
  triangles.reserve(static_cast<std::size_t>(2 * parts * parts));
  const bool is_triangle = nodes == 3 || nodes == 6;
  const double h = (is_triangle ? 1.0 : 2.0) / parts;
  const Vector2d a(h, 0), b(0, h);
  for (int i = 0; i < parts; ++i)
    for (int k = 0; k < parts; ++k) {
      const Vector2d corner = i * a + k * b;
      if (!is_triangle) {
        add_square(triangles, corner - Vector2d(1, 1), a, b);
      } else if (i + k < parts) {
        triangles.push_back({corner, corner + a, corner + b});
        if (i + k + 1 < parts) triangles.push_back({corner + a, corner + a + b, corner + b});
      }
    }
  return triangles;
}

/// Nodes of a face in the film's axes, (3, nodes).
NodeColumns positions(const Mesh& mesh, const std::vector<int>& nodes, const Pose& to_cylinder) {
  NodeColumns x(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t a = 0; a < nodes.size(); ++a)
    x.col(static_cast<Eigen::Index>(a)) = to_cylinder * mesh.nodes[static_cast<std::size_t>(nodes[a])];
  return x;
}

/// The part of a polygon on which side * coordinate <= limit; coordinates are taken linear along its edges.
std::vector<FilmCorner> cut(const std::vector<FilmCorner>& polygon, double FilmCorner::*coordinate, double side,
                            double limit) {
  std::vector<FilmCorner> kept;
  kept.reserve(polygon.size() + 1);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const FilmCorner &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double over_from = side * from.*coordinate - limit, over_to = side * to.*coordinate - limit;
    if (over_from <= 0) kept.push_back(from);
    if ((over_from <= 0) == (over_to <= 0)) continue;
    const double s = over_from / (over_from - over_to);
    kept.push_back({from.xi + s * (to.xi - from.xi), from.phi + s * (to.phi - from.phi), from.z + s * (to.z - from.z)});
    kept.back().*coordinate = side * limit;
  }
  return kept;
}

/// The part of a triangle of a face that lies within the film.
std::vector<FilmCorner> within_film(const std::array<FilmCorner, 3>& whole, const FilmCylinder& cylinder) {
  std::vector<FilmCorner> polygon(whole.begin(), whole.end());
  for (const double side : {1.0, -1.0}) polygon = cut(polygon, &FilmCorner::z, side, cylinder.L / 2);
  if (!cylinder.arc) return polygon;
  const double middle = angle_near(cylinder.arc->from + cylinder.arc->over / 2, whole[0].phi);
  for (const double side : {1.0, -1.0})
    polygon = cut(polygon, &FilmCorner::phi, side, side * middle + cylinder.arc->over / 2);
  return polygon;
}

/// The points of one natural triangle.
void visit_triangle(const NaturalTriangle& corners, const std::vector<int>& nodes, const NodeColumns& x,
                    const FilmCylinder& cylinder, const std::function<void(const FilmPoint&)>& visit) {
  const Vector2d a = corners[1] - corners[0], b = corners[2] - corners[0];
  const double stretch = a.x() * b.y() - a.y() * b.x();
  for (const auto& [xi, weight] : face_points(3)) {
    const Vector2d at = corners[0] + xi[0] * a + xi[1] * b;
    const FaceShape shape = face_shape(static_cast<int>(nodes.size()), at.x(), at.y());
    const Eigen::Matrix<double, 3, 2> t = x * shape.dN;
    const Vector3 normal = t.col(0).cross(t.col(1)), position = x * shape.N;
    const CylinderPoint point = cylinder_point(position);
    const Vector3 e_r(position.x() / point.radius, position.y() / point.radius, 0);
    const double phi_z = weight * stretch * normal.dot(e_r) / point.radius;  // dphi dz
    visit({nodes, shape.N, point.phi, point.z, cylinder.X.R * e_r, cylinder.R * phi_z});
  }
}

}  // namespace

std::vector<std::array<FilmCorner, 3>> film_triangles(const Mesh& mesh, ElementFace face, const FilmCylinder& cylinder,
                                                      int parts) {
  const std::vector<int> nodes = nodes_of(mesh, face);
  const NodeColumns x = positions(mesh, nodes, cylinder.X.inverse());
  const double phi_first = cylinder_point(x.col(0)).phi;
  std::vector<std::array<FilmCorner, 3>> triangles;
  for (const NaturalTriangle& natural : natural_triangles(nodes.size(), parts)) {
    std::array<FilmCorner, 3>& corners = triangles.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector3 at = x * face_shape(static_cast<int>(nodes.size()), natural[c].x(), natural[c].y()).N;
      const CylinderPoint point = cylinder_point(at);
      corners[c] = {natural[c], angle_near(point.phi, phi_first), point.z};
    }
  }
  return triangles;
}

void visit_film_points(const Mesh& mesh, ElementFace face, const FilmCylinder& cylinder, int parts,
                       const std::function<void(const FilmPoint&)>& visit) {
  const std::vector<int> nodes = nodes_of(mesh, face);
  const NodeColumns x = positions(mesh, nodes, cylinder.X.inverse());
  for (const std::array<FilmCorner, 3>& whole : film_triangles(mesh, face, cylinder, parts)) {
    const std::vector<FilmCorner> polygon = within_film(whole, cylinder);
    for (std::size_t c = 2; c < polygon.size(); ++c)
      visit_triangle({polygon[0].xi, polygon[c - 1].xi, polygon[c].xi}, nodes, x, cylinder, visit);
  }
}

}  // namespace hersey::fem
