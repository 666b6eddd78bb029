#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hersey/mbd/mechanism_builder.h"
#include "hersey/solver/equations.h"

namespace hersey::mbd {

/// Motion of a frame relative to ground, in ground's axes.
struct FrameMotion {
  Pose X_WF;
  Vector3 omega = Vector3::Zero();  ///< angular velocity [rad/s]
  Vector3 v = Vector3::Zero();      ///< velocity of the frame's origin [m/s]
  Vector3 alpha = Vector3::Zero();  ///< angular acceleration [rad/s^2]
  Vector3 a = Vector3::Zero();      ///< acceleration of the frame's origin [m/s^2]
};

/// Values of a joint, one for each of its coordinates: none to six.
using JointValues = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 6, 1>;

/// Coordinates of a joint and what it transmits.
struct JointObservation {
  JointValues position;  ///< as in coordinates_of; of a closing joint in (-pi, pi]
  JointValues rate;
  Vector3 force = Vector3::Zero();   ///< of the inboard on the outboard body, in the inboard frame's axes [N]
  Vector3 torque = Vector3::Zero();  ///< the same about the inboard frame's origin [N m]; drives and springs excluded
};

/// Constraints of a joint that closes a loop which follow from the rest of the mechanism wherever it can go. They are
/// left out of the equations; reactions that they leave undetermined are the ones of smallest norm.
struct Redundancy {
  JointId joint;              ///< the closing joint
  std::vector<JointId> loop;  ///< the joints of its loop, itself last
  int positions = 0;          ///< how many of its constraints on positions were left out
  int orientations = 0;       ///< and on orientations
};

/// A value of a joint at the start that could not be the one given.
struct ChangedStart {
  JointId joint;
  Coordinate coordinate;
  bool is_rate = false;
  std::vector<double> given, found;  ///< SI
  double share = 0;  ///< of the change: in rad or of the mechanism's size; of a rate, relative to the largest one
};

/// What an elastic body shows.
struct ElasticObservation {
  ElasticEnergy energy;
  std::vector<Vector6> wrenches;  ///< that the mechanism puts on each frame, at the frame, in its axes [N m; N]
  ElasticMotion motion;
};

/// Everything known about a mechanism at one state. Indices are those of the ids.
struct Observation {
  double t = 0;
  std::vector<FrameMotion> bodies;  ///< of each body's own frame
  std::vector<JointObservation> joints;
  std::vector<double> drive_efforts;             ///< force or torque each drive exerts on its coordinate [N; N m]
  std::vector<double> drive_powers;              ///< [W], > 0 puts energy in
  std::vector<double> coupling_efforts;          ///< force or torque each coupling exerts on its output [N; N m]
  std::vector<double> load_powers;               ///< [W]
  std::vector<double> coordinate_force_efforts;  ///< [N; N m]
  std::vector<double> coordinate_force_powers;   ///< [W]
  std::vector<double> spring_powers;             ///< [W], stored and dissipated together
  std::vector<Vector6> force_wrenches;           ///< of each two-body force on b, at a's origin, a's axes [N m; N]
  std::vector<double> force_powers;              ///< of wrenches and of forces on shapes [W]
  std::vector<ElasticObservation> elastics;
  double kinetic_energy = 0;    ///< [J], of elastic bodies too
  double potential_energy = 0;  ///< of gravity, zero at ground's origin [J]
  double spring_energy = 0;     ///< stored in springs on coordinates and in two-body forces [J]
  double damper_power = 0;      ///< lost in dampers on coordinates and in two-body forces, TwoBodyForce::lost_power [W]
  double constraint_drift = 0;  ///< largest violation, redundant rows included, relative to size or radian
};

/// Computing time since the mechanism was made, looking at it (`observe`) excluded [s].
struct MechanismTiming {
  double total = 0;             ///< of its equations: assembling them, beginning and accepting steps
  double forces = 0;            ///< of that, until all two-body forces are known, costly ones side by side
  std::vector<double> force;    ///< of each of them by itself, in the thread it has
  std::vector<double> elastic;  ///< of the total, in each elastic body
};

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
  void assemble(const solver::State& state, const solver::Stage& stage, Eigen::VectorXd& residual,
                Eigen::VectorXd& scale, SparseMatrix* tangent) override;
  void constraints(const solver::State& state, Eigen::VectorXd& phi, Eigen::VectorXd& scale,
                   SparseMatrix* jacobian) override;
  void constraint_rates(const solver::State& state, Eigen::VectorXd& velocity, Eigen::VectorXd& bias) override;
  [[nodiscard]] Eigen::VectorXd position_scales() const override;
  [[nodiscard]] std::string name_of_row(Index row) const override;
  void begin_step(const solver::State& start, double dt) override;
  [[nodiscard]] bool step_stands() override;
  void accept_step(const solver::State& end) override;
  [[nodiscard]] bool has_condensed_unknowns() const override;
  [[nodiscard]] double internal_residual() const override;
  [[nodiscard]] std::string name_of_internal_residual() const override;
  [[nodiscard]] std::string domain_error() const override;
  [[nodiscard]] bool has_whole_tangent() const override;
  void persist(Archive& archive) override;

  /// The state the joints' initial values describe, at t = 0; not yet consistent: see solver::initialise.
  [[nodiscard]] solver::State initial_state() const;

  /// Velocity components whose initial position the user gave: InitialiseOptions::held.
  [[nodiscard]] std::vector<Index> given_coordinates() const;

  /// Velocity components that the user gave a value at the start: InitialiseOptions::held_rates.
  [[nodiscard]] std::vector<Index> given_rates() const;

  /// Velocity components that deform elastic bodies: InitialiseOptions::stiff.
  [[nodiscard]] std::vector<Index> elastic_coordinates() const;

  /// Those of them that move no frame.
  [[nodiscard]] std::vector<Index> internal_coordinates() const;

  /// Everything about `state`. Two-body forces are those of the last accepted step, which must have ended in `state`.
  [[nodiscard]] Observation observe(const solver::State& state);

  /// What the user gave for the start and `start` does not have, beyond round-off, in order of declaration.
  [[nodiscard]] std::vector<ChangedStart> changed_values(const solver::State& start);

  /// Motion of one frame.
  [[nodiscard]] FrameMotion frame_motion(const solver::State& state, FrameId frame);

  /// What a two-body force sees at `state`, with dt = 0.
  [[nodiscard]] RelativeMotion relative_motion(const solver::State& state, ForceId force);

  /// What it was built from.
  [[nodiscard]] const MechanismSpec& spec() const;

  /// Since it was made.
  [[nodiscard]] const MechanismTiming& timing() const;

  /// Closing joints some of whose constraints are redundant, in order of declaration.
  [[nodiscard]] const std::vector<Redundancy>& redundancies() const;

  /// Joints that close a loop, in order of declaration.
  [[nodiscard]] std::vector<JointId> closing_joints() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> impl_;
};

}  // namespace hersey::mbd
