#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "hersey/core/archive.h"
#include "hersey/core/spatial.h"

/// What a judge of a step's energy sees of a mechanism (theory manual, integrator.29): what is stored, each part by
/// itself, and what acts. Much less than an Observation, and known before a step is accepted.
namespace hersey::mbd {

/// A two-body force at one state.
struct ForceView {
  double stored = 0;  ///< TwoBodyForce::stored_energy [J]
  double lost = 0;    ///< TwoBodyForce::lost_power [W]
  Vector6 W = Vector6::Zero();
  Pose X_AB;
  Eigen::VectorXd s, Q;  ///< amplitudes of shapes, and the forces on them
};

/// One state of a mechanism. Indices are those of the ids.
struct EnergyView {
  double t = 0;
  Eigen::VectorXd q, v;
  std::vector<double> kinetic;    ///< of each link of the tree, ground's included [J]
  double potential = 0;           ///< of gravity [J]
  std::vector<double> springs;    ///< on coordinates [J]
  std::vector<double> functions;  ///< CoordinateForce::stored_energy [J]
  std::vector<ForceView> forces;
  std::vector<double> strain, elastic_kinetic;    ///< of elastic bodies [J]
  std::vector<double> pressures;                  ///< power of all loads on each elastic body's mesh [W]
  std::vector<double> drive_efforts;              ///< [N; N m]
  std::vector<double> coordinate_efforts;         ///< of coordinate forces [N; N m]
  std::vector<Eigen::VectorXd> load_generalised;  ///< what each load does on the columns of its path

  /// What the next step is judged by, as it is.
  void persist(Archive& archive);
};

/// Work done over a step [J], and how far it may be from what the forces did between the step's ends.
struct StepWork {
  double value = 0;
  double doubt = 0;
};

/// What acted between two states that one step joins (theory manual, integrator.30). Positive: energy put in.
struct WorkBetween {
  std::vector<StepWork> drives, loads, functions, pressures;
  std::vector<StepWork> forces;  ///< of two-body forces, as work of their mean wrench
  std::vector<double> lost;      ///< in dampers of two-body forces: the least that it can have been [J]
  double lost_in_springs = 0;    ///< in dampers on coordinates [J]
};

/// The parts that have gained or released most.
struct LargestEnergyChanges {
  std::string body;   ///< whose kinetic and strain energy has grown most
  std::string force;  ///< the spring, contact or load that has given most, empty where none has
};

}  // namespace hersey::mbd
