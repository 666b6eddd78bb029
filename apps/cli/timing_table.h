#pragma once

#include <string>

#include "hersey/run/summary.h"
#include "hersey/study/bearing_solution.h"

namespace hersey::cli {

/// Where the computing time of a run has gone: its phases, the parts of its steps, its four costliest films and the
/// parts of the costliest. At most 25 lines, whatever the number of films.
/// @param total  from the start of the command to its end [s]
[[nodiscard]] std::string timing_text(const run::Summary& summary, double total);

/// The same of a single bearing: in its film's own solution the parts of the film, the rest for coefficients, other
/// grids and positions.
[[nodiscard]] std::string timing_text(const study::BearingSolution& solution);

/// Largest memory of this process up to now [MB].
[[nodiscard]] double largest_memory();

}  // namespace hersey::cli
