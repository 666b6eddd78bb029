#pragma once

#include <Eigen/Dense>

#include "hersey/core/spatial.h"
#include "hersey/fem/elastic_material.h"

namespace hersey::fem {

/// Cross-section of a beam in its own axes: x along the beam, y and z principal.
struct BeamSection {
  double area = 0;                  ///< [m^2]
  double shear_y = 0, shear_z = 0;  ///< effective areas in shear along y and z [m^2]
  double I_y = 0, I_z = 0;          ///< second moments of area about y and z [m^4]
  double J = 0;                     ///< torsion constant [m^4]
};

/// Stiffness of a section against the strains of a beam: stretch and shears, twist and bending about y and z.
struct BeamStiffness {
  double EA = 0, GA_y = 0, GA_z = 0;  ///< [N]
  double GJ = 0, EI_y = 0, EI_z = 0;  ///< [N m^2]
};
/// Returns the stretch, shear, torsion and bending stiffness of a section. @throws ContractError unless all its areas
/// are > 0
[[nodiscard]] BeamStiffness beam_stiffness(const BeamSection& section, const ElasticMaterial& material);

/// Beam element between two nodes a and b, straight while undeformed.
struct BeamElement {
  Matrix3 frame = Matrix3::Identity();  ///< axes of the undeformed section in those of the nodes; x from a to b
  double length = 0;                    ///< length of the undeformed element [m]
  BeamStiffness stiffness;
};

/// Components at both nodes, each in its node's own axes: [theta; d] or [moment; force] of a, then of b.
using BeamVector = Eigen::Matrix<double, 12, 1>;
using BeamMatrix = Eigen::Matrix<double, 12, 12>;

/// Motion of both ends of an element: poses of its nodes in any common axes, velocities [omega; v] each in its node's
/// own axes at the node.
struct BeamMotion {
  Pose X_a, X_b;
  Vector6 V_a = Vector6::Zero(), V_b = Vector6::Zero();
};

/// Response of a deformed element, everything in the nodes' own axes. Positions are varied by twists in these axes, X
/// -> X exp(xi^), at fixed V.
struct BeamMotionResponse {
  double energy = 0;       ///< [J]
  double energy_rate = 0;  ///< [W]
  double dissipation = 0;  ///< [W], >= 0
  Vector6 strain;          ///< strains [Gamma; kappa], axes of the middle section [-; 1/m]
  Vector6 elastic;         ///< section force and moment [N; M] in the same axes [N; N m]
  Vector6 viscous;         ///< section force and moment by the rates of strain
  BeamVector force;        ///< elastic and viscous: [moment; force] at node a, at node b
  BeamMatrix K, C;         ///< d force / d position, d force / d velocity; exact
};

/// Returns the forces of the strains, which are the gradient of their energy, (elastic.18) to (elastic.20), and the
/// forces of the rates of strain times `damping` [s], theory manual eq. (beams.2), (beams.3).
/// @verified_by beam_test.cpp, beam_segment_test.cpp
[[nodiscard]] BeamMotionResponse beam_response(const BeamElement& element, const BeamMotion& motion, double damping);

}  // namespace hersey::fem
