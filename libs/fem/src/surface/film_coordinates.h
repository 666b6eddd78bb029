#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "hersey/fem/film_cylinder.h"
#include "hersey/fem/skin.h"

namespace hersey::fem {

struct CylinderPoint {
  double phi = 0, z = 0, radius = 0;
};

/// A position in cylinder coordinates, from one in the cylinder's axes.
[[nodiscard]] inline CylinderPoint cylinder_point(const Vector3& x) {
  return {std::atan2(x.y(), x.x()), x.z(), std::hypot(x.x(), x.y())};
}

/// Returns `phi` plus full revolutions, as near to `to` as possible.
[[nodiscard]] inline double angle_near(double phi, double to) {
  return to + std::remainder(phi - to, 2 * std::numbers::pi);
}

/// Ranges of cylinder coordinates of a face.
struct CylinderBox {
  double phi_low = std::numeric_limits<double>::infinity(), phi_high = -phi_low;
  double z_low = phi_low, z_high = -phi_low;
  double radius_low = phi_low, radius_high = -phi_low;
};

/// @param to_cylinder pose of the mesh's axes in the cylinder's
[[nodiscard]] inline CylinderBox cylinder_box(const Mesh& mesh, ElementFace face, const Pose& to_cylinder) {
  CylinderBox box;
  double phi_first = 0;
  bool is_first = true;
  for (const int node : nodes_of(mesh, face)) {
    const CylinderPoint point = cylinder_point(to_cylinder * mesh.nodes[static_cast<std::size_t>(node)]);
    if (is_first) phi_first = point.phi;
    is_first = false;
    const double phi = angle_near(point.phi, phi_first);
    box.phi_low = std::min(box.phi_low, phi);
    box.phi_high = std::max(box.phi_high, phi);
    box.z_low = std::min(box.z_low, point.z);
    box.z_high = std::max(box.z_high, point.z);
    box.radius_low = std::min(box.radius_low, point.radius);
    box.radius_high = std::max(box.radius_high, point.radius);
  }
  return box;
}

/// True if a face covers part of the film's width and arc, not only touches its edge.
[[nodiscard]] inline bool reaches_into(const CylinderBox& box, const FilmCylinder& cylinder) {
  constexpr double within = 1 - 1e-6;  // round-off of the mesh file's numbers
  const double edge = cylinder.L / 2 * within;
  if (box.z_low >= edge || box.z_high <= -edge) return false;
  if (!cylinder.arc) return true;
  const double half = cylinder.arc->over / 2, middle = (box.phi_low + box.phi_high) / 2,
               away = std::abs(std::remainder(middle - cylinder.arc->from - half, 2 * std::numbers::pi));
  return away < half * within + (box.phi_high - box.phi_low) / 2;
}

}  // namespace hersey::fem
