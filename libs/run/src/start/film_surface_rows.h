#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hersey/model/build.h"

namespace hersey::run {

/// Describes, as assumptions, the surfaces of bearings that deform with their bodies: the number of functions and
/// shapes, and what these leave out; empty if all are rigid.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> film_surface_rows(const model::Model& model,
                                                                                 const model::Machine& machine);

}  // namespace hersey::run
