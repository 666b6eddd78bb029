#pragma once

#include <string>

#include "hersey/run/summary.h"

namespace hersey::run {

/// Returns a summary in the format of `hersey run --json`: all values in SI, null for values that were not requested;
/// without the bearings' extremes, which are rows of the summary table.
/// @verified_by tests/cli
[[nodiscard]] std::string summary_json(const Summary& summary);

}  // namespace hersey::run
