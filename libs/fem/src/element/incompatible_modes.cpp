#include "element/incompatible_modes.h"

#include "hersey/fem/quadrature.h"

namespace hersey::fem {

IncompatibleModes::IncompatibleModes(const NodeColumns& x) {
  const Matrix3 J = x * shape_functions(ElementType::hex8, Vector3::Zero()).dN;
  inverse_ = J.inverse();
  centre_jacobian_ = J.determinant();
}

Eigen::Matrix<double, 6, 9> IncompatibleModes::strain(const Vector3& xi, double jacobian) const {
  // A mode's natural gradient has one component: d(1 - xi_k^2)/dxi_k = -2 xi_k.
  NodeGradients gradients(3, 3);
  for (int k = 0; k < 3; ++k) gradients.row(k) = -2 * xi[k] * (centre_jacobian_ / jacobian) * inverse_.row(k);
  return strain_matrix(gradients);
}

IncompatibleModes::Stiffness IncompatibleModes::stiffness(const NodeColumns& x, const Matrix6& D) const {
  Stiffness k{.K_uu = ElementMatrix::Zero(24, 24), .K_aa = Eigen::Matrix<double, 9, 9>::Zero()};
  k.K_au.setZero(9, 24);
  for (const auto& [xi, weight] : stiffness_points(ElementType::hex8)) {
    const ElementPoint point = element_point(shape_functions(ElementType::hex8, xi), x);
    const StrainMatrix B = strain_matrix(point.gradients);
    const Eigen::Matrix<double, 6, 9> M = strain(xi, point.jacobian);
    const Matrix6 wD = weight * point.jacobian * D;
    k.K_uu.noalias() += B.transpose() * (wD * B).eval();
    k.K_au.noalias() += M.transpose() * (wD * B).eval();
    k.K_aa.noalias() += M.transpose() * wD * M;
  }
  return k;
}

Eigen::Matrix<double, 9, 1> IncompatibleModes::amplitudes(const NodeColumns& x, const Matrix6& D, const NodeColumns& u,
                                                          const Eigen::Matrix<double, 9, 1>& forces) const {
  const Eigen::Map<const Eigen::VectorXd> displacement(u.data(), u.size());
  Eigen::Matrix<double, 9, 9> K_aa = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 1> f = forces;
  for (const auto& [xi, weight] : stiffness_points(ElementType::hex8)) {
    const ElementPoint point = element_point(shape_functions(ElementType::hex8, xi), x);
    const Vector6 e = strain_matrix(point.gradients) * displacement;
    const Eigen::Matrix<double, 6, 9> M = strain(xi, point.jacobian);
    const Eigen::Matrix<double, 6, 9> stress = weight * point.jacobian * D * M;
    K_aa.noalias() += M.transpose() * stress;
    f.noalias() -= stress.transpose() * e;
  }
  return K_aa.llt().solve(f);
}

Eigen::Matrix<double, 9, Eigen::Dynamic, 0, 9, most_nodes> IncompatibleModes::forces(const NodeColumns& x,
                                                                                     const Vector6& stress) const {
  Eigen::Matrix<double, 9, Eigen::Dynamic, 0, 9, most_nodes> f;
  f.setZero(9, x.cols());
  for (const auto& [xi, weight] : stiffness_points(ElementType::hex8)) {
    const ShapeFunctions shape = shape_functions(ElementType::hex8, xi);
    const double jacobian = element_point(shape, x).jacobian;
    f.noalias() += (strain(xi, jacobian).transpose() * (weight * jacobian * stress)) * shape.N.transpose();
  }
  return f;
}

}  // namespace hersey::fem
