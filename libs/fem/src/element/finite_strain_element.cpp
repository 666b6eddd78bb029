#include "element/incompatible_modes.h"
#include "hersey/core/contract.h"
#include "hersey/fem/finite_strain.h"

namespace hersey::fem {
namespace {

/// Components of a symmetric tensor in the order xx, yy, zz, xy, yz, xz, shears doubled.
Vector6 strain_components(const Matrix3& E) {
  return (Vector6() << E.diagonal(), 2 * E(0, 1), 2 * E(1, 2), 2 * E(0, 2)).finished();
}

Matrix3 stress_tensor(const Vector6& s) {
  return (Matrix3() << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]).finished();
}

/// dE = B du: row ij, node a: F^T_i N_a,j, made symmetric.
StrainMatrix strain_variation(const NodeGradients& gradients, const Matrix3& F) {
  StrainMatrix B(6, 3 * gradients.rows());
  for (Eigen::Index a = 0; a < gradients.rows(); ++a) {
    const Eigen::RowVector3d g = gradients.row(a);
    auto columns = B.middleCols<3>(3 * a);
    for (int i = 0; i < 3; ++i) columns.row(i) = g[i] * F.col(i).transpose();
    columns.row(3) = g[1] * F.col(0).transpose() + g[0] * F.col(1).transpose();
    columns.row(4) = g[2] * F.col(1).transpose() + g[1] * F.col(2).transpose();
    columns.row(5) = g[2] * F.col(0).transpose() + g[0] * F.col(2).transpose();
  }
  return B;
}

/// Quantities at one point of integration.
struct Point {
  NodeGradients gradients;
  StrainMatrix B;
  Vector6 strain, rate;
  Eigen::Matrix<double, 6, 9> modes;  // of hex8
  double volume;
};

std::vector<Point> points_of(ElementType type, const NodeColumns& x, const NodeColumns& u, const NodeColumns* u_rate,
                             Integration rule) {
  const std::optional<IncompatibleModes> incompatible =
      type == ElementType::hex8 ? std::optional<IncompatibleModes>(x) : std::nullopt;
  std::vector<Point> points;
  points.reserve(stiffness_points(type, rule).size());
  for (const auto& [xi, weight] : stiffness_points(type, rule)) {
    const ElementPoint at = element_point(shape_functions(type, xi), x);
    // From the gradient itself: F^T F - 1 would leave the round-off of 1 on strains of 1e-9.
    const Matrix3 H = u * at.gradients, F = Matrix3::Identity() + H;
    const Matrix3 E = (H + H.transpose() + H.transpose() * H) / 2;
    Point point{at.gradients,        strain_variation(at.gradients, F), strain_components(E), Vector6::Zero(), {},
                weight * at.jacobian};
    if (u_rate != nullptr) point.rate = point.B * Eigen::Map<const Eigen::VectorXd>(u_rate->data(), u_rate->size());
    if (incompatible) point.modes = incompatible->strain(xi, at.jacobian);
    points.push_back(std::move(point));
  }
  return points;
}

/// Amplitudes of hex8's incompatible strains that make the energy least, and the part of the tangent they take away:
/// the energy is quadratic in them, so that this is exact.
ElementMatrix relax(std::vector<Point>& points, const Matrix6& D) {
  Eigen::Matrix<double, 9, 9> K_aa = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 24> K_au = Eigen::Matrix<double, 9, 24>::Zero();
  Eigen::Matrix<double, 9, 2> f_a = Eigen::Matrix<double, 9, 2>::Zero();  // by the strain, and by its rate
  for (const Point& p : points) {
    const Eigen::Matrix<double, 9, 6> stress = p.volume * p.modes.transpose() * D;
    K_aa += stress * p.modes;
    K_au += stress * p.B;
    f_a.col(0) += stress * p.strain;
    f_a.col(1) += stress * p.rate;
  }
  const Eigen::LLT<Eigen::Matrix<double, 9, 9>> solver(K_aa);
  const Eigen::Matrix<double, 9, 2> amplitude = -solver.solve(f_a);
  for (Point& p : points) {
    p.strain += p.modes * amplitude.col(0);
    p.rate += p.modes * amplitude.col(1);
  }
  return K_au.transpose() * solver.solve(K_au);
}

}  // namespace

FiniteStrainElement finite_strain_element(ElementType type, const NodeColumns& x, const SolidMaterial& material,
                                          const NodeColumns& u, Integration rule, bool want_tangent,
                                          const NodeColumns* u_rate) {
  HERSEY_REQUIRE(x.cols() == u.cols(), "one displacement per node");
  std::vector<Point> points = points_of(type, x, u, u_rate, rule);
  const Eigen::Index nodes = x.cols();
  FiniteStrainElement element{.force = Eigen::VectorXd::Zero(3 * nodes),
                              .rate = Eigen::VectorXd::Zero(3 * nodes),
                              .tangent = ElementMatrix::Zero(3 * nodes, 3 * nodes)};
  if (type == ElementType::hex8) element.tangent = -relax(points, material.D);
  for (const Point& p : points) {
    const Vector6 stress = material.D * p.strain;
    element.energy += p.volume * stress.dot(p.strain) / 2;
    element.force += p.volume * p.B.transpose() * stress;
    if (u_rate != nullptr) element.rate += p.volume * p.B.transpose() * (material.D * p.rate);
    if (!want_tangent) continue;
    const StrainMatrix DB = p.volume * material.D * p.B;
    element.tangent.noalias() += p.B.transpose() * DB;
    const Eigen::MatrixXd geometric = p.volume * p.gradients * stress_tensor(stress) * p.gradients.transpose();
    for (Eigen::Index b = 0; b < nodes; ++b)
      for (Eigen::Index a = 0; a < nodes; ++a)
        element.tangent.block<3, 3>(3 * a, 3 * b).diagonal().array() += geometric(a, b);
  }
  return element;
}

FiniteStress finite_strain_stress(ElementType type, const NodeColumns& x, const SolidMaterial& material,
                                  const NodeColumns& u, Integration rule) {
  std::vector<Point> points = points_of(type, x, u, nullptr, rule);
  if (type == ElementType::hex8) (void)relax(points, material.D);
  FiniteStress at{.stress = Eigen::Matrix<double, 6, Eigen::Dynamic>(6, points.size()),
                  .energy = Eigen::VectorXd(points.size())};
  for (Eigen::Index i = 0; i < at.energy.size(); ++i) {
    const Point& p = points[static_cast<std::size_t>(i)];
    const Vector6 S = material.D * p.strain;
    const Matrix3 F = Matrix3::Identity() + u * p.gradients;
    const Matrix3 sigma = F * stress_tensor(S) * F.transpose() / F.determinant();
    at.stress.col(i) << sigma.diagonal(), sigma(0, 1), sigma(1, 2), sigma(0, 2);
    at.energy[i] = 0.5 * p.volume * S.dot(p.strain);
  }
  return at;
}

}  // namespace hersey::fem
