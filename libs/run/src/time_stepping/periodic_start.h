#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "hersey/bearing/film_force.h"
#include "hersey/core/archive.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/solver/equations.h"
#include "time_stepping/motion.h"

namespace hersey::run {

/// Start of a run in a periodic motion that has been found before it (lead_in()), in place of that of its model.
struct PeriodicStart {
  int cycles = 0;                           ///< by which it was found; 0: there is none
  bool was_stopped = false;                 ///< on request: a run that goes on later has to begin with it anew
  std::string message;                      ///< how it was found, or why not; empty where nobody asked for it
  solver::State state;                      ///< at the end of a cycle, less whole revolutions
  std::vector<bearing::FilmAtStart> films;  ///< of each bearing
  Archive::Content network;                 ///< temperatures of the thermal network
  std::optional<Motion> motion;             ///< on the grids of the run: all of it, in place of the three before
  double period = 0;                        ///< that was found [s]; 0: the model gives it
  std::vector<std::complex<double>> multipliers = {};  ///< of the motion (FloquetMultipliers), where it asks for them
};

/// Gives a model the period that was found, in as many steps. @param period  [s]; 0: none was
void take_period(model::Model& model, double period);

/// Moves a machine into that motion (theory manual, integrator.43): pressures, accelerations and multipliers follow
/// from its positions, velocities, fill fractions and temperatures at state.t. Where no state of the machine is there
/// it starts as its model says.
/// @param machine, state  as starting_state() leaves them
/// @returns the start that was made, cycles and message: start.cycles is 0 and the message gives the reason if it
/// failed
[[nodiscard]] PeriodicStart begin_in(PeriodicStart start, const model::Model& model, model::Machine& machine,
                                     solver::State& state);

}  // namespace hersey::run
