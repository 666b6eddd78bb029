#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hersey/model/build.h"

namespace hersey::run {

/// Surfaces of bearings that deform with their bodies, as assumptions: by how many functions and shapes, and what these
/// leave out; empty where all are rigid.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> film_surface_rows(const model::Model& model,
                                                                                 const model::Machine& machine);

}  // namespace hersey::run
