#pragma once

#include <array>
#include <vector>

#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Corners of a face as places in Mesh::nodes, ascending; -1 last for a triangle. Equal for the two elements it parts.
using FaceKey = std::array<int, 4>;
/// Of a face of a solid element.
[[nodiscard]] FaceKey face_key(const Mesh& mesh, ElementFace face);

/// Nodes of a face as places in Mesh::nodes, in the order of `face_nodes`.
[[nodiscard]] std::vector<int> nodes_of(const Mesh& mesh, ElementFace face);

/// Faces that belong to one element only, by element and face.
[[nodiscard]] std::vector<ElementFace> outer_faces(const Mesh& mesh);

/// A surface of a mesh in flat triangles, for pictures: a face of n corners and n midside nodes gives one triangle per
/// corner and n - 2 between the midside nodes.
struct Skin {
  std::vector<int> nodes;                     ///< places in Mesh::nodes, ascending
  std::vector<std::array<int, 3>> triangles;  ///< places in `nodes`, counterclockwise seen from outside
};

/// The given faces in triangles.
[[nodiscard]] Skin skin(const Mesh& mesh, const std::vector<ElementFace>& faces);

/// The whole outer surface in triangles.
[[nodiscard]] Skin skin(const Mesh& mesh);

}  // namespace hersey::fem
