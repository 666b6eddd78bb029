#pragma once

#include "hersey/fem/element_point.h"
#include "hersey/fem/quadrature.h"
#include "hersey/fem/solid_material.h"

namespace hersey::fem {

/// Returns the smallest det dx/dxi at the points of integration of stiffness and mass; where it is not positive the
/// element is folded or its nodes are numbered inside out. A slightly folded corner does no harm: one of the patch
/// test's bricks has one.
[[nodiscard]] double smallest_jacobian(ElementType type, const NodeColumns& x);

/// Returns the stiffness (3 nodes, 3 nodes) [N/m] of an element with nodes at `x`, (elastic.5). hex8 has nine
/// incompatible modes that are condensed out, (elastic.7), because it would otherwise lock in bending.
/// @pre smallest_jacobian(type, x) > 0 @see Taylor, Beresford, Wilson (1976), IJNME 10, 1211
/// @verified_by solid_element_test.cpp
[[nodiscard]] ElementMatrix element_stiffness(ElementType type, const NodeColumns& x, const SolidMaterial& material,
                                              Integration rule = Integration::full);

/// Returns the consistent mass per density (nodes, nodes) [m^3], (elastic.6), the same for all three directions.
[[nodiscard]] ElementMatrix element_mass(ElementType type, const NodeColumns& x);

/// Returns the strain (6, points) at `points`, for displacements `u` of the nodes; for hex8 with its incompatible
/// modes.
[[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> element_strain(ElementType type, const NodeColumns& x,
                                                                      const SolidMaterial& material,
                                                                      const NodeColumns& u,
                                                                      const std::vector<Vector3>& points);

}  // namespace hersey::fem
