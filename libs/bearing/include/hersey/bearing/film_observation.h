#pragma once

#include <optional>

#include "hersey/bearing/gap_kinematics.h"
#include "hersey/bearing/wear.h"
#include "hersey/core/spatial.h"
#include "hersey/film/film_observables.h"
#include "hersey/film/heat_state.h"

namespace hersey::bearing {

/// Balance of a film's oil over a run: content, flow, and the unexplained rest (theory manual, film.15).
struct CumulativeOilBalance {
  double volume = 0;        ///< in the film [m^3]
  double through_flow = 0;  ///< volume that has passed: the larger of what came in and what left, step by step [m^3]
  double unexplained = 0;   ///< change of the volume since the start less what came in [m^3]
  double step_error = 0;    ///< the last step's part of that [m^3]
};

/// Observation of one bearing at an accepted state.
struct BearingObservation {
  GapPosition position;  ///< of the moving surface
  /// [moment about the bearing's origin; force], bearing frame, the oil's inertia included
  Vector6 wrench_on_shell = Vector6::Zero();
  /// Power of the wrench without inertia, of forces on shapes and of growing walls [W]; negative: the film takes power.
  /// What inertia takes is kinetic energy of the machine.
  double power_into_bodies = 0;
  double power_of_growth = 0;  ///< its part on walls that grow with their temperature [W]
  double clearance = 0;        ///< radial, at the temperatures of the walls [m]
  /// How far walls in bodies have grown outwards by temperature, their means over the nodes [m]; and the clearance with
  /// them (theory manual, thermal.64).
  double bore_growth = 0, journal_growth = 0, clearance_of_bodies = 0;
  film::FilmObservables film;
  std::optional<film::HeatObservables> heat;  ///< of a film with temperatures
  film::WallCorrection walls;                 ///< of fixed walls, when they were last corrected
  CumulativeOilBalance oil;
  std::optional<WearObservation> wear;  ///< of surfaces that wear
  int film_iterations = 0;              ///< film linearisations in the last step
  int exchanges = 0;                    ///< partitioned: wrenches that film and bodies exchanged in the last step
};

}  // namespace hersey::bearing
