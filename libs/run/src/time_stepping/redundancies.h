#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/model/model.h"

namespace hersey::run {

/// Joints whose constraints are redundant, as assumptions: how many were left out of which loop; empty where none are.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> redundancies(const mbd::Mechanism& mechanism);

/// The same as warnings that point at the joints.
[[nodiscard]] std::vector<Fault> redundancy_warnings(const model::Model& model, const mbd::Mechanism& mechanism);

}  // namespace hersey::run
