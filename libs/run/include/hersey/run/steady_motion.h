#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hersey/bearing/film_observation.h"
#include "hersey/core/outcome.h"
#include "hersey/film/film_observables.h"
#include "hersey/film/thermal_network.h"
#include "hersey/mbd/observation.h"
#include "hersey/model/model.h"
#include "hersey/solver/linearise.h"

namespace hersey::run {

/// A machine in steady motion and small motions about it: what `analysis: steady` finds, in memory.
struct [[nodiscard]] SteadyMotion : Outcome {
  int iterations = 0;
  std::vector<bearing::BearingObservation> bearings;  ///< in the order of the model, as all that follow
  std::vector<film::FilmFields> fields;               ///< of each bearing's film
  std::vector<mbd::JointObservation> joints;
  std::optional<film::NetworkObservables> network;  ///< of the thermal network; unset: there is none
  solver::Linearisation small_motions;
  std::vector<std::string> coordinates;  ///< name of each velocity component, "joint turning, x"
};

/// Finds the steady motion of `model`, whose drives keep their speeds.
/// @param released  names of coordinates that drives prescribe and whose small motions are free nevertheless
/// @param max_iterations  of Newton's method, after which the search is given up
/// @throws InputError if the model cannot start
[[nodiscard]] SteadyMotion find_steady_motion(const model::Model& model, const std::vector<std::string>& released = {},
                                              int max_iterations = 500);

}  // namespace hersey::run
