#pragma once

#include <Eigen/Dense>

#include "hersey/core/spatial.h"
#include "hersey/fem/elastic_material.h"

namespace hersey::fem {

/// Cross-section in its own axes: x along the beam, y and z principal.
struct BeamSection {
  double area = 0;                  ///< [m^2]
  double shear_y = 0, shear_z = 0;  ///< effective areas in shear along y and z [m^2]
  double I_y = 0, I_z = 0;          ///< second moments of area about y and z [m^4]
  double J = 0;                     ///< torsion constant [m^4]
};

/// What resists the strains of a beam: stretch and shears, twist and bending about y and z.
struct BeamStiffness {
  double EA = 0, GA_y = 0, GA_z = 0;  ///< [N]
  double GJ = 0, EI_y = 0, EI_z = 0;  ///< [N m^2]
};
/// Stretch, shear, torsion and bending stiffness of a section. @throws ContractError unless all its areas are > 0
[[nodiscard]] BeamStiffness beam_stiffness(const BeamSection& section, const ElasticMaterial& material);

/// Between two nodes a and b, straight while undeformed.
struct BeamElement {
  Matrix3 frame = Matrix3::Identity();  ///< axes of the undeformed section in those of the nodes; x from a to b
  double length = 0;                    ///< undeformed [m]
  BeamStiffness stiffness;
};

/// Of both nodes, each in its own axes at the node: [theta; d] or [moment; force] of a, then of b.
using BeamVector = Eigen::Matrix<double, 12, 1>;
using BeamMatrix = Eigen::Matrix<double, 12, 12>;

/// Both ends of an element that moves: poses of its nodes in any common axes, velocities [omega; v] each in its node's
/// own axes at the node.
struct BeamMotion {
  Pose X_a, X_b;
  Vector6 V_a = Vector6::Zero(), V_b = Vector6::Zero();
};

/// What deforming an element takes, everything in the nodes' own axes. Positions are moved by twists in these axes,
/// X -> X exp(xi^), at fixed V.
struct BeamMotionResponse {
  double energy = 0;       ///< [J]
  double energy_rate = 0;  ///< [W]
  double dissipation = 0;  ///< [W], >= 0
  Vector6 strain;          ///< [Gamma; kappa], axes of the middle section [-; 1/m]
  Vector6 elastic;         ///< [N; M] there [N; N m]
  Vector6 viscous;         ///< the same from the rates of strain
  BeamVector force;        ///< elastic and viscous: [moment; force] at node a, at node b
  BeamMatrix K, C;         ///< d force / d position, d force / d velocity; exact
};

/// Forces of strains, the gradient of their energy, (elastic.18) to (elastic.20), and of their rates times `damping`
/// [s], theory manual eq. (beams.2), (beams.3).
/// @verified_by beam_test.cpp, beam_segment_test.cpp
[[nodiscard]] BeamMotionResponse beam_response(const BeamElement& element, const BeamMotion& motion, double damping);

}  // namespace hersey::fem
