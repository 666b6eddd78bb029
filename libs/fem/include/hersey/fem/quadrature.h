#pragma once

#include <vector>

#include "hersey/core/spatial.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

struct QuadraturePoint {
  Vector3 xi;  ///< natural coordinates; a face uses the first two
  double weight =
      0;  ///< sum over a rule: the natural element's volume (1/6 tetrahedron, 1 wedge, 8 hexahedron, 4/3 pyramid)
};

/// Selects the integration points of the stiffness.
enum class Integration {
  full,    ///< tet10 4, wedge15 9, hex20 27 points: as CalculiX's C3D10, C3D15, C3D20
  reduced  ///< hex20 with 8 points (C3D20R): softer, a single element has six modes without energy; others as full
};

/// Returns the integration points of the stiffness.
[[nodiscard]] const std::vector<QuadraturePoint>& stiffness_points(ElementType type,
                                                                   Integration rule = Integration::full);

/// Returns the integration points of the mass: exact for N_a N_b on straight elements, with more points than nodes
/// where the mass matrix would otherwise not be positive definite.
[[nodiscard]] const std::vector<QuadraturePoint>& mass_points(ElementType type);

/// Returns the integration points of a face with 3, 4, 6 or 8 nodes.
[[nodiscard]] const std::vector<QuadraturePoint>& face_points(int nodes);

}  // namespace hersey::fem
