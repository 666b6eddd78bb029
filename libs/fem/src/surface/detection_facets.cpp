#include "surface/detection_facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "hersey/fem/shape_functions.h"
#include "hersey/fem/skin.h"
#include "surface/face_quadrature.h"

namespace hersey::fem {
namespace {

using NaturalPoint = std::array<double, 2>;

/// Natural coordinates of a face's nodes.
const std::vector<NaturalPoint>& natural_points_of_face(std::size_t nodes) {
  static const std::vector<NaturalPoint> triangle = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  static const std::vector<NaturalPoint> square = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1},
                                                   {0, -1},  {1, 0},  {0, 1}, {-1, 0}};
  return nodes % 3 == 0 ? triangle : square;
}

Facet facet_of(const Mesh& mesh, ElementFace face) {
  Facet facet;
  facet.face = face;
  facet.nodes = nodes_of(mesh, face);
  const std::size_t count = facet.nodes.size();
  facet.corners = count > 4 ? count / 2 : count;
  NodeColumns x(3, static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k)
    x.col(static_cast<Eigen::Index>(k)) = mesh.nodes[static_cast<std::size_t>(facet.nodes[k])];
  const auto normal_at = [&](double xi, double eta) -> Vector3 {
    const Eigen::Matrix<double, 3, 2> t = x * face_shape(static_cast<int>(count), xi, eta).dN;
    return t.col(0).cross(t.col(1)).normalized();
  };
  for (std::size_t k = 0; k < count; ++k) {
    const auto& [xi, eta] = natural_points_of_face(count)[k];
    facet.normals.push_back(normal_at(xi, eta));
  }
  Vector3 moment = Vector3::Zero();
  visit_face(mesh, face, [&](const std::vector<int>&, const FacePoint& point) {
    facet.area += point.area;
    moment += point.area * point.x;
  });
  facet.centre = moment / facet.area;
  const double middle = facet.corners == 3 ? 1.0 / 3 : 0;
  facet.normal = normal_at(middle, middle);
  return facet;
}

double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Largest angle between two facets' normals at the nodes that they share.
double angle_at_edge(const Facet& a, const Facet& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    for (std::size_t j = 0; j < b.nodes.size(); ++j)
      if (a.nodes[i] == b.nodes[j]) largest = std::max(largest, angle_between(a.normals[i], b.normals[j]));
  return largest;
}

}  // namespace

SurfaceFacets surface_facets(const Mesh& mesh) {
  SurfaceFacets surface;
  for (const ElementFace face : outer_faces(mesh)) {
    Facet facet = facet_of(mesh, face);
    // A face without area, of a flat element, has no normal; quality_of reports it.
    if (facet.area > 0 && facet.normal.allFinite()) surface.facets.push_back(std::move(facet));
  }
  surface.neighbours.resize(surface.facets.size());
  std::vector<std::tuple<int, int, int>> edges;  // corners, ascending; facet
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    const Facet& facet = surface.facets[f];
    for (std::size_t c = 0; c < facet.corners; ++c) {
      const auto [first, last] = std::minmax(facet.nodes[c], facet.nodes[(c + 1) % facet.corners]);
      edges.emplace_back(first, last, static_cast<int>(f));
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t k = 0; k < edges.size();) {
    const auto [first, last, facet] = edges[k];
    std::size_t end = k + 1;
    while (end < edges.size() && std::get<0>(edges[end]) == first && std::get<1>(edges[end]) == last) ++end;
    if (end == k + 2) {
      const int other = std::get<2>(edges[k + 1]);
      const auto a = static_cast<std::size_t>(facet), b = static_cast<std::size_t>(other);
      const double angle = angle_at_edge(surface.facets[a], surface.facets[b]);
      surface.neighbours[a].push_back({other, first, last, angle});
      surface.neighbours[b].push_back({facet, first, last, angle});
    }
    k = end;
  }
  return surface;
}

}  // namespace hersey::fem
