#pragma once

#include "hersey/model/model.h"
#include "hersey/run/options.h"
#include "time_stepping/periodic_start.h"

namespace hersey::run {

/// Finds the periodic motion of a machine, if its model asks for it (model::LeadIn), by cycles that are discarded, on
/// half grids or by shooting (theory manual, integrator.42, integrator.44, integrator.47). The cycles of the run decide
/// about convergence as without it, so that a poor lead-in costs cycles and changes no answer beyond their tolerance.
/// One that fails or is stopped has no cycles, and a message.
/// @cost a cycle on half grids about a fifth of what one of the run costs; one of shooting as much as that
[[nodiscard]] PeriodicStart lead_in(const model::Model& model, const Options& options);

}  // namespace hersey::run
