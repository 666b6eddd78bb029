#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hersey/mbd/energy_view.h"
#include "hersey/mbd/mechanism_spec.h"
#include "hersey/mbd/observation.h"
#include "hersey/solver/equations.h"

namespace hersey::mbd {

struct MechanismParts;

/// Rigid bodies in joint coordinates: recursive kinematics along a spanning tree, loops closed by Lagrange multipliers
/// (theory manual, chapter mechanisms).
///
/// Made by MechanismBuilder::finalise. Topology and parameters are constant; states are passed in; the forces between
/// bodies may keep condensed unknowns of their own (see TwoBodyForce).
class Mechanism final : public solver::Equations {
 public:
  /// Finds the spanning tree of `spec`, which a builder has checked, and its redundant constraints.
  explicit Mechanism(MechanismSpec spec);
  ~Mechanism() override;

  // solver::Equations
  [[nodiscard]] Index nq() const override;
  [[nodiscard]] Index nv() const override;
  [[nodiscard]] Index nlambda() const override;
  void retract(const Eigen::VectorXd& q0, const Eigen::VectorXd& dq, Eigen::VectorXd& q) const override;
  void increment_rate(const Eigen::VectorXd& dq, const Eigen::VectorXd& v, Eigen::VectorXd& rate) const override;
  void assemble(const solver::State& state, const solver::Stage& stage, Eigen::VectorXd& residual,
                Eigen::VectorXd& scale, SparseMatrix* tangent) override;
  void constraints(const solver::State& state, Eigen::VectorXd& phi, Eigen::VectorXd& scale,
                   SparseMatrix* jacobian) override;
  void constraint_rates(const solver::State& state, Eigen::VectorXd& velocity, Eigen::VectorXd& bias) override;
  [[nodiscard]] Eigen::VectorXd position_scales() const override;
  [[nodiscard]] std::string name_of_row(Index row) const override;
  void begin_step(const solver::State& start, double dt) override;
  [[nodiscard]] bool is_step_consistent() override;
  void accept_step(const solver::State& end) override;
  [[nodiscard]] bool has_condensed_unknowns() const override;
  [[nodiscard]] bool needs_tangent() const override;
  [[nodiscard]] double internal_residual() const override;
  [[nodiscard]] std::string name_of_internal_residual() const override;
  [[nodiscard]] std::string domain_error() const override;
  [[nodiscard]] bool has_whole_tangent() const override;
  void persist(Archive& archive) override;

  /// Returns the state given by the joints' initial values at t = 0; it is not yet consistent: see solver::initialise.
  [[nodiscard]] solver::State initial_state() const;

  /// Adds to the rotations that drives prescribe the whole revolutions they have made by the state's time, and to what
  /// is coupled with them what follows: the machine stands as it did, and its constraints are as near as they can be.
  void count_revolutions(solver::State& state) const;

  /// Returns the smallest increment dq with q = q0 (+) dq, the inverse of retract(): rotations of revolute joints less
  /// whole revolutions.
  /// @param counted  velocity components of rotations whose whole revolutions count
  [[nodiscard]] Eigen::VectorXd difference(const Eigen::VectorXd& q0, const Eigen::VectorXd& q,
                                           const std::vector<Index>& counted = {}) const;

  /// Saves or restores what `persist` does, apart from drives and forces of joints, which depend on the time and on
  /// angles that grow with it.
  void persist_between_bodies(Archive& archive);

  /// Returns the velocity components of rotations about one axis, which are the same after a whole revolution.
  [[nodiscard]] std::vector<Index> revolutions() const;
  /// Returns the velocity components that drives prescribe.
  [[nodiscard]] std::vector<Index> driven_coordinates() const;

  /// Returns the velocity components that springs on joints hold.
  [[nodiscard]] std::vector<Index> sprung_coordinates() const;

  /// Returns the velocity components whose initial position the user prescribed: InitialiseOptions::fixed.
  [[nodiscard]] std::vector<Index> given_coordinates() const;

  /// Returns the velocity components whose initial value the user prescribed: InitialiseOptions::fixed_rates.
  [[nodiscard]] std::vector<Index> given_rates() const;

  /// Returns the velocity components that deform elastic bodies: InitialiseOptions::stiff.
  [[nodiscard]] std::vector<Index> elastic_coordinates() const;

  /// Returns the velocity components that deform elastic bodies and move no frame.
  [[nodiscard]] std::vector<Index> internal_coordinates() const;

  /// Returns the observation of `state`. Two-body forces are those of the last accepted step, which must have ended in
  /// `state`.
  [[nodiscard]] Observation observe(const solver::State& state);

  /// Computes the energies and forces at `state`.
  /// @param is_trial  true: `state` is the end of a step that is not yet accepted, at which the equations were
  /// assembled last; false: the last accepted step ended in `state`
  void view_energy(const solver::State& state, bool is_trial, EnergyView& view);

  /// Returns the work over the step between two views; the step has not been accepted yet (theory manual,
  /// integrator.30).
  [[nodiscard]] WorkBetween work_between(const EnergyView& from, const EnergyView& to);

  /// Returns the parts with the largest changes of energy between two views.
  [[nodiscard]] LargestEnergyChanges largest_energy_changes(const EnergyView& from, const EnergyView& to) const;

  /// Returns the initial values prescribed by the user from which `start` differs by more than round-off, in order of
  /// declaration.
  [[nodiscard]] std::vector<ChangedStart> changed_values(const solver::State& start);

  /// Returns the motion of one frame.
  [[nodiscard]] FrameMotion frame_motion(const solver::State& state, FrameId frame);

  /// Returns the relative motion of a two-body force at `state`, with dt = 0.
  [[nodiscard]] RelativeMotion relative_motion(const solver::State& state, ForceId force);

  /// Returns the velocities with which the bodies move at given twists, each at ground's origin in ground's axes; those
  /// that move no body are zero. Joints that do not permit the motion take the nearest one.
  /// @param q       configuration
  /// @param twists  shape (6, bodies), ground included
  /// @param misfit  unless null, the largest difference left over the largest twist
  [[nodiscard]] Eigen::VectorXd velocities_of(const Eigen::VectorXd& q,
                                              const Eigen::Matrix<double, 6, Eigen::Dynamic>& twists,
                                              double* misfit = nullptr);

  /// Returns the velocity components between each body and the next one towards ground, from ground outwards.
  [[nodiscard]] std::vector<std::vector<Index>> chains() const;

  /// Returns the first of each three velocity components of a rotation in space, which belong to the axes that rotate.
  [[nodiscard]] std::vector<Index> rotations_in_space() const;

  /// Returns the specification of the mechanism.
  [[nodiscard]] const MechanismSpec& spec() const;

  /// Returns computing times since construction.
  [[nodiscard]] const MechanismTiming& timing() const;

  /// Returns the closing joints with redundant constraints, in order of declaration.
  [[nodiscard]] const std::vector<Redundancy>& redundancies() const;

  /// Returns the joints that close a loop, in order of declaration.
  [[nodiscard]] std::vector<JointId> closing_joints() const;

 private:
  std::unique_ptr<MechanismParts> parts_;
};

}  // namespace hersey::mbd
