#pragma once

#include <array>
#include <vector>

#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Corners of a face as indices in Mesh::nodes, ascending; -1 last for a triangle. The key is the same for both
/// elements that share the face.
using FaceKey = std::array<int, 4>;
/// Returns the key of a face of a solid element.
[[nodiscard]] FaceKey face_key(const Mesh& mesh, ElementFace face);

/// Returns the nodes of a face as indices in Mesh::nodes, in the order of `face_nodes`.
[[nodiscard]] std::vector<int> nodes_of(const Mesh& mesh, ElementFace face);

/// Returns the faces that belong to one element only, ordered by element and face.
[[nodiscard]] std::vector<ElementFace> outer_faces(const Mesh& mesh);

/// Surface of a mesh in flat triangles, for pictures: a face of n corners and n midside nodes is divided into one
/// triangle per corner and n - 2 between the midside nodes.
struct Skin {
  std::vector<int> nodes;                     ///< indices in Mesh::nodes, ascending
  std::vector<std::array<int, 3>> triangles;  ///< indices in `nodes`, counterclockwise seen from outside
};

/// Returns the triangles of the given faces.
[[nodiscard]] Skin skin(const Mesh& mesh, const std::vector<ElementFace>& faces);

/// Returns the triangles of the whole outer surface.
[[nodiscard]] Skin skin(const Mesh& mesh);

}  // namespace hersey::fem
