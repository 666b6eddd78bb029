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

/// One frame of an elastic body as the mechanism moves it. Velocity and acceleration are in the frame's own axes at its
/// own origin.
struct ElasticFrame {
  Pose X_WF;
  Vector6 V = Vector6::Zero();  ///< [omega; v], v the velocity of the frame's origin
  Vector6 A = Vector6::Zero();  ///< d[omega; v]/dt of these components, gravity taken off as if ground fell with -g
  /// [axial vector of the relative rotation; displacement] against the rest pose in frame 0, in frame 0's axes, where
  /// it is known more precisely than as a difference of poses.
  std::optional<Vector6> deformation = std::nullopt;
};

/// What an elastic body sees: its frames, and its own coordinates where it has any.
struct ElasticMotion {
  double t = 0;         ///< time [s]
  solver::Stage stage;  ///< of the step being solved; its dq is left empty
  std::vector<ElasticFrame> frames;
  Eigen::VectorXd eta, eta_rate, eta_acceleration;  ///< own coordinates, shape (coordinate_count)
  Eigen::VectorXd loads;                            ///< value of each load now, in the order they were added
  /// Generalised forces that surfaces put on the amplitudes of shapes, and what they are sums of; empty: none.
  Eigen::VectorXd shape_forces, shape_force_sizes;
};

/// Amplitudes of a body's shapes at a motion. The last of them are the own coordinates; the others, shape (inner),
/// follow from the frames alone.
struct ShapeMotion {
  Eigen::VectorXd value, rate;  ///< shape (shape_count)
  Eigen::MatrixXd by_frames;    ///< d inner value / d twists of the frames = d rate / d their rates, (inner, 6 frames)
  Eigen::MatrixXd rate_by_frames;  ///< d inner rate / d the same at fixed velocities
};

/// Forces on the nodes of a body's mesh that grow and shrink together: a pressure, a force spread over a surface.
struct NodalLoad {
  std::string name;
  LoadAxes axes = LoadAxes::body;  ///< of `forces`: ground's, or the body's, with which they turn
  Eigen::Matrix3Xd forces;         ///< for a value of 1 (3, nodes)
};

/// Generalised forces [one wrench per frame; own coordinates] that the motion needs (inertia and gravity, elasticity,
/// damping), and their derivatives. A wrench is [tau; f] at the frame's origin in the frame's axes. Positions are moved
/// by a twist xi of each frame in its own axes, X -> X exp(xi^), at fixed V and A.
struct ElasticResponse {
  Eigen::VectorXd force;      ///< shape (6 frames + coordinates)
  Eigen::VectorXd magnitude;  ///< of the terms that add up to each entry
  Eigen::MatrixXd K, C, M;    ///< d force / d (position, velocity, acceleration), square
};

/// What a nodal load does at one state.
struct ElasticLoad {
  double power = 0;                  ///< [W], > 0 puts energy in
  Vector6 wrench = Vector6::Zero();  ///< [tau; f] about the origin of frame 0, ground axes [N m; N]
};

/// Energies and powers of an elastic body at one state; the powers add up: what the frames put in equals
/// kinetic_rate + strain_rate + dissipation - gravity - those of its loads.
struct ElasticEnergy {
  double kinetic = 0;                          ///< [J]
  double strain = 0;                           ///< [J]
  double potential = 0;                        ///< of gravity, zero at ground's origin [J]
  double kinetic_rate = 0;                     ///< [W]
  double strain_rate = 0;                      ///< [W]
  double dissipation = 0;                      ///< [W], >= 0
  double gravity = 0;                          ///< power of gravity [W]
  Vector3 momentum = Vector3::Zero();          ///< ground axes [kg m/s]
  Vector3 angular_momentum = Vector3::Zero();  ///< about ground's origin, ground axes [kg m^2/s]
  std::vector<ElasticLoad> loads;              ///< in the order they were added
};

/// A body that deforms and touches the rest of a mechanism through frames. Each frame is a massless rigid body of the
/// mechanism, to which joints and forces attach as to any other; this couples them (theory manual, chapter
/// flexible-bodies). Frame 0 carries the body's own axes; the others stand at `rest_pose` while it is not deformed.
class ElasticBody : public solver::Condensed<ElasticMotion> {
 public:
  /// Frames through which it meets the rest, >= 1.
  [[nodiscard]] virtual int frame_count() const = 0;
  /// Coordinates the mechanism integrates for the body, beside those of its frames; each a length [m].
  [[nodiscard]] virtual int coordinate_count() const = 0;
  /// Pose of frame `i` in frame 0 while the body is not deformed.
  [[nodiscard]] virtual Pose rest_pose(int i) const = 0;
  /// Mass [kg].
  [[nodiscard]] virtual double mass() const = 0;
  /// Centre of mass of the undeformed body in frame 0 [m].
  [[nodiscard]] virtual Vector3 centre() const = 0;

  /// Adds a load; its value comes with ElasticMotion::loads. @pre the body has a mesh, and `load` a force for each of
  /// its nodes
  virtual void add_load(const NodalLoad& load) {
    (void)load;
    HERSEY_REQUIRE(false, "bodies without a mesh take no nodal loads");
  }

  /// How many shapes its surfaces move by; 0: none that a force may see deform.
  [[nodiscard]] virtual int shape_count() const { return 0; }
  /// Their amplitudes and, if `want_tangent`, derivatives of these.
  virtual void find_shapes(const ElasticMotion& motion, bool want_tangent, ShapeMotion& shapes) {
    (void)motion, (void)want_tangent, (void)shapes;
  }

  /// Forces that `motion` needs and, if `want_tangent`, their derivatives, condensed unknowns included.
  virtual void evaluate(const ElasticMotion& motion, bool want_tangent, ElasticResponse& response) = 0;

  /// @param gravity  [m/s^2], ground axes
  [[nodiscard]] virtual ElasticEnergy energy(const ElasticMotion& motion, const Vector3& gravity) = 0;
};

}  // namespace hersey::mbd
