#include "hersey/fem/stress.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "element/elastic_strain.h"
#include "element/element_kind.h"
#include "hersey/core/contract.h"
#include "hersey/fem/finite_strain.h"

namespace hersey::fem {
namespace {

using Continuation = Eigen::MatrixXd;  // (nodes, points)

Eigen::MatrixXd terms_at(ElementType type, const Eigen::Matrix3Xd& xi) {
  const auto terms = kind_of(type).stress_terms;
  Eigen::MatrixXd rows(xi.cols(), terms(Vector3::Zero()).size());
  for (Eigen::Index p = 0; p < xi.cols(); ++p) rows.row(p) = terms(xi.col(p)).transpose();
  return rows;
}

/// Values at the nodes of the polynomial fitted to values at the points of integration; of every type its terms are
/// independent at them.
Continuation continuation(ElementType type, Integration rule) {
  const std::vector<QuadraturePoint>& points = stiffness_points(type, rule);
  Eigen::Matrix3Xd xi(3, points.size());
  for (std::size_t p = 0; p < points.size(); ++p) xi.col(static_cast<Eigen::Index>(p)) = points[p].xi;
  const Eigen::MatrixXd fit = terms_at(type, xi);
  return terms_at(type, natural_nodes(type)) *
         fit.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(fit.rows(), fit.rows()));
}

/// Stresses of one element at its points of integration, and the volume and energy of each.
struct PointStress {
  Eigen::Matrix<double, 6, Eigen::Dynamic> stress;
  Eigen::VectorXd energy, volume;
};

/// @param stretch thermal strain at the nodes of the element; empty: none
PointStress stress_at_points(const Mesh& mesh, const Element& element, const SolidMaterial& material,
                             const Eigen::VectorXd& u, const NodeValues& stretch, Integration integration,
                             StressMeasure measure) {
  NodeColumns x(3, node_count(element.type)), displacement = x;
  for (Eigen::Index a = 0; a < x.cols(); ++a) {
    const int node = mesh.nodes_of(element)[a];
    x.col(a) = mesh.nodes[static_cast<std::size_t>(node)];
    displacement.col(a) = u.segment<3>(3 * node);
  }
  const std::vector<QuadraturePoint>& points = stiffness_points(element.type, integration);
  std::vector<Vector3> xi;
  xi.reserve(points.size());
  Eigen::VectorXd volume(points.size());
  for (const QuadraturePoint& point : points) {
    volume[static_cast<Eigen::Index>(xi.size())] =
        point.weight * element_point(shape_functions(element.type, point.xi), x).jacobian;
    xi.push_back(point.xi);
  }
  if (measure == StressMeasure::finite) {
    const FiniteStress at = finite_strain_stress(element.type, x, material, displacement, integration);
    return {at.stress, at.energy, volume};
  }
  const auto strain = elastic_strain(element.type, x, material, displacement, stretch, xi);
  const Eigen::Matrix<double, 6, Eigen::Dynamic> stress = material.D * strain;
  return {stress, 0.5 * stress.cwiseProduct(strain).colwise().sum().transpose().cwiseProduct(volume), volume};
}

/// Thermal strain at the nodes of an element.
using Stretch = std::function<NodeValues(const Element&)>;

Stress recover(const Mesh& mesh, const std::vector<SolidMaterial>& materials, const Eigen::VectorXd& u,
               const Stretch& stretch, Integration integration, StressMeasure measure) {
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  HERSEY_REQUIRE(u.size() == 3 * nodes, "one displacement per degree of freedom");
  const auto elements = static_cast<Eigen::Index>(mesh.elements.size());
  Stress s;
  s.nodal.setZero(6, nodes);
  s.element.resize(6, elements);
  s.element_energy.resize(elements);
  s.nodal_von_mises.resize(nodes);
  s.element_von_mises.resize(elements);
  Eigen::VectorXd around = Eigen::VectorXd::Zero(nodes);
  std::map<ElementType, Continuation> continued;
  for (Eigen::Index e = 0; e < elements; ++e) {
    const Element& element = mesh.elements[static_cast<std::size_t>(e)];
    const auto [to_nodes, is_new] = continued.try_emplace(element.type);
    if (is_new) to_nodes->second = continuation(element.type, integration);
    const SolidMaterial& material = materials[static_cast<std::size_t>(std::max(element.material, 0))];
    const PointStress at = stress_at_points(mesh, element, material, u, stretch(element), integration, measure);
    s.element.col(e) = at.stress * at.volume / at.volume.sum();
    s.element_energy[e] = at.energy.sum();
    s.element_von_mises[e] = von_mises(s.element.col(e));
    const Eigen::MatrixXd nodal = at.stress * to_nodes->second.transpose();
    for (Eigen::Index a = 0; a < nodal.cols(); ++a) {
      const int node = mesh.nodes_of(element)[a];
      s.nodal.col(node) += nodal.col(a);
      ++around[node];
    }
  }
  s.nodal = s.nodal * around.cwiseInverse().asDiagonal();
  for (Eigen::Index a = 0; a < s.nodal.cols(); ++a) s.nodal_von_mises[a] = von_mises(s.nodal.col(a));
  s.energy = s.element_energy.sum();
  return s;
}

}  // namespace

Stress recover_stress(const ElasticBody& body, const Eigen::VectorXd& u) {
  return recover_stress(body.mesh, body.materials, u, body.integration);
}

Stress recover_stress(const ElasticBody& body, const Eigen::VectorXd& u, const std::vector<ThermalMaterial>& thermal,
                      const Eigen::VectorXd& rise) {
  HERSEY_REQUIRE(rise.size() == body.node_count(), "one temperature per node");
  const Stretch stretch = [&](const Element& element) {
    const auto material = static_cast<std::size_t>(std::max(element.material, 0));
    HERSEY_REQUIRE(material < thermal.size(), "every element's material is given");
    NodeValues strain(node_count(element.type));
    for (Eigen::Index a = 0; a < strain.size(); ++a)
      strain[a] = thermal[material].expansion * rise[body.mesh.nodes_of(element)[a]];
    return strain;
  };
  return recover(body.mesh, body.materials, u, stretch, body.integration, StressMeasure::small);
}

Stress recover_stress(const Mesh& mesh, const std::vector<SolidMaterial>& materials, const Eigen::VectorXd& u,
                      Integration integration, StressMeasure measure) {
  const Stretch none = [](const Element&) { return NodeValues(); };
  return recover(mesh, materials, u, none, integration, measure);
}

}  // namespace hersey::fem
