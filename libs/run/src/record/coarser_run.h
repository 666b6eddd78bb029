#pragma once

#include "hersey/model/model.h"
#include "hersey/run/summary.h"

namespace hersey::run {

/// The model with steps twice as long: of a controlled error the tolerance that gives them.
[[nodiscard]] model::Model with_longer_steps(model::Model model);

/// Returns the errors that the steps cause in the figures of one bearing, theory manual eq. (integrator.17).
/// @param coarse  summary of the same bearing, in a run with steps twice as long
[[nodiscard]] StepErrors step_errors(const BearingSummary& fine, const BearingSummary& coarse);

}  // namespace hersey::run
