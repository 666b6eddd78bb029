#pragma once

#include "hersey/fem/elastic_body.h"
#include "hersey/fem/thermal_material.h"

namespace hersey::fem {

/// Stresses of a displaced body [Pa], components xx, yy, zz, xy, yz, xz in the mesh's axes.
struct Stress {
  Eigen::Matrix<double, 6, Eigen::Dynamic> nodal;    ///< (6, nodes): mean over the elements around a node
  Eigen::VectorXd nodal_von_mises;                   ///< (nodes): equivalent stress of `nodal`
  Eigen::Matrix<double, 6, Eigen::Dynamic> element;  ///< (6, elements): mean over the element's volume
  Eigen::VectorXd element_von_mises;                 ///< (elements): equivalent stress of `element`
  Eigen::VectorXd element_energy;                    ///< strain energy of each element [J]
  double energy = 0;                                 ///< sum over the elements; u^T K u / 2 of displacements alone [J]
};

/// Computes the stress sigma = D epsilon at the points of integration, where it is most accurate, and extrapolates it
/// to the nodes by the polynomial of best fit, (elastic.17). Across a face between two materials stresses are
/// discontinuous; their nodal mean there is meaningless.
/// @param u displacements (3 n) [m] @verified_by stress_test.cpp
[[nodiscard]] Stress recover_stress(const ElasticBody& body, const Eigen::VectorXd& u);

/// Computes the stress of a body whose temperature differs from that at which it has its shape: the thermal strain is
/// subtracted from the strain of the displacements, (elastic.29).
/// @param thermal materials of the elements, by Element::material (an element without one takes the first)
/// @param rise of temperature (n) [K]
/// @verified_by thermal_expansion_test.cpp
[[nodiscard]] Stress recover_stress(const ElasticBody& body, const Eigen::VectorXd& u,
                                    const std::vector<ThermalMaterial>& thermal, const Eigen::VectorXd& rise);

/// Relation between displacements and stresses: linear, or by Green and Lagrange's strain (then Cauchy's stress).
enum class StressMeasure { small, finite };

/// Computes the stress from a mesh and its materials alone.
[[nodiscard]] Stress recover_stress(const Mesh& mesh, const std::vector<SolidMaterial>& materials,
                                    const Eigen::VectorXd& u, Integration integration = Integration::full,
                                    StressMeasure measure = StressMeasure::small);

}  // namespace hersey::fem
