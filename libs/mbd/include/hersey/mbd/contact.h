#pragma once

#include <Eigen/Dense>
#include <memory>
#include <string>
#include <vector>

#include "hersey/mbd/contact_law.h"
#include "hersey/mbd/shape.h"
#include "hersey/mbd/two_body_force.h"

namespace hersey::mbd {

struct ContactPointId;

/// Observation of a contact in frame A.
struct ContactObservation {
  double gap = 0;                      ///< smallest distance between both surfaces, negative where they overlap [m]
  double normal_force = 0;             ///< sum over all contact points [N]
  Vector3 friction = Vector3::Zero();  ///< on B [N]
  Vector3 force = Vector3::Zero();     ///< on B, normal and friction force [N]
  Vector3 position = Vector3::Zero();  ///< centre of the normal forces; not a number without contact [m]
  double damping_power = 0;            ///< power dissipated by damping [W], >= 0
  double friction_power = 0;           ///< power dissipated by friction [W], >= 0
  int spots = 0;                       ///< number of contact points that touch
};

/// Contact between two shapes, each fixed on one body: a force between two frames. The second shape may be a mesh whose
/// corners move with an elastic body; then each corner is a contact point at its deformed position.
///
/// Continuous in position and velocity, its derivatives exact and piecewise continuous; no state of its own. Where the
/// shapes overlap by more than `deepest_share` of the smaller one, the law is not valid and `domain_error` reports it.
/// Only `make_contact_search` (src) depends on the geometry of a pair: the law uses points, normals and material
/// velocities alone.
class Contact final : public TwoBodyForce {
 public:
  /// Largest penetration, as a share of the smaller shape's size (radius, or half its smallest extent).
  static constexpr double deepest_share = 0.2;

  /// @throws ContractError if the pair is not supported, the law has impossible numbers.
  Contact(const ShapeGeometry& a, const ShapeGeometry& b, const ContactLaw& law);

  /// Contact with corners of `b` that move with amplitudes of shapes, which are part of the motion (theory manual eqs.
  /// (contact.4) and (contact.5)).
  /// @param displacements  displacements of the corners in B's axes for unit amplitudes, shape (3 corners, amplitudes)
  Contact(const ShapeGeometry& a, std::shared_ptr<const TriangleMesh> b, Eigen::MatrixXd displacements,
          const ContactLaw& law);
  ~Contact() override;

  void evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) override;
  [[nodiscard]] double stored_energy(const RelativeMotion& motion) const override;
  [[nodiscard]] std::string domain_error() const override;

  /// Returns position and forces of the contact at this motion.
  [[nodiscard]] ContactObservation observe(const RelativeMotion& motion);

 private:
  struct Workspace;
  struct MaterialMotion;
  [[nodiscard]] MaterialMotion material_motion(const RelativeMotion& motion, int corner) const;
  [[nodiscard]] const std::vector<ContactPointId>& find(const RelativeMotion& motion) const;
  [[nodiscard]] double smallest_gap(const RelativeMotion& motion) const;
  void differentiate(const ContactPointId& id, const RelativeMotion& motion, ForceResponse& response) const;
  void push_shapes(const MaterialMotion& material, const Vector3& force, ForceResponse& response) const;
  void differentiate_shapes(const MaterialMotion& material, const Vector3& force,
                            const Eigen::Matrix<double, 6, 12>& derivative, ForceResponse& response) const;
  ContactLaw law_;
  Eigen::MatrixXd displacements_;  ///< displacements of corners that deform; no rows if the mesh is rigid
  double deepest_ = 0;             ///< largest penetration allowed [m]
  double too_deep_ = 0;            ///< penetration at the last evaluation if it exceeds `deepest_`; otherwise 0
  std::unique_ptr<Workspace> work_;
};

/// True if contact between a deforming mesh and this shape is supported: all shapes but meshes.
[[nodiscard]] bool can_touch_deforming(const ShapeGeometry& shape);

/// True if contact between the two is supported: a sphere and anything; a half-space and anything but itself; two
/// capsules; a mesh and any of the others but a mesh.
[[nodiscard]] bool can_touch(const ShapeGeometry& a, const ShapeGeometry& b);

/// True if the law of this pair gives a pressure, with a stiffness in [Pa/m^exponent]: a mesh on anything but a sphere.
[[nodiscard]] bool touches_with_pressure(const ShapeGeometry& a, const ShapeGeometry& b);

/// Returns "sphere", "cylinder", ...
[[nodiscard]] std::string name_of(const ShapeGeometry& shape);

}  // namespace hersey::mbd
