#pragma once

#include <vector>

#include "hersey/fem/element_point.h"
#include "hersey/fem/quadrature.h"

namespace hersey::fem {

/// One point of a face: its nodes' shape functions, its position, outward normal, and share of the area.
struct FacePoint {
  const NodeValues& N;
  Vector3 x, normal;
  double area;
};

/// Calls `visit(nodes, point)` at every point of integration; `nodes` are indices in the mesh.
template <typename Visit>
void visit_face(const Mesh& mesh, const ElementFace& face, Visit&& visit) {
  const Element& element = mesh.elements[static_cast<std::size_t>(face.element)];
  const std::vector<int>& local = face_nodes(element.type, face.face);
  const auto count = static_cast<Eigen::Index>(local.size());
  std::vector<int> nodes;
  nodes.reserve(local.size());
  NodeColumns x(3, count);
  for (const int a : local) {
    const int node = mesh.nodes_of(element)[a];
    x.col(static_cast<Eigen::Index>(nodes.size())) = mesh.nodes[static_cast<std::size_t>(node)];
    nodes.push_back(node);
  }
  for (const auto& [xi, weight] : face_points(static_cast<int>(count))) {
    const FaceShape shape = face_shape(static_cast<int>(count), xi[0], xi[1]);
    const Eigen::Matrix<double, 3, 2> t = x * shape.dN;
    const Vector3 n = t.col(0).cross(t.col(1));
    visit(nodes, FacePoint{shape.N, x * shape.N, n.normalized(), weight * n.norm()});
  }
}

}  // namespace hersey::fem
