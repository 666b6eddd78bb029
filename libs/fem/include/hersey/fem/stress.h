#pragma once

#include "hersey/fem/elastic_body.h"
#include "hersey/fem/thermal_material.h"

namespace hersey::fem {

/// Stresses of a displaced body [Pa], components xx, yy, zz, xy, yz, xz in the mesh's axes.
struct Stress {
  Eigen::Matrix<double, 6, Eigen::Dynamic> nodal;    ///< (6, nodes): mean over the elements around a node
  Eigen::VectorXd nodal_von_mises;                   ///< (nodes): of `nodal`
  Eigen::Matrix<double, 6, Eigen::Dynamic> element;  ///< (6, elements): mean over the element's volume
  Eigen::VectorXd element_von_mises;                 ///< (elements): of `element`
  Eigen::VectorXd element_energy;                    ///< strain energy of each element [J]
  double energy = 0;                                 ///< their sum; u^T K u / 2 of displacements alone [J]
};

/// Stress sigma = D epsilon at the points of integration, where it is most accurate, continued to the nodes by the
/// polynomial that fits it best, (elastic.17). Across a face between two materials stresses jump; their mean over it
/// says nothing there.
/// @param u displacements (3 n) [m] @verified_by stress_test.cpp
[[nodiscard]] Stress recover_stress(const ElasticBody& body, const Eigen::VectorXd& u);

/// The same of a body whose temperature is no longer that at which it has its shape: the thermal strain is taken off
/// that of the displacements, (elastic.29).
/// @param thermal of the elements, by Element::material (none given: the first) @param rise of temperature (n) [K]
/// @verified_by thermal_expansion_test.cpp
[[nodiscard]] Stress recover_stress(const ElasticBody& body, const Eigen::VectorXd& u,
                                    const std::vector<ThermalMaterial>& thermal, const Eigen::VectorXd& rise);

/// How displacements make stresses: in proportion, or by Green and Lagrange's strain (then Cauchy's stress).
enum class StressMeasure { small, finite };

/// The same of a mesh and its materials alone.
[[nodiscard]] Stress recover_stress(const Mesh& mesh, const std::vector<SolidMaterial>& materials,
                                    const Eigen::VectorXd& u, Integration integration = Integration::full,
                                    StressMeasure measure = StressMeasure::small);

}  // namespace hersey::fem
