#pragma once

#include <functional>

#include "hersey/bearing/steady_bearing.h"

namespace hersey::bearing {

/// A bearing solved at a position and velocity beside one that is known, film and heat together.
using SolveBeside = std::function<SteadySummary(const OperatingPoint&, SteadyState&)>;

/// Stiffness and damping of a bearing whose temperatures follow its motion (theory manual, thermal.32, thermal.33; what
/// they are in the limit: thermal.34): by differences of films solved with their heat on either side of `state`, in all
/// eight directions. Where one of them is not found its summary says why, and `total` is left alone.
/// @pre surfaces that are rigid
[[nodiscard]] SteadySummary find_total_coefficients(const film::FilmModel& model, const SteadyState& state,
                                                    const SolveBeside& solve, DynamicCoefficients& total);

}  // namespace hersey::bearing
