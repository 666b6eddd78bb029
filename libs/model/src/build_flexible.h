#pragma once

#include "hersey/model/build.h"

namespace hersey::model {

/// Assembles and reduces the mesh of a flexible body.
/// @param surfaces  of bearings that lie on it: it gets their film modes
/// @param is_let_go whether its nodes start undeformed, not as forces hold them
/// @param kept      receives what it keeps of each
/// @throws InputError at the body's line: folded elements, frames that share nodes, parts that nothing holds, a mesh
/// that
///         does not fit into memory.
[[nodiscard]] BuiltFlexible build_flexible(const Body& body, const std::vector<const DeformingSurface*>& surfaces,
                                           bool is_let_go, std::vector<BuiltSurface>& kept);

}  // namespace hersey::model
