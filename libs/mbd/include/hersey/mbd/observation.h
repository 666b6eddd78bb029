#pragma once

#include <string>
#include <vector>

#include "hersey/mbd/elastic_body.h"
#include "hersey/mbd/mechanism_spec.h"

/// Observations of a mechanism.
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

/// Coordinates of a joint and its reactions.
struct JointObservation {
  JointValues position;  ///< values as in coordinates_of; angles of a closing joint lie in (-pi, pi]
  JointValues rate;
  Vector3 force = Vector3::Zero();  ///< force of the inboard on the outboard body, in the inboard frame's axes [N]
  Vector3 torque =
      Vector3::Zero();  ///< torque likewise, about the inboard frame's origin [N m]; drives and springs excluded
};

/// Redundant constraints of a joint that closes a loop: in all configurations they follow from the rest of the
/// mechanism. They are omitted from the equations; reactions that are then not determined are those of smallest norm.
struct Redundancy {
  JointId joint;              ///< the closing joint
  std::vector<JointId> loop;  ///< the joints of its loop, itself last
  int positions = 0;          ///< number of omitted constraints on positions
  int orientations = 0;       ///< number of omitted constraints on orientations
};

/// Initial value of a joint that had to differ from the prescribed one.
struct ChangedStart {
  JointId joint;
  Coordinate coordinate;
  bool is_rate = false;
  std::vector<double> given, found;  ///< SI
  double share = 0;  ///< change [rad or relative to the mechanism's size]; for a rate relative to the largest rate
};

/// Observation of an elastic body.
struct ElasticObservation {
  ElasticEnergy energy;
  std::vector<Vector6> wrenches;  ///< wrench of the mechanism on each frame, at the frame, in its axes [N m; N]
  ElasticMotion motion;
};

/// Observation of a mechanism at one state. Indices are those of the ids.
struct Observation {
  double t = 0;
  std::vector<FrameMotion> bodies;  ///< motion of each body's own frame
  std::vector<JointObservation> joints;
  std::vector<double> drive_efforts;             ///< force or torque each drive exerts on its coordinate [N; N m]
  std::vector<double> drive_powers;              ///< [W], > 0 puts energy in
  std::vector<double> coupling_efforts;          ///< force or torque each coupling exerts on its output [N; N m]
  std::vector<double> load_powers;               ///< [W]
  std::vector<double> coordinate_force_efforts;  ///< [N; N m]
  std::vector<double> coordinate_force_powers;   ///< [W]
  std::vector<double> spring_powers;             ///< [W], stored and dissipated together
  std::vector<Vector6> force_wrenches;  ///< wrench of each two-body force on b, at a's origin, a's axes [N m; N]
  std::vector<double> force_powers;     ///< powers of wrenches and of forces on shapes [W]
  std::vector<ElasticObservation> elastics;
  double kinetic_energy = 0;    ///< [J], elastic bodies included
  double potential_energy = 0;  ///< potential energy of gravity, zero at ground's origin [J]
  double spring_energy = 0;     ///< stored in springs on coordinates and in two-body forces [J]
  double damper_power = 0;      ///< lost in dampers on coordinates and in two-body forces, TwoBodyForce::lost_power [W]
  double constraint_drift = 0;  ///< largest violation, redundant rows included, relative to size or radian
};

/// Computing time since construction of the mechanism, `observe` excluded [s].
struct MechanismTiming {
  double total = 0;             ///< time of the equations: assembling them, beginning and accepting steps
  double forces = 0;            ///< part of `total` until all two-body forces are known, with costly ones in parallel
  std::vector<double> force;    ///< time of each two-body force in its own thread
  std::vector<double> elastic;  ///< part of `total` in each elastic body
};

}  // namespace hersey::mbd
