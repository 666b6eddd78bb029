#pragma once

#include <vector>

#include "elastic/elastic_assembly.h"
#include "tree/assembly.h"

namespace hersey::mbd {

/// Adds the derivatives of a two-body force that depends on the deformation of its bodies to the tangent: the wrench by
/// amplitudes, the forces on shapes by everything (theory manual eq. (flexible-bodies.27)). The forces on shapes
/// themselves enter the residual through the bodies.
/// @param surfaces  of A's body, then of B's, as far as they deform
void add_surface_tangent(Assembly& assembly, const Pair& pair, const std::vector<const ShapeColumns*>& surfaces,
                         const ForceResponse& response);

}  // namespace hersey::mbd
