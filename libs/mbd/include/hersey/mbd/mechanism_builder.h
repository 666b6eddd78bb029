#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hersey/mbd/mechanism_spec.h"

namespace hersey::mbd {

class Mechanism;

/// Collects a mechanism part by part; `finalise` finds its spanning tree and makes it ready to move.
///
/// @code
///   MechanismBuilder builder;
///   const BodyId crank = builder.add_body({.name = "crank", .mass = 5, .inertia = J});
///   const JointId main = builder.add_joint({.name = "main", .type = JointType::revolute,
///                                           .inboard = builder.frame_of(builder.ground()), .outboard =
///                                           builder.frame_of(crank)});
///   std::unique_ptr<Mechanism> mechanism = builder.finalise();
/// @endcode
class MechanismBuilder {
 public:
  MechanismBuilder();

  /// Sets the acceleration of gravity [m/s^2], ground axes; zero by default.
  void set_gravity(const Vector3& gravity) { spec_.gravity = gravity; }

  /// Cuts chains of bodies wherever more than `longest` velocity components move one of them: the body beyond gets
  /// coordinates of its own, and the joint becomes a constraint. The work of a step then grows in proportion to the
  /// length of a chain, else with its cube. For integrators with a spectral radius below 1, as all constraints.
  void cut_paths(int longest = 24) { spec_.longest_path = longest; }

  /// Counts the nodes of loose beams from ground instead of from their first node, which is light and would carry all
  /// others: their coordinates are then absolute, and the matrix is a band. A beam is loose where it moves with bodies
  /// that close no loop, and no drive or coupling moves any of them. For motions that start undeformed; what takes
  /// deformations for coordinates (modes, equilibria, static starts) needs them counted from the first node.
  void loosen_beams() { spec_.loosens_beams = true; }

  /// Chooses the tree so that no body carries others of ten times its moment of inertia or more, as far as joints allow
  /// a choice: bodies that move freely or in a plane, close no loop and are not driven get coordinates of their own, or
  /// are carried by another body of their group. The observed coordinates of joints do not change.
  void choose_roots() { spec_.chooses_roots = true; }
  /// Returns ground, the body that does not move.
  [[nodiscard]] static BodyId ground() { return {0}; }
  [[nodiscard]] FrameId frame_of(BodyId body) const;  ///< the body's own frame

  /// Adds a rigid body with a frame of its own.
  BodyId add_body(BodySpec body);
  /// @throws ContractError unless the body exists and the axes are a rotation
  FrameId add_frame(FrameSpec frame);
  /// Adds a joint and normalises its axis. @throws ContractError for frames that do not exist, an axis of no length, or
  /// other than one initial value or rate per degree of freedom
  JointId add_joint(JointSpec joint);
  /// Adds a force that acts on b's body and with opposite sign on a's. It depends on the motion of frame b relative to
  /// frame a and on the shapes of elastic bodies that carry these frames.
  ForceId add_force(std::string name, FrameId a, FrameId b, std::shared_ptr<TwoBodyForce> force,
                    const ForceSurfaces& surfaces = {});
  /// Adds unknowns that some of the two-body forces share, and the coordinates on whose rates they depend.
  void add_shared_unknowns(std::string name, std::shared_ptr<SharedUnknowns> unknowns,
                           std::vector<CoordinateRef> coordinates = {});
  /// Adds a force or torque on a frame. @throws ContractError for a frame that does not exist or a term without
  /// magnitude
  LoadId add_load(LoadSpec load);
  /// Adds a force or torque on a scalar joint coordinate, between the two bodies of the joint.
  CoordinateForceId add_coordinate_force(std::string name, CoordinateRef coordinate,
                                         std::shared_ptr<CoordinateForce> force);
  /// Adds a spring and damper on a scalar joint coordinate.
  SpringId add_spring(CoordinateSpringSpec spring);
  /// Prescribes a scalar joint coordinate. @throws ContractError for a drive without function
  DriveId add_drive(DriveSpec drive);
  /// Adds a relation between scalar joint coordinates. @throws ContractError for a term without function
  CouplingId add_coupling(CouplingSpec coupling);

  /// Adds a flexible body: its frames become massless bodies `name`, `name.frame_names[0]`, ..., at rest_pose of the
  /// first, free to move against it, and `body` couples them. Joints and forces attach to them as to rigid bodies.
  /// @param frame_names  names of all frames but the first
  FlexibleBodyIds add_flexible_body(const std::string& name, const std::vector<std::string>& frame_names,
                                    std::shared_ptr<ElasticBody> body);

  /// Adds forces on the nodes of a flexible body; `value` is a function of time.
  void add_nodal_load(ElasticId elastic, const NodalLoad& load, std::shared_ptr<const ScalarFunction> value);

  /// Returns the present number of nodal loads on a flexible body.
  [[nodiscard]] std::size_t nodal_loads(ElasticId elastic) const;

  /// Adds a beam: its nodes become massless bodies `name`, `name.node_names[0]`, ..., free to move against the first,
  /// and each segment couples two that follow each other.
  /// @param node_names  names of all nodes but the first
  BeamBodyIds add_beam_body(const std::string& name, const std::vector<std::string>& node_names,
                            std::vector<std::shared_ptr<ElasticBody>> segments);

  /// @throws InputError if a body, spring or joint makes no physical sense (all faults together), or two drives act on
  ///         one coordinate; ContractError if an id or a count is not the builder's own.
  [[nodiscard]] std::unique_ptr<Mechanism> finalise();

 private:
  /// Adds a massless body at the pose `rest` in `base`, free to move against it.
  BodyId add_free_frame(const std::string& name, BodyId base, const Pose& rest);

  MechanismSpec spec_;
};

}  // namespace hersey::mbd
