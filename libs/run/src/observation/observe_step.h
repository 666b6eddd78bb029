#pragma once

#include <vector>

#include "hersey/model/build.h"
#include "hersey/solver/equations.h"
#include "observation/power_balance.h"
#include "observation/step_record.h"

namespace hersey::run {

/// Returns the kind of each two-body force of the machine, for the power balance.
[[nodiscard]] std::vector<ForceKind> force_kinds(const model::Machine& machine);

/// Returns the observation of a step in the state at its end: motions, bearings, contacts, powers. The caller adds its
/// length, iterations and error.
[[nodiscard]] StepRecord observe_step(const model::Machine& machine, const solver::State& state,
                                      const std::vector<ForceKind>& kinds);

}  // namespace hersey::run
