#include "hersey/fem/solid_element.h"

#include <algorithm>
#include <limits>

#include "element/incompatible_modes.h"

namespace hersey::fem {

double smallest_jacobian(ElementType type, const NodeColumns& x) {
  double smallest = std::numeric_limits<double>::infinity();
  const auto reduce_by = [&](const Vector3& xi) {
    const Matrix3 J = x * shape_functions(type, xi).dN;
    smallest = std::min(smallest, J.determinant());
  };
  for (const QuadraturePoint& point : stiffness_points(type)) reduce_by(point.xi);
  for (const QuadraturePoint& point : mass_points(type)) reduce_by(point.xi);
  return smallest;
}

ElementMatrix element_stiffness(ElementType type, const NodeColumns& x, const SolidMaterial& material,
                                Integration rule) {
  if (type == ElementType::hex8) {
    const IncompatibleModes::Stiffness k = IncompatibleModes(x).stiffness(x, material.D);
    return k.K_uu - k.K_au.transpose() * k.K_aa.llt().solve(k.K_au);
  }
  const Eigen::Index dofs = 3 * x.cols();
  ElementMatrix K = ElementMatrix::Zero(dofs, dofs);
  for (const auto& [xi, weight] : stiffness_points(type, rule)) {
    const ElementPoint point = element_point(shape_functions(type, xi), x);
    const StrainMatrix B = strain_matrix(point.gradients);
    const StrainMatrix stress = weight * point.jacobian * material.D * B;
    K.noalias() += B.transpose() * stress;
  }
  return K;
}

ElementMatrix element_mass(ElementType type, const NodeColumns& x) {
  ElementMatrix m = ElementMatrix::Zero(x.cols(), x.cols());
  for (const auto& [xi, weight] : mass_points(type)) {
    const ShapeFunctions shape = shape_functions(type, xi);
    const Matrix3 J = x * shape.dN;
    m.noalias() += weight * J.determinant() * shape.N * shape.N.transpose();
  }
  return m;
}

}  // namespace hersey::fem
