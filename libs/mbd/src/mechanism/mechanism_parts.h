#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "elastic/elastic_assembly.h"
#include "force/load.h"
#include "hersey/core/stopwatch.h"
#include "hersey/mbd/energy_view.h"
#include "hersey/mbd/mechanism_spec.h"
#include "hersey/mbd/observation.h"
#include "mechanism/shared_reactions.h"
#include "tree/assembly.h"
#include "tree/coupling.h"
#include "tree/drive_motion.h"
#include "tree/tree.h"
#include "tree/tree_motion.h"

namespace hersey::mbd {

/// A drive bound to its column.
struct BoundDrive {
  int column = 0;
  int q = 0;
  DriveMotion motion;
};

/// Data of a Mechanism: its tree, the connections of its parts to the tree, scratch memory.
struct MechanismParts {
  using Index = solver::Equations::Index;
  using SparseMatrix = solver::Equations::SparseMatrix;

  explicit MechanismParts(MechanismSpec given);

  MechanismSpec spec;
  Tree tree;
  TreeMotion motion;
  InertiaTerms inertia;
  std::vector<Direction> directions;
  std::vector<Load> loads;
  std::vector<Coupling> couplings;
  std::vector<BoundDrive> drives;
  std::vector<ElasticAssembly> elastics;
  int nq = 0, nv = 0;  ///< coordinates of the tree, then own coordinates of elastic bodies
  std::vector<int> spring_columns;
  std::vector<int> coordinate_force_columns;
  std::vector<std::vector<int>> shared_columns;  ///< of the coordinates on which shared unknowns depend
  SparseMatrix pattern;                          ///< pattern of the tangent with zero values
  SparseMatrix constraint_pattern;               ///< pattern of G with zero values

  /// Indices in `elastics` of the bodies on whose deformation a two-body force depends; -1: none.
  struct Sides {
    int a = -1, b = -1;
  };
  std::vector<Sides> sides;                ///< elastic bodies of each two-body force
  std::vector<std::size_t> costly, cheap;  ///< two-body forces worth a thread each, and the others
  std::vector<char> deforms_surface;       ///< for each elastic body: a force depends on its deformation
  std::vector<RelativeMotion> relatives;   ///< relative motions of the two-body forces at the last assembly
  std::vector<ForceResponse> responses;    ///< responses of the two-body forces at the last assembly
  MechanismTiming timing;
  std::vector<ForceResponse> accepted;  ///< at the last accepted step, wrenches and forces alone; empty before

  // Multipliers: closures, then couplings, then drives.
  [[nodiscard]] Index row_of_coupling(std::size_t i) const { return tree.nclosure + static_cast<Index>(i); }
  [[nodiscard]] Index row_of_drive(std::size_t i) const { return row_of_coupling(couplings.size() + i); }
  [[nodiscard]] Index nlambda() const { return row_of_drive(drives.size()); }
  [[nodiscard]] int q_of(int column) const { return tree.links[tree.columns[column].link].first_q; }
  [[nodiscard]] double initial_value(const CoordinateRef& coordinate) const;
  [[nodiscard]] double initial_rate(const CoordinateRef& coordinate) const;
  [[nodiscard]] solver::State initial_state() const;
  [[nodiscard]] std::vector<Index> given_coordinates() const;
  [[nodiscard]] std::vector<Index> given_rates() const;
  template <class Choose>
  [[nodiscard]] std::vector<Index> columns_where(Choose is_chosen) const;
  [[nodiscard]] std::vector<Index> elastic_coordinates() const;
  [[nodiscard]] std::vector<Index> internal_coordinates() const;
  [[nodiscard]] bool is_deformation(int joint) const;
  [[nodiscard]] double largest_rate(const solver::State& start) const;

  // Redundant constraints
  std::vector<Redundancy> redundancies;
  std::optional<SharedReactions> shared_reactions;  ///< empty if no constraint is redundant
  std::string constraint_violation;  ///< name of the joint whose omitted rows are violated; empty if there is none
  void release_redundant_rows();
  [[nodiscard]] double opening_of(const Closure& closure) const;
  void watch_dropped_rows();

