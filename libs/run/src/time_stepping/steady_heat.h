#pragma once

#include "hersey/model/machine.h"
#include "hersey/solver/equilibrium.h"

namespace hersey::run {

/// Finds the steady motion of a machine as solver::find_equilibrium() does, with the temperatures that its films then
/// have: motion and heat are solved alternately (theory manual, thermal.70). Without films that have temperatures it is
/// that search alone.
[[nodiscard]] solver::EquilibriumSummary find_warm_steady_motion(model::Machine& machine, solver::State& state,
                                                                 const solver::EquilibriumOptions& options);

/// The same for other equations of the machine, such as those of its spinning shafts.
[[nodiscard]] solver::EquilibriumSummary find_warm_steady_motion(solver::Equations& equations, model::Machine& machine,
                                                                 solver::State& state,
                                                                 const solver::EquilibriumOptions& options);

}  // namespace hersey::run
