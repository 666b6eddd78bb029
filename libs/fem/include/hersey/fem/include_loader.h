#pragma once

#include <functional>
#include <string>

namespace hersey::fem {

/// Content of a file that a mesh file includes, by the name it is included with.
/// @throws std::runtime_error telling what is there instead: "no readable file"
using IncludeLoader = std::function<std::string(const std::string& name)>;

}  // namespace hersey::fem
