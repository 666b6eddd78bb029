#pragma once

#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include "hersey/core/spatial.h"
#include "hersey/fem/elastic_material.h"
#include "hersey/fem/mesh.h"

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

struct BeamElement {
  int a = 0, b = 0;                     ///< nodes
  Matrix3 frame = Matrix3::Identity();  ///< axes of the undeformed section in the mesh's axes; x from a to b
  double length = 0;                    ///< undeformed [m]
  BeamStiffness stiffness;
};

/// Beams on a mesh; each element is straight while undeformed.
struct BeamBody {
  std::vector<Vector3> nodes;
  std::vector<BeamElement> elements;
};

/// The beam2 elements of `mesh`, all with one stiffness; the section's z-axis is the part of `up` across the element.
/// @throws InputError naming elements of no length, or along `up`
[[nodiscard]] BeamBody beam_body(const Mesh& mesh, const BeamStiffness& stiffness, const Vector3& up);

/// Where the nodes are and how the material around them has turned.
struct BeamState {
  std::vector<Vector3> r;             ///< [m]
  std::vector<Eigen::Quaterniond> R;  ///< from the undeformed state
};
/// The nodes where the body has them, nothing turned.
[[nodiscard]] BeamState undeformed(const BeamBody& body);

/// Six unknowns per node, [theta; d]: a small turn in the axes that turn with the node, and a displacement in the
/// mesh's axes.
using BeamVector = Eigen::Matrix<double, 12, 1>;
using BeamMatrix = Eigen::Matrix<double, 12, 12>;

/// Strain energy, its gradient and the derivative of that, of one element, (elastic.18) to (elastic.20).
struct BeamResponse {
  double energy = 0;   ///< [J]
  BeamVector force;    ///< gradient: [moment; force] at node a, at node b
  BeamMatrix tangent;  ///< exact; symmetric where all forces on the nodes balance
};
/// Of `element` with its nodes as in `state`.
[[nodiscard]] BeamResponse beam_response(const BeamElement& element, const BeamState& state);

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

/// Theory manual eq. (beams.2), (beams.3): forces of strains and of their rates times `damping` [s].
[[nodiscard]] BeamMotionResponse beam_response(const BeamElement& element, const BeamMotion& motion, double damping);

/// Moves a state by small unknowns (6 nodes): R exp(theta), r + d.
void move(BeamState& state, const Eigen::VectorXd& small);

/// Force and moment on a node that keep their directions in space.
struct BeamLoad {
  int node = 0;
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
};

struct BeamStaticOptions {
  int steps = 10;            ///< the load grows in as many equal parts; parts are halved where Newton's method fails
  int most_iterations = 20;  ///< of one part
  double tolerance = 1e-11;  ///< of the last correction, over the body's size, and in rad
};

struct BeamStaticSummary {
  bool ok = false;
  std::string message;  ///< why not; the state is then that of the largest load reached
  double load = 0;      ///< share of the load reached
  int iterations = 0;   ///< of Newton's method, altogether
};

/// Equilibrium of a beam whose `held` unknowns (places among 6 nodes) do not move, from `state` on with growing load.
[[nodiscard]] BeamStaticSummary solve_beam(const BeamBody& body, const std::vector<int>& held,
                                           const std::vector<BeamLoad>& loads, BeamState& state,
                                           const BeamStaticOptions& options = {});

/// How many independent motions would release energy at an equilibrium: 0 if it is stable. -1: it is at a point of
/// buckling itself.
[[nodiscard]] int unstable_motions(const BeamBody& body, const std::vector<int>& held,
                                   const std::vector<BeamLoad>& loads, const BeamState& state);

}  // namespace hersey::fem
