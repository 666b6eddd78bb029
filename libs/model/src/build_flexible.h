#pragma once

#include "hersey/model/build.h"

namespace hersey::model {

/// Assembles and reduces the mesh of a flexible body.
/// @throws InputError at the body's line: folded elements, frames that share nodes, parts that nothing holds, a mesh
/// that
///         does not fit into memory.
[[nodiscard]] BuiltFlexible build_flexible(const Body& body);

}  // namespace hersey::model
