#include "hersey/fem/load_distributions.h"

#include <algorithm>
#include <map>
#include <set>

#include "hersey/core/contract.h"

namespace hersey::fem {

std::vector<ElementFace> outer_faces(const Mesh& mesh, const std::vector<int>& nodes) {
  std::vector<char> among(mesh.nodes.size(), 0);
  for (const int node : nodes) among[static_cast<std::size_t>(node)] = 1;
  // Two elements that share a face have the same nodes on it.
  std::map<std::vector<int>, std::pair<ElementFace, int>> found;
  std::vector<int> key;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Element& element = mesh.elements[e];
    for (int face = 0; face < face_count(element.type); ++face) {
      key.clear();
      for (const int a : face_nodes(element.type, face)) key.push_back(mesh.nodes_of(element)[a]);
      if (!std::all_of(key.begin(), key.end(), [&](int n) { return among[static_cast<std::size_t>(n)] != 0; }))
        continue;
      std::sort(key.begin(), key.end());
      ++found.try_emplace(key, ElementFace{static_cast<int>(e), face}, 0).first->second.second;
    }
  }
  std::vector<ElementFace> faces;
  faces.reserve(found.size());
  for (const auto& [corners, face] : found)
    if (face.second == 1) faces.push_back(face.first);
  return faces;
}

std::vector<ElementFace> faces_called(const Mesh& mesh, const std::string& name) {
  if (const auto surface = mesh.surfaces.find(name); surface != mesh.surfaces.end()) return surface->second;
  const auto set = mesh.node_sets.find(name);
  return set == mesh.node_sets.end() ? std::vector<ElementFace>() : outer_faces(mesh, set->second);
}

std::vector<int> nodes_on(const Mesh& mesh, const std::vector<ElementFace>& faces) {
  std::set<int> nodes;
  for (const ElementFace& face : faces) {
    const Element& element = mesh.elements[static_cast<std::size_t>(face.element)];
    for (const int a : face_nodes(element.type, face.face)) nodes.insert(mesh.nodes_of(element)[a]);
  }
  return {nodes.begin(), nodes.end()};
}

Eigen::VectorXd cosine_pressure_load(const Mesh& mesh, const std::vector<ElementFace>& faces, const Vector3& towards) {
  return traction_load(mesh, faces, [&](const Vector3&, const Vector3& normal) -> Vector3 {
    return std::min(0.0, normal.dot(towards)) * normal;
  });
}

Eigen::VectorXd spread_force(const Mesh& mesh, const std::vector<ElementFace>& faces, const Vector3& direction) {
  const double area = area_of(mesh, faces);
  HERSEY_REQUIRE(area > 0, "there are faces to spread a force over");
  return traction_load(mesh, faces, [&](const Vector3&, const Vector3&) -> Vector3 { return direction / area; });
}

}  // namespace hersey::fem
