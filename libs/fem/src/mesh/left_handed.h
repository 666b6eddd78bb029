#pragma once

#include "mesh/raw_mesh.h"

namespace hersey::fem {

/// Renumbers solids whose corners are all left-handed, which Nastran takes as well as right-handed ones, so that they
/// have a volume. Elements that are neither stay as they are, and are told by their quality.
void mirror_left_handed(RawMesh& raw);

}  // namespace hersey::fem
