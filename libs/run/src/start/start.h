#pragma once

#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/solver/equations.h"

namespace hersey::run {

/// Returns the consistent state from which a run starts: positions that close every loop, compatible velocities,
/// accelerations and multipliers, and films filled.
/// @throws InputError with the location in the model file if there is none: a table that does not cover the run,
///         redundant or missing constraints, a loop that cannot be closed, a journal that touches its shell.
[[nodiscard]] solver::State starting_state(const model::Model& model, model::Machine& machine);

}  // namespace hersey::run
