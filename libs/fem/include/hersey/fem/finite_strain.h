#pragma once

#include <string>
#include <vector>

#include "hersey/fem/elastic_body.h"
#include "hersey/fem/held_stiffness.h"

namespace hersey::fem {

/// Strain energy of a solid element by Green and Lagrange's strain, S = D E (St. Venant and Kirchhoff), and its
/// derivatives by the displacements of the nodes, (elastic.21) to (elastic.23).
struct FiniteStrainElement {
  double energy = 0;      ///< [J]
  Eigen::VectorXd force;  ///< gradient (3 nodes) [N]
  Eigen::VectorXd rate;   ///< by the rate of strain, integral of dE/du^T : D : dE/dt (3 nodes) [N/s]
  ElementMatrix tangent;  ///< second derivative (3 nodes, 3 nodes), symmetric
};
/// @param u_rate  (3, nodes); null: `rate` is left zero
[[nodiscard]] FiniteStrainElement finite_strain_element(ElementType type, const NodeColumns& x,
                                                        const SolidMaterial& material, const NodeColumns& u,
                                                        Integration rule = Integration::full, bool want_tangent = true,
                                                        const NodeColumns* u_rate = nullptr);

/// Stresses at the points of integration, per unit of area as it is there (Cauchy's), F S F^T / det F, components as of
/// `Stress`; and the energy of each point's volume [J]. @verified_by stress_test.cpp: StressOfFiniteStrain_...
struct FiniteStress {
  Eigen::Matrix<double, 6, Eigen::Dynamic> stress;
  Eigen::VectorXd energy;
};
/// Of an element with nodes at `x` + `u`, (3, nodes) [m].
[[nodiscard]] FiniteStress finite_strain_stress(ElementType type, const NodeColumns& x, const SolidMaterial& material,
                                                const NodeColumns& u, Integration rule = Integration::full);

/// The same of a whole body; `tangent` has the pattern of ElasticBody::K and is K where u = 0.
struct FiniteStrain {
  double energy = 0;
  Eigen::VectorXd force, rate;
  Eigen::SparseMatrix<double> tangent;  ///< left alone where it is not wanted
};
/// @param u_rate  (3 n); null: `rate` is left zero
void finite_strain(const ElasticBody& body, const Eigen::VectorXd& u, FiniteStrain& out, bool want_tangent = true,
                   const Eigen::VectorXd* u_rate = nullptr);

struct LargeDisplacementOptions {
  int steps = 5;  ///< load and prescribed displacements grow in as many equal parts, halved where Newton's method fails
  int most_iterations = 25;  ///< of one part
  double tolerance = 1e-10;  ///< of the last correction, over the body's size
};

struct LargeDisplacement {
  bool ok = false;
  std::string message;  ///< why not; u is then that of the largest load reached
  double load = 0;      ///< share of the load reached
  int iterations = 0;
  Eigen::VectorXd u;  ///< (3 n) [m]
};

/// Equilibrium with forces `f` (3 n) that keep their directions, displacements as large as they like, strains moderate:
/// beyond some ten percent of compression the material itself gives way.
/// @verified_by finite_strain_test.cpp
[[nodiscard]] LargeDisplacement solve_large_displacement(const ElasticBody& body, const std::vector<Support>& supports,
                                                         const Eigen::VectorXd& f,
                                                         const LargeDisplacementOptions& options = {});

}  // namespace hersey::fem
