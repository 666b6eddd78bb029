#pragma once

#include "mesh/raw_mesh.h"

namespace hersey::fem {

/// Renumbers solids whose corners are all left-handed, which Nastran accepts as well as right-handed ones, so that
/// their volume is positive. Elements that are neither are not changed; the check of the mesh's quality reports them.
void mirror_left_handed(RawMesh& raw);

}  // namespace hersey::fem
