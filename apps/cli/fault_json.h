#pragma once

#include <nlohmann/json.hpp>

#include "hersey/core/input_error.h"

namespace hersey::cli {

/// A fault or a warning as commands print it with --json.
[[nodiscard]] nlohmann::json fault_json(const Fault& fault);

}  // namespace hersey::cli
