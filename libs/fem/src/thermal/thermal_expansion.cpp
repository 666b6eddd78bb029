#include "hersey/fem/thermal_expansion.h"

#include <algorithm>

#include "element/elastic_strain.h"
#include "element/incompatible_modes.h"
#include "hersey/core/contract.h"

namespace hersey::fem {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double expansion_of(const std::vector<ThermalMaterial>& thermal, const Element& element) {
  const auto material = static_cast<std::size_t>(std::max(element.material, 0));
  HERSEY_REQUIRE(material < thermal.size(), "every element's material is given");
  return thermal[material].expansion;
}

}  // namespace

MatrixXd element_expansion(ElementType type, const NodeColumns& x, const SolidMaterial& material, double expansion,
                           Integration rule) {
  const Vector6 stress = expansion * stress_of_stretch(material);
  MatrixXd f = MatrixXd::Zero(3 * x.cols(), x.cols());
  for (const auto& [xi, weight] : stiffness_points(type, rule)) {
    const ShapeFunctions shape = shape_functions(type, xi);
    const ElementPoint point = element_point(shape, x);
    f.noalias() +=
        (strain_matrix(point.gradients).transpose() * (weight * point.jacobian * stress)) * shape.N.transpose();
  }
  if (type != ElementType::hex8) return f;
  const IncompatibleModes modes(x);
  const IncompatibleModes::Stiffness k = modes.stiffness(x, material.D);
  return f - k.K_au.transpose() * k.K_aa.llt().solve(modes.forces(x, stress));
}

MatrixXd expansion_load(const ElasticBody& body, const std::vector<ThermalMaterial>& thermal, const MatrixXd& rise) {
  HERSEY_REQUIRE(rise.rows() == body.node_count(), "one temperature per node");
  MatrixXd f = MatrixXd::Zero(body.size(), rise.cols());
  for (const Element& element : body.mesh.elements) {
    const MatrixXd of_element = element_expansion(element.type, body.positions_of(element), body.material_of(element),
                                                  expansion_of(thermal, element), body.integration);
    const int* node = body.mesh.nodes_of(element);
    const std::vector<int> nodes(node, node + node_count(element.type));
    const MatrixXd forces = of_element * rise(nodes, Eigen::all);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      f.middleRows<3>(3 * nodes[a]) += forces.middleRows<3>(3 * static_cast<Index>(a));
  }
  return f;
}

}  // namespace hersey::fem
