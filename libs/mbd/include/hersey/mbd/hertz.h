#pragma once

#include <array>
#include <optional>

#include "hersey/mbd/shape.h"

namespace hersey::mbd {

/// Relative radii of curvature of two shapes where they touch in a point, the larger first (theory manual eq.
/// (contact.9)): 1/R = 1/R_a + 1/R_b in both principal directions. Boxes, half-spaces and meshes count as flat,
/// cylinders touch with their side, and a capsule on a half-space with its round ends.
/// @returns nothing if they touch along a line or an area (a cylinder or box on a plane), in a direction that
/// changes (two capsules), or where both are flat: there is no Hertz stiffness then.
[[nodiscard]] std::optional<std::array<double, 2>> relative_radii(const ShapeGeometry& a, const ShapeGeometry& b);

/// Hertz: N = k delta^(3/2). For R' = R'' this is k = 4/3 E* sqrt(R); otherwise the contact is an ellipse whose shape
/// follows from the radii's ratio (theory manual eqs. (contact.10), (contact.11)).
/// @param composite_modulus  E* [Pa], fem::composite_modulus
/// @param radii              relative radii, larger first [m], > 0
/// @returns k [N/m^1.5]
/// @see Johnson (1985), Contact Mechanics, Eqs. 4.25 to 4.27.
/// @verified_by hertz_test.cpp
[[nodiscard]] double hertz_stiffness(double composite_modulus, const std::array<double, 2>& radii);

}  // namespace hersey::mbd
