#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/model/model.h"

namespace hersey::run {

/// Joints with redundant constraints, as assumptions: the number left out and the loop; empty if there are none.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> redundancies(const mbd::Mechanism& mechanism);

/// Warnings about the same joints, with their location in the model file.
[[nodiscard]] std::vector<Fault> redundancy_warnings(const model::Model& model, const mbd::Mechanism& mechanism);

}  // namespace hersey::run
