#pragma once

#include <vector>

#include "hersey/model/build.h"
#include "hersey/solver/equations.h"
#include "power_balance.h"
#include "recorder.h"

namespace hersey::run {

/// Everything a step shows in the state it ended in: motions, bearings, contacts, powers. How the step was found (its
/// length, iterations, error) is left to the caller.
/// @param kinds  of each two-body force, for the power balance
[[nodiscard]] StepRecord observe_step(const model::Machine& machine, const solver::State& state,
                                      const std::vector<ForceKind>& kinds);

}  // namespace hersey::run
