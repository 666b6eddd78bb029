#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "hersey/core/contract.h"
#include "hersey/core/spatial.h"
#include "hersey/mbd/load_axes.h"
#include "hersey/solver/condensed.h"
#include "hersey/solver/equations.h"

namespace hersey::mbd {

/// Motion of one frame of an elastic body. Velocity and acceleration are in the frame's own axes at its
/// own origin.
struct ElasticFrame {
  Pose X_WF;
  Vector6 V = Vector6::Zero();  ///< [omega; v], v the velocity of the frame's origin
  Vector6 A = Vector6::Zero();  ///< d[omega; v]/dt of these components, gravity taken off as if ground fell with -g
  /// [axial vector of the relative rotation; displacement] against the rest pose in frame 0, in frame 0's axes, where
  /// it is known more precisely than as a difference of poses.
  std::optional<Vector6> deformation = std::nullopt;
};

/// Motion of an elastic body: its frames, and its own coordinates if it has any.
struct ElasticMotion {
  double t = 0;         ///< time [s]
  solver::Stage stage;  ///< stage of the step being solved; its dq is empty
  std::vector<ElasticFrame> frames;
  Eigen::VectorXd eta, eta_rate, eta_acceleration;  ///< own coordinates, shape (coordinate_count)
  Eigen::VectorXd loads;                            ///< present value of each load, in the order of addition
  /// Generalised forces of surfaces on the amplitudes of shapes, and the magnitudes of the terms in their sums; empty
  /// if there are none.
  Eigen::VectorXd shape_forces, shape_force_sizes;
};

/// Amplitudes of a body's shapes at a motion. The last of them are the own coordinates; the others, shape (inner),
/// follow from the frames alone.
struct ShapeMotion {
  Eigen::VectorXd value, rate;  ///< shape (shape_count)
  Eigen::MatrixXd by_frames;    ///< d inner value / d twists of the frames = d rate / d their rates, (inner, 6 frames)
  Eigen::MatrixXd rate_by_frames;  ///< d inner rate / d the same at fixed velocities
};

/// Forces on the nodes of a body's mesh that share one factor: a pressure, a force distributed over a surface.
struct NodalLoad {
  std::string name;
  LoadAxes axes =
      LoadAxes::body;       ///< axes of `forces`: those of ground, or those of the body, with which the forces rotate
  Eigen::Matrix3Xd forces;  ///< for a value of 1 (3, nodes)
};

/// Generalised forces [one wrench per frame; own coordinates] that the motion needs (inertia and gravity, elasticity,
/// damping), and their derivatives. A wrench is [tau; f] at the frame's origin in the frame's axes. Positions are moved
/// by a twist xi of each frame in its own axes, X -> X exp(xi^), at fixed V and A.
struct ElasticResponse {
  Eigen::VectorXd force;      ///< shape (6 frames + coordinates)
  Eigen::VectorXd magnitude;  ///< magnitude of the terms that add up to each entry
  Eigen::MatrixXd K, C, M;    ///< d force / d (position, velocity, acceleration), square
};

/// Power and wrench of a nodal load at one state.
struct ElasticLoad {
  double power = 0;                  ///< [W], > 0 puts energy in
  Vector6 wrench = Vector6::Zero();  ///< [tau; f] about the origin of frame 0, ground axes [N m; N]
};

/// Energies and powers of an elastic body at one state. The powers are balanced: the power of the wrenches on the
/// frames equals kinetic_rate + strain_rate + dissipation - gravity - powers of its loads.
struct ElasticEnergy {
  double kinetic = 0;                          ///< [J]
  double strain = 0;                           ///< [J]
  double potential = 0;                        ///< potential energy of gravity, zero at ground's origin [J]
  double kinetic_rate = 0;                     ///< [W]
  double strain_rate = 0;                      ///< [W]
  double dissipation = 0;                      ///< [W], >= 0
  double gravity = 0;                          ///< power of gravity [W]
  Vector3 momentum = Vector3::Zero();          ///< ground axes [kg m/s]
  Vector3 angular_momentum = Vector3::Zero();  ///< about ground's origin, ground axes [kg m^2/s]
  std::vector<ElasticLoad> loads;              ///< loads in the order of addition
};

/// A deformable body that is connected to a mechanism through frames. Each frame is a massless rigid body of the
/// mechanism, to which joints and forces attach as to any other; the elastic body couples them (theory manual, chapter
/// flexible-bodies). Frame 0 defines the body's axes; the others have the pose `rest_pose` while the body is not
/// deformed.
class ElasticBody : public solver::Condensed<ElasticMotion> {
 public:
  /// Returns the number of frames, >= 1.
  [[nodiscard]] virtual int frame_count() const = 0;
  /// Returns the number of coordinates that the mechanism integrates for the body beside those of its frames; each is a
  /// length [m].
  [[nodiscard]] virtual int coordinate_count() const = 0;
  /// Returns the pose of frame `i` in frame 0 of the undeformed body.
  [[nodiscard]] virtual Pose rest_pose(int i) const = 0;
  /// Returns the mass [kg].
  [[nodiscard]] virtual double mass() const = 0;
  /// Returns the centre of mass of the undeformed body in frame 0 [m].
  [[nodiscard]] virtual Vector3 centre() const = 0;

  /// Adds a load; its value comes with ElasticMotion::loads. @pre the body has a mesh, and `load` a force for each of
  /// its nodes
  virtual void add_load(const NodalLoad& load) {
    (void)load;
    HERSEY_REQUIRE(false, "bodies without a mesh take no nodal loads");
  }

  /// Returns the number of shapes by which its surfaces deform; 0 if no force can depend on the deformation.
  [[nodiscard]] virtual int shape_count() const { return 0; }
  /// Computes the amplitudes of the shapes and, if `want_tangent`, their derivatives.
  virtual void find_shapes(const ElasticMotion& motion, bool want_tangent, ShapeMotion& shapes) {
    (void)motion, (void)want_tangent, (void)shapes;
  }

  /// Computes the forces that `motion` needs and, if `want_tangent`, their derivatives, condensed unknowns included.
  virtual void evaluate(const ElasticMotion& motion, bool want_tangent, ElasticResponse& response) = 0;

  /// Returns the energies and powers.
  /// @param gravity  [m/s^2], ground axes
  [[nodiscard]] virtual ElasticEnergy energy(const ElasticMotion& motion, const Vector3& gravity) = 0;
};

}  // namespace hersey::mbd
