#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "hersey/fem/mesh.h"
#include "hersey/fem/quadrature.h"
#include "hersey/fem/solid_element.h"

namespace hersey::fem {

/// Elastic solid on a mesh: the input of every analysis. Degree of freedom 3 a + i is the displacement of node a along
/// axis i.
struct ElasticBody {
  Mesh mesh;
  std::vector<SolidMaterial> materials;
  Integration integration = Integration::full;
  Eigen::SparseMatrix<double> K;      ///< stiffness (3 n, 3 n) [N/m], symmetric, both triangles
  Eigen::SparseMatrix<double> m;      ///< consistent mass (n, n) [kg], M = m (x) I3, (elastic.6)
  double mass = 0;                    ///< [kg]
  Vector3 centre = Vector3::Zero();   ///< centre of mass [m]
  Matrix3 inertia = Matrix3::Zero();  ///< inertia about `centre`, in the mesh's axes [kg m^2]

  /// Number of nodes, n.
  [[nodiscard]] Eigen::Index node_count() const { return m.rows(); }
  /// Number of degrees of freedom, 3 n.
  [[nodiscard]] Eigen::Index size() const { return K.rows(); }
  /// Returns the material of an element: the first one where the element names none.
  [[nodiscard]] const SolidMaterial& material_of(const Element& element) const;
  /// Returns the undeformed positions of an element's nodes, (3, nodes) [m].
  [[nodiscard]] NodeColumns positions_of(const Element& element) const;
};

/// Assembles K and m of `mesh`, whose elements name their material by its index in `materials` (elements without a
/// material take the first). The pattern of K and m depends on the mesh's connectivity only. Cost: about 1 s for
/// 100,000 degrees of freedom.
/// @throws InputError naming elements that are folded or beams, and nodes that belong to no element
/// @throws ContractError if an element's material is not among `materials`
/// @verified_by elastic_body_test.cpp
[[nodiscard]] ElasticBody assemble(Mesh mesh, std::vector<SolidMaterial> materials,
                                   Integration integration = Integration::full);

/// Computes mass, centre and inertia of `body` from its nodes and m.
void find_inertia(ElasticBody& body);

/// Returns M u for u with any number of columns, (3 n, columns).
[[nodiscard]] Eigen::MatrixXd mass_times(const Eigen::SparseMatrix<double>& m, const Eigen::MatrixXd& u);

/// Returns the six motions of a rigid body (3 n, 6): rotations about the axes through `about`, then translations along
/// the axes. The columns are ordered as in [omega; v].
[[nodiscard]] Eigen::MatrixXd rigid_motions(const Mesh& mesh, const Vector3& about);

/// Returns the mesh of a box [0, size] of `cells` hexahedra along each axis, each cut into two wedges or six tetrahedra
/// if `type` requires it, with node sets and surfaces x0, x1, y0, y1, z0, z1 on its sides. It serves tests, benchmarks
/// and first trials.
[[nodiscard]] Mesh box_mesh(ElementType type, const Vector3& size, const std::array<int, 3>& cells);

}  // namespace hersey::fem
