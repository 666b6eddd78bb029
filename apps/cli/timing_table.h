#pragma once

#include <string>

#include "hersey/run/summary.h"
#include "hersey/study/bearing_solution.h"

namespace hersey::cli {

/// Where the computing time of a run has gone: its phases, the parts of its steps, those of its films, and what made
/// them long. At most 25 lines for up to three films, of which the costliest are shown.
/// @param total  from the start of the command to its end [s]
[[nodiscard]] std::string timing_text(const run::Summary& summary, double total);

/// The same of a single bearing: in its film's own solution the parts of the film, the rest for coefficients, other
/// grids and positions.
[[nodiscard]] std::string timing_text(const study::BearingSolution& solution);

/// Largest memory of this process up to now [MB].
[[nodiscard]] double largest_memory();

}  // namespace hersey::cli
