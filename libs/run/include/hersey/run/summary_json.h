#pragma once

#include <string>

#include "hersey/run/summary.h"

namespace hersey::run {

/// A summary as `hersey run --json` tells it: all in SI, null for what was not asked for; without the bearings'
/// extremes, which are rows of the closing table.
/// @verified_by tests/cli
[[nodiscard]] std::string summary_json(const Summary& summary);

}  // namespace hersey::run
