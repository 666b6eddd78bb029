#include "hersey/fem/skin.h"

#include <algorithm>
#include <tuple>

#include "element/element_kind.h"

namespace hersey::fem {
namespace {

using Triangle = std::array<int, 3>;

int corner_count(ElementType type, int face) {
  const int nodes = static_cast<int>(face_nodes(type, face).size());
  return has_midside_nodes(type) ? nodes / 2 : nodes;
}

void add_fan(const std::vector<int>& polygon, std::vector<Triangle>& triangles) {
  for (std::size_t k = 2; k < polygon.size(); ++k) triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
}

void add_triangles(const Mesh& mesh, ElementFace face, std::vector<Triangle>& triangles) {
  const ElementType type = mesh.elements[static_cast<std::size_t>(face.element)].type;
  const std::vector<int> nodes = nodes_of(mesh, face);
  if (!has_midside_nodes(type)) return add_fan(nodes, triangles);
  const std::size_t corners = nodes.size() / 2;
  for (std::size_t c = 0; c < corners; ++c)
    triangles.push_back({nodes[c], nodes[corners + c], nodes[corners + (c + corners - 1) % corners]});
  add_fan({nodes.begin() + static_cast<std::ptrdiff_t>(corners), nodes.end()}, triangles);
}

}  // namespace

FaceKey face_key(const Mesh& mesh, ElementFace face) {
  const Element& element = mesh.elements[static_cast<std::size_t>(face.element)];
  const std::vector<int>& local = face_nodes(element.type, face.face);
  const int corners = corner_count(element.type, face.face);
  FaceKey key{-1, -1, -1, -1};
  for (std::size_t c = 0; c < static_cast<std::size_t>(corners); ++c) key[c] = mesh.nodes_of(element)[local[c]];
  std::sort(key.begin(), key.begin() + corners);
  return key;
}

std::vector<int> nodes_of(const Mesh& mesh, ElementFace face) {
  const Element& element = mesh.elements[static_cast<std::size_t>(face.element)];
  std::vector<int> nodes = face_nodes(element.type, face.face);
  for (int& node : nodes) node = mesh.nodes_of(element)[node];
  return nodes;
}

std::vector<ElementFace> outer_faces(const Mesh& mesh) {
  std::vector<std::tuple<FaceKey, int, int>> faces;
  faces.reserve(6 * mesh.elements.size());
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
    for (int f = 0; f < face_count(mesh.elements[static_cast<std::size_t>(e)].type); ++f)
      faces.emplace_back(face_key(mesh, {e, f}), e, f);
  std::sort(faces.begin(), faces.end());
  std::vector<ElementFace> outer;
  for (std::size_t k = 0; k < faces.size();) {
    std::size_t end = k + 1;
    while (end < faces.size() && std::get<0>(faces[end]) == std::get<0>(faces[k])) ++end;
    if (end == k + 1) outer.push_back({std::get<1>(faces[k]), std::get<2>(faces[k])});
    k = end;
  }
  std::sort(outer.begin(), outer.end(),
            [](ElementFace a, ElementFace b) { return std::tie(a.element, a.face) < std::tie(b.element, b.face); });
  return outer;
}

Skin skin(const Mesh& mesh, const std::vector<ElementFace>& faces) {
  Skin result;
  for (const ElementFace& face : faces) add_triangles(mesh, face, result.triangles);
  std::vector<int> index(mesh.nodes.size(), -1);
  for (const Triangle& triangle : result.triangles)
    for (const int node : triangle) index[static_cast<std::size_t>(node)] = 0;
  for (std::size_t n = 0; n < index.size(); ++n) {
    if (index[n] < 0) continue;
    index[n] = static_cast<int>(result.nodes.size());
    result.nodes.push_back(static_cast<int>(n));
  }
  for (Triangle& triangle : result.triangles)
    for (int& node : triangle) node = index[static_cast<std::size_t>(node)];
  return result;
}

Skin skin(const Mesh& mesh) { return skin(mesh, outer_faces(mesh)); }

}  // namespace hersey::fem
