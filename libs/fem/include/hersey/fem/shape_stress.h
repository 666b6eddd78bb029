#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/fem/mesh.h"
#include "hersey/fem/solid_material.h"

namespace hersey::fem {

/// Stresses of a body that deforms in given shapes, at small strain: linear in the amplitudes, and recovered once for
/// each shape. For more states than there are shapes; of fewer recover_stress() says the same for less.
/// @verified_by stress_test.cpp
class ShapeStress {
 public:
  /// @param shapes  displacements of the nodes per amplitude, shape (3 nodes, shapes)
  ShapeStress(const Mesh& mesh, const std::vector<SolidMaterial>& materials, const Eigen::MatrixXd& shapes);

  /// Stresses at the nodes for the amplitudes of all shapes [Pa], shape (6, nodes), in the order of Stress::nodal.
  [[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> nodal(const Eigen::VectorXd& amplitudes) const;

 private:
  Eigen::MatrixXd by_amplitude_;  // shape (6 nodes, shapes)
};

}  // namespace hersey::fem
