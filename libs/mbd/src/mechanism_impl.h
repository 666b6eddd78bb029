#pragma once

#include <vector>

#include "assembly.h"
#include "drive_motion.h"
#include "hersey/mbd/mechanism.h"
#include "load.h"
#include "tree.h"
#include "tree_motion.h"

namespace hersey::mbd {

/// A drive bound to its column.
struct BoundDrive {
  int column = 0;
  int q = 0;
  DriveMotion motion;
};

struct Mechanism::Implementation {
  explicit Implementation(MechanismSpec given);

  MechanismSpec spec;
  Tree tree;
  TreeMotion motion;
  InertiaTerms inertia;
  std::vector<Direction> directions;
  std::vector<Load> loads;
  std::vector<BoundDrive> drives;
  std::vector<int> spring_columns;
  SparseMatrix pattern;             ///< of the tangent, zeros
  SparseMatrix constraint_pattern;  ///< of G, zeros

  std::vector<ForceResponse> responses;    ///< of the two-body forces at the last assembly
  std::vector<Vector6> accepted_wrenches;  ///< at the last accepted step; empty before the first

  [[nodiscard]] Index nlambda() const { return tree.nclosure + static_cast<Index>(drives.size()); }
  [[nodiscard]] int q_of(int column) const { return tree.links[tree.columns[column].link].first_q; }
  [[nodiscard]] double initial_value(const CoordinateRef& coordinate) const;

  void make_patterns();
  void add_two_body_forces(Assembly& assembly, const solver::State& state);
  void add_closures(Assembly& assembly, const solver::State& state) const;
  void add_coordinate_springs(Assembly& assembly, const solver::State& state) const;
  void add_drives(Assembly& assembly, const solver::State& state) const;
  void floor_scales(Eigen::VectorXd& scale) const;
  [[nodiscard]] std::string name_of_velocity(Index row) const;

  // Observation
  [[nodiscard]] FrameMotion frame_motion(const Attachment& frame) const;
  void observe_joint_coordinates(const solver::State& state, Observation& seen) const;
  void observe_efforts(const solver::State& state, Observation& seen);
  void observe_reactions(const solver::State& state, Observation& seen);
  void observe_energies(Observation& seen) const;
};

/// The wrench of a closure's multipliers, with its geometric stiffness, in the form of a two-body force.
[[nodiscard]] ForceResponse closure_response(const Closure& closure, const Pose& X_AB, const Eigen::VectorXd& lambda);

}  // namespace hersey::mbd
