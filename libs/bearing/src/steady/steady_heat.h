#pragma once

#include "hersey/bearing/steady_bearing.h"

namespace hersey::bearing {

/// A steady bearing with the temperatures of its film: both alternately until temperatures, and the clearance with
/// those of its walls, stay (thermal.16). Needs options.thermal. @see solve_steady
[[nodiscard]] SteadySummary solve_with_heat(const film::FilmModel& model, const OperatingPoint& point,
                                            const SteadyOptions& options, SteadyState& state);

}  // namespace hersey::bearing
