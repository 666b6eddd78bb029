#pragma once

#include <vector>

#include "hersey/fem/surface_detection.h"

namespace hersey::fem {

/// Names surfaces by kind and position: `bore_d45_at_0_140_0`, `plane_z_max`, in millimetres to 0.01. A surface of the
/// mesh with the same faces gives its name instead.
/// @param lower, upper  corners of the mesh's box [m]
void name_surfaces(const Mesh& mesh, const Vector3& lower, const Vector3& upper, std::vector<FoundSurface>& found);

}  // namespace hersey::fem
