#pragma once

#include <vector>

#include "hersey/bearing/film_force.h"
#include "hersey/bearing/oil_circuit.h"
#include "hersey/film/thermal_network.h"
#include "hersey/mbd/contact.h"
#include "hersey/mbd/gear_mesh.h"
#include "hersey/mbd/observation.h"
#include "observation/fmu_signals.h"
#include "observation/power_balance.h"

namespace hersey::run {

/// Complete observation of an accepted step: the basis of the summary, the settling test and the results file.
struct StepRecord {
  double dt = 0;
  int newton_iterations = 0;
  double newton_residual = 0;
  double error = 0;                ///< estimated, over the tolerance; 0 with a fixed step
  double step_error = 0;           ///< the same, not over the tolerance; of fixed steps too
  int rejected_steps = 0;          ///< since the start of the run
  double energy_available = 0;     ///< EnergyMonitor::available [J]
  double energy_from_nowhere = 0;  ///< EnergyMonitor::gained [J]
  double constraint_drift = 0;     ///< largest violation of a constraint, relative to the compared quantities
  mbd::Observation mechanism;
  std::vector<mbd::RelativeMotion> journal_motions;  ///< of each bearing
  std::vector<bearing::BearingObservation> bearings;
  std::vector<mbd::ContactObservation> contacts;  ///< in ground's axes
  std::vector<mbd::GearMesh::Load> meshes;        ///< of each gear mesh
  film::NetworkObservables network;               ///< state of the thermal network; empty if there is none
  bearing::CircuitObservation circuit;            ///< empty if there is none
  std::vector<FmuSignals> fmus;                   ///< of each FMU; empty if there are none
  PowerBalance power;
};

}  // namespace hersey::run