  void add_elastic_bodies();
  /// Calls visit(elastic) for each, and takes its time.
  template <class Visit>
  void for_each_elastic(Visit visit) {
    for (std::size_t i = 0; i < elastics.size(); ++i) {
      const Stopwatch one(timing.elastic[i]);
      visit(elastics[i]);
    }
  }
  /// True if anything moves on with the steps that is no coordinate.
  [[nodiscard]] bool has_stateful_parts() const {
    return !spec.forces.empty() || !elastics.empty() || !spec.shared.empty();
  }
  /// Calls visit(owner, part) for all that may condense unknowns; owner() is its name in messages.
  template <class Visit>
  void for_each_part(Visit visit) {
    for (const MechanismSpec::Force& force : spec.forces) visit([&] { return force.name; }, *force.force);
    for (const MechanismSpec::Shared& shared : spec.shared) visit([&] { return shared.name; }, *shared.unknowns);
    for (const ElasticAssembly& elastic : elastics) visit([&] { return "body " + elastic.name(); }, elastic.body());
  }
  void make_patterns();
  void find_deforming_surfaces();
  [[nodiscard]] RelativeMotion relative_motion(std::size_t force, double t) const;
  /// Calls visit(row, column) for the entries of the tangent by the shapes on which force i depends.
  template <class Visit>
  void visit_surface_columns(std::size_t i, Visit visit) const;
  void read_elastic_bodies(const solver::State& state);
  void evaluate_two_body_forces(const Assembly& assembly, const solver::State& state);
  void follow_shared(const Assembly& assembly, const solver::State& state);
  Eigen::VectorXd v_begun;  ///< velocities at the beginning of the step
  void add_inertia_and_elasticity(Assembly& assembly, const solver::State& state);
  void hand_out_shape_forces(const std::vector<ForceResponse>& of_forces);
  void add_two_body_forces(Assembly& assembly) const;
  void for_each_force(const std::function<void(std::size_t)>& act);
  void add_closures(Assembly& assembly, const solver::State& state) const;
  [[nodiscard]] double closure_length(const Closure& closure, const Pose& X_WA) const;
  void add_coordinate_springs(Assembly& assembly, const solver::State& state) const;
  void add_coordinate_forces(Assembly& assembly, const solver::State& state) const;
  void add_couplings(Assembly& assembly, const solver::State& state) const;
  void add_drives(Assembly& assembly, const solver::State& state) const;
  [[nodiscard]] double coupling_scale(const Coupling& coupling, const solver::State& state) const;
  void floor_scales(Eigen::VectorXd& scale) const;
  [[nodiscard]] std::string name_of_velocity(Index row) const;

  // Observation
  [[nodiscard]] FrameMotion frame_motion(const Attachment& frame) const;
  void observe_joint_coordinates(const solver::State& state, Observation& observation) const;
  void observe_efforts(const solver::State& state, Observation& observation);
  void observe_reactions(const solver::State& state, Observation& observation);
  void observe_drift(const solver::State& state, Observation& observation) const;
  void observe_energies(Observation& observation) const;
  void observe_elastic_bodies(Observation& observation);

  // Energy of a step
  using Retract = std::function<void(const Eigen::VectorXd&, const Eigen::VectorXd&, Eigen::VectorXd&)>;
  std::optional<TreeMotion> aside;  ///< at states between the ends of a step; made when first needed
  void view_loads(const TreeMotion& at, const solver::State& state, std::vector<Eigen::VectorXd>& generalised);
  void view_stores(const solver::State& state, EnergyView& view);
  [[nodiscard]] Eigen::VectorXd way_between(const EnergyView& from, const EnergyView& to) const;
  void work_of_functions(const EnergyView& from, const EnergyView& to, const Eigen::VectorXd& way,
                         const Retract& retract, WorkBetween& work);
};

/// Returns the kinetic energy of the rigid bodies fixed on a link with the pose X_WL and the velocity V [J].
[[nodiscard]] double kinetic_energy_of(const Link& link, const Pose& X_WL, const Vector6& V);

/// The wrench of a closure's multipliers in the form of a two-body force; its geometric stiffness where asked for.
[[nodiscard]] ForceResponse closure_response(const Closure& closure, const Pose& X_AB, const Eigen::VectorXd& lambda,
                                             bool with_derivative);

}  // namespace hersey::mbd
