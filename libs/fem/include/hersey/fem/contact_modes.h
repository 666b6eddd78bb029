#pragma once

#include <vector>

#include "hersey/fem/film_modes.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Static answers of a body to forces along the normals of faces at their nodes, the most compliant ones first: as
/// film_modes, with a function for each node and G its share of the area.
/// @param stiffness  factorised, its frames held
/// @cost one solution per node of the faces and one per mode
/// @verified_by contact_modes_test.cpp
[[nodiscard]] FilmModes contact_modes(const ConstrainedStiffness& stiffness, const Mesh& mesh,
                                      const std::vector<ElementFace>& faces, int most, double tolerance);

}  // namespace hersey::fem
