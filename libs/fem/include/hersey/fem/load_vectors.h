#pragma once

#include <functional>
#include <vector>

#include "hersey/fem/elastic_body.h"

/// Load vectors: nodal forces (3 n) that do the same work as loads distributed over a body, (elastic.8).
namespace hersey::fem {

/// Returns the nodal forces of an acceleration of gravity `g` [m/s^2].
[[nodiscard]] Eigen::VectorXd gravity_load(const ElasticBody& body, const Vector3& g);

/// Traction [Pa] on faces, a function of the position and of the unit normal outward.
using Traction = std::function<Vector3(const Vector3& x, const Vector3& normal)>;
/// Returns the nodal forces of `traction` on `faces`, integrated over their undeformed geometry [N].
[[nodiscard]] Eigen::VectorXd traction_load(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                            const Traction& traction);

/// Returns the nodal forces of a pressure [Pa] that acts on faces against their outward normals.
[[nodiscard]] Eigen::VectorXd pressure_load(const Mesh& mesh, const std::vector<ElementFace>& faces, double pressure);

/// Returns the outward normals of faces at their nodes times the area attributed to each node [m^2], (3, nodes); zero
/// elsewhere.
[[nodiscard]] Eigen::Matrix3Xd nodal_normals(const Mesh& mesh, const std::vector<ElementFace>& faces);

/// Returns the area of `faces` distributed over `count` nodes, node a at index[a], in the proportions of int N_a^2 dA
/// on each face. These shares are positive; those by int N_a dA are not at the corners of quadratic faces.
[[nodiscard]] std::vector<double> nodal_areas(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                              const std::vector<int>& index, std::size_t count);

/// Returns the area of faces [m^2].
[[nodiscard]] double area_of(const Mesh& mesh, const std::vector<ElementFace>& faces);

}  // namespace hersey::fem
