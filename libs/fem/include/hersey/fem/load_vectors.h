#pragma once

#include <functional>
#include <vector>

#include "hersey/fem/elastic_body.h"

/// Nodal forces (3 n) that do the same work as loads spread over a body, (elastic.8).
namespace hersey::fem {

/// Of an acceleration of gravity `g` [m/s^2].
[[nodiscard]] Eigen::VectorXd gravity_load(const ElasticBody& body, const Vector3& g);

/// Of a traction [Pa] on faces, a function of the position and of the unit normal outward.
using Traction = std::function<Vector3(const Vector3& x, const Vector3& normal)>;
/// Nodal forces of `traction` on `faces`, integrated at points of their undeformed geometry [N].
[[nodiscard]] Eigen::VectorXd traction_load(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                            const Traction& traction);

/// Of a pressure [Pa] that pushes on faces against their outward normals.
[[nodiscard]] Eigen::VectorXd pressure_load(const Mesh& mesh, const std::vector<ElementFace>& faces, double pressure);

/// Outward normals of faces at their nodes times the area that each node stands for [m^2], (3, nodes); zero elsewhere.
[[nodiscard]] Eigen::Matrix3Xd nodal_normals(const Mesh& mesh, const std::vector<ElementFace>& faces);

/// Areas of `faces` shared out among `count` nodes, node a at place[a], in the proportions of int N_a^2 dA on each
/// face: positive, which int N_a dA is not in the corners of quadratic faces.
[[nodiscard]] std::vector<double> nodal_areas(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                              const std::vector<int>& place, std::size_t count);

/// Area of faces [m^2].
[[nodiscard]] double area_of(const Mesh& mesh, const std::vector<ElementFace>& faces);

}  // namespace hersey::fem
