#pragma once

#include <optional>
#include <vector>

#include "hersey/core/spatial.h"

namespace hersey::fem {

/// A cylinder without ends.
struct CylinderFit {
  Vector3 point = Vector3::Zero();  ///< on the axis, where the fitted points' mean is nearest [m]
  Vector3 axis = Vector3::UnitZ();  ///< unit vector
  double radius = 0;                ///< [m]

  /// Returns the vector from the axis to a point, perpendicular to the axis [m].
  [[nodiscard]] Vector3 from_axis(const Vector3& x) const {
    const Vector3 r = x - point;
    return r - axis.dot(r) * axis;
  }
  /// Returns the distance of a point from the cylinder, positive outside [m].
  [[nodiscard]] double deviation(const Vector3& x) const { return from_axis(x).norm() - radius; }
};

/// Fits a cylinder with the least sum of squares of the points' distances from it, by Gauss and Newton from the circle
/// that fits best along `axis`. Nothing is returned where the points are fewer than six or lie on no cylinder: the
/// iteration does not converge, or the radius exceeds `largest_radius` [m].
/// @verified_by surface_detection_test.cpp
[[nodiscard]] std::optional<CylinderFit> fit_cylinder(const std::vector<Vector3>& points, const Vector3& axis,
                                                      double largest_radius);

}  // namespace hersey::fem
