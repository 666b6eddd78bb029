#pragma once

#include "hersey/fem/elastic_body.h"

namespace hersey::fem {

/// Strain energy of a solid element by Green and Lagrange's strain, S = D E (St. Venant and Kirchhoff), and its
/// derivatives by the displacements of the nodes, (elastic.21) to (elastic.23).
struct FiniteStrainElement {
  double energy = 0;      ///< [J]
  Eigen::VectorXd force;  ///< gradient of the energy (3 nodes) [N]
  Eigen::VectorXd rate;   ///< forces by the rate of strain, integral of dE/du^T : D : dE/dt (3 nodes) [N/s]
  ElementMatrix tangent;  ///< second derivative of the energy (3 nodes, 3 nodes), symmetric
};
/// Computes the element's energy and its derivatives.
/// @param u_rate  (3, nodes); null: `rate` is left zero
[[nodiscard]] FiniteStrainElement finite_strain_element(ElementType type, const NodeColumns& x,
                                                        const SolidMaterial& material, const NodeColumns& u,
                                                        Integration rule = Integration::full, bool want_tangent = true,
                                                        const NodeColumns* u_rate = nullptr);

/// Stresses at the points of integration, per unit of deformed area (Cauchy's), F S F^T / det F, components as of
/// `Stress`; and the energy of each point's volume [J]. @verified_by stress_test.cpp: StressOfFiniteStrain_...
struct FiniteStress {
  Eigen::Matrix<double, 6, Eigen::Dynamic> stress;
  Eigen::VectorXd energy;
};
/// Returns the stresses of an element with nodes at `x` + `u`, (3, nodes) [m].
[[nodiscard]] FiniteStress finite_strain_stress(ElementType type, const NodeColumns& x, const SolidMaterial& material,
                                                const NodeColumns& u, Integration rule = Integration::full);

/// Strain energy of a whole body and its derivatives; `tangent` has the pattern of ElasticBody::K and equals K where u
/// = 0.
/// @verified_by finite_strain_test.cpp
struct FiniteStrain {
  double energy = 0;
  Eigen::VectorXd force, rate;
  Eigen::SparseMatrix<double> tangent;  ///< unchanged where it is not wanted
};
/// Computes energy, forces and, if wanted, the tangent of `body` at displacements u (3 n).
/// @param u_rate  (3 n); null: `rate` is left zero
void finite_strain(const ElasticBody& body, const Eigen::VectorXd& u, FiniteStrain& out, bool want_tangent = true,
                   const Eigen::VectorXd* u_rate = nullptr);

}  // namespace hersey::fem
