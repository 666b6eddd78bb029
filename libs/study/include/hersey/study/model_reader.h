#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hersey/model/model.h"

namespace hersey::study {

/// Function that returns the model with overrides applied, as model::read does; called from several threads at once.
using ModelReader = std::function<model::Model(const std::vector<std::string>& overrides)>;

}  // namespace hersey::study
