#pragma once

#include <vector>

#include "hersey/fem/film_modes.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Computes the static displacements of a body under forces along the normals of faces at their nodes, the most
/// compliant ones first: as film_modes, with one function per node and the node's share of the area as G.
/// @param stiffness  factorised, its frames fixed
/// @cost one solution per node of the faces and one per mode
/// @verified_by contact_modes_test.cpp
[[nodiscard]] FilmModes contact_modes(const ConstrainedStiffness& stiffness, const Mesh& mesh,
                                      const std::vector<ElementFace>& faces, int most, double tolerance);

}  // namespace hersey::fem
