#include "hersey/fem/element_point.h"

namespace hersey::fem {

ElementPoint element_point(const ShapeFunctions& shape, const NodeColumns& x) {
  const Matrix3 J = x * shape.dN;  // dx_i/dxi_j
  return {.gradients = shape.dN * J.inverse(), .jacobian = J.determinant()};
}

StrainMatrix strain_matrix(const NodeGradients& gradients) {
  const Eigen::Index nodes = gradients.rows();
  StrainMatrix B = StrainMatrix::Zero(6, 3 * nodes);
  for (Eigen::Index a = 0; a < nodes; ++a) {
    const double dx = gradients(a, 0), dy = gradients(a, 1), dz = gradients(a, 2);
    B.middleCols<3>(3 * a) << dx, 0, 0, 0, dy, 0, 0, 0, dz, dy, dx, 0, 0, dz, dy, dz, 0, dx;
  }
  return B;
}

}  // namespace hersey::fem
