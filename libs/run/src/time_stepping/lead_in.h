#pragma once

#include <string>

#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/run/options.h"
#include "hersey/solver/equations.h"

namespace hersey::run {

/// Lead-in of a run: cycles on coarser grids that were discarded.
struct LeadInSummary {
  int cycles = 0;       ///< 0: there was none, or it was given up
  std::string message;  ///< what it was, or why it was given up; empty without one
};

/// Moves a machine that is about to start into the periodic motion of the same machine with films on half grids, if its
/// model asks for it (model::LeadIn): positions less whole revolutions, velocities, fill fractions and temperatures
/// (theory manual, integrator.37). The cycles of the run decide about convergence as without it, so that a poor lead-in
/// costs cycles and changes no answer beyond their tolerance. Where it fails the machine starts as the model says.
/// @param machine, state  as starting_state() leaves them
/// @cost the cycles on the half grids, about a fifth each of what one of the run costs
[[nodiscard]] LeadInSummary lead_in(const model::Model& model, const Options& options, model::Machine& machine,
                                    solver::State& state);

}  // namespace hersey::run
