#pragma once

#include <functional>
#include <string>

namespace hersey::fem {

/// Returns the content of a file that a mesh file includes, by the name with which it is included.
/// @throws std::runtime_error that says what was found instead: "no readable file"
using IncludeLoader = std::function<std::string(const std::string& name)>;

}  // namespace hersey::fem
