#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "hersey/core/archive.h"
#include "hersey/core/spatial.h"

/// Energies and forces of a mechanism for the monitor of the energy of steps (theory manual, integrator.29): the energy
/// stored in each part, and the forces that act. It is much less than an Observation, and known before a step is
/// accepted.
namespace hersey::mbd {

/// A two-body force at one state.
struct ForceView {
  double stored = 0;  ///< TwoBodyForce::stored_energy [J]
  double lost = 0;    ///< TwoBodyForce::lost_power [W]
  Vector6 W = Vector6::Zero();
  Pose X_AB;
  Eigen::VectorXd s, Q;  ///< amplitudes of shapes, and the forces on them
};

/// Energies and forces at one state of a mechanism. Indices are those of the ids.
struct EnergyView {
  double t = 0;
  Eigen::VectorXd q, v;
  std::vector<double> kinetic;    ///< kinetic energy of each link of the tree, including ground [J]
  double potential = 0;           ///< potential energy of gravity [J]
  std::vector<double> springs;    ///< energy of springs on coordinates [J]
  std::vector<double> functions;  ///< CoordinateForce::stored_energy [J]
  std::vector<ForceView> forces;
  std::vector<double> strain, elastic_kinetic;    ///< strain and kinetic energies of elastic bodies [J]
  std::vector<double> pressures;                  ///< power of all loads on each elastic body's mesh [W]
  std::vector<double> drive_efforts;              ///< [N; N m]
  std::vector<double> coordinate_efforts;         ///< efforts of coordinate forces [N; N m]
  std::vector<Eigen::VectorXd> load_generalised;  ///< generalised forces of each load on the columns of its path

  /// Saves or restores the view, with which the next step is compared.
  void persist(Archive& archive);
};

/// Work done over a step and the uncertainty of its numerical integration [J].
struct StepWork {
  double value = 0;
  double uncertainty = 0;
};

/// Work of all forces over one step (theory manual, integrator.30). Positive work increases the energy of the
/// mechanism.
struct WorkBetween {
  std::vector<StepWork> drives, loads, functions, pressures;
  std::vector<StepWork> forces;  ///< work of the mean wrench of each two-body force
  std::vector<double> lost;      ///< lower bound of the energy dissipated by dampers of each two-body force [J]
  double lost_in_springs = 0;    ///< energy dissipated by dampers on coordinates [J]
};

/// Names of the parts with the largest gain and release of energy.
struct LargestEnergyChanges {
  std::string body;   ///< body whose kinetic and strain energy has increased most
  std::string force;  ///< spring, contact or load that has released most energy; empty if there is none
};

}  // namespace hersey::mbd
