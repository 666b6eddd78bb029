#pragma once

#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/solver/equations.h"

namespace hersey::run {

/// The consistent state a run starts from: positions that close every loop, velocities, accelerations and multipliers
/// that fit, films filled.
/// @throws InputError, pointing into the model file, where there is none: a table that does not cover the run,
/// redundant
///         or missing constraints, a loop that cannot be closed, a journal that touches its shell.
[[nodiscard]] solver::State starting_state(const model::Model& model, model::Machine& machine);

}  // namespace hersey::run
