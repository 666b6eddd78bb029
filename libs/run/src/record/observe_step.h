#pragma once

#include <vector>

#include "hersey/model/build.h"
#include "hersey/solver/equations.h"
#include "record/power_balance.h"
#include "record/step_record.h"

namespace hersey::run {

/// What each two-body force of the machine is, for the power balance.
[[nodiscard]] std::vector<ForceKind> force_kinds(const model::Machine& machine);

/// Everything a step shows in the state it ended in: motions, bearings, contacts, powers. How the step was found (its
/// length, iterations, error) is left to the caller.
[[nodiscard]] StepRecord observe_step(const model::Machine& machine, const solver::State& state,
                                      const std::vector<ForceKind>& kinds);

}  // namespace hersey::run
