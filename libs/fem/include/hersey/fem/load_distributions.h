#pragma once

#include <string>
#include <vector>

#include "hersey/fem/load_vectors.h"

/// Faces on which a load acts, and non-uniform load distributions.
namespace hersey::fem {

/// Returns the outer faces all of whose nodes are among `nodes`.
[[nodiscard]] std::vector<ElementFace> outer_faces(const Mesh& mesh, const std::vector<int>& nodes);

/// Returns the faces of the surface called `name`, or else the outer faces of the node set of that name; none if there
/// is neither.
[[nodiscard]] std::vector<ElementFace> faces_called(const Mesh& mesh, const std::string& name);

/// Returns the nodes of faces, ascending.
[[nodiscard]] std::vector<int> nodes_on(const Mesh& mesh, const std::vector<ElementFace>& faces);

/// Returns the load vector of a pin that is pressed into a bore: a pressure max(0, -n . towards) on faces of outward
/// normal n, with a largest pressure of 1 Pa, (elastic.9). @pre |towards| = 1
[[nodiscard]] Eigen::VectorXd cosine_pressure_load(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                                   const Vector3& towards);

/// Returns the load vector of a force of 1 N along the unit vector `direction`, distributed evenly over the area of
/// faces.
[[nodiscard]] Eigen::VectorXd spread_force(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                           const Vector3& direction);

}  // namespace hersey::fem
