#pragma once

#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/solver/equations.h"

namespace hersey::run {

/// Gives gear wheels that stand still, with what rotates with them, the speeds at which they roll on wheels that
/// rotate: no constraint says so, as gear meshes are forces. Wheels that no joint lets rotate stay still.
void roll_wheels(const model::Machine& machine, solver::State& state);

/// @throws InputError if teeth would come towards each other, or part, at more than a hundredth of the speed at which
///         they roll: the mesh would be a shock
void require_rolling_wheels(const model::Model& model, const model::Machine& machine, const solver::State& state);

}  // namespace hersey::run
