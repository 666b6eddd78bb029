#pragma once

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "hersey/core/spatial.h"

namespace hersey::mbd {

// Shapes of bodies in the body's frame [m], for pictures and contact.

struct Sphere {
  Vector3 centre = Vector3::Zero();
  double radius = 0;  ///< > 0
};

/// Solid, with flat ends.
struct Cylinder {
  Vector3 from = Vector3::Zero(), to = Vector3::UnitZ();  ///< centres of both ends, apart
  double radius = 0;                                      ///< > 0
};

/// All points no further than `radius` from a straight line.
struct Capsule {
  Vector3 from = Vector3::Zero(), to = Vector3::UnitZ();  ///< ends of the line, apart
  double radius = 0;                                      ///< > 0
};

struct Box {
  Pose X_BS;                       ///< pose of its centre and axes
  Vector3 size = Vector3::Zero();  ///< whole edges, > 0
};

/// All points on the side of a plane opposite to its normal.
struct HalfSpace {
  Vector3 point = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();  ///< unit vector
};

/// Triangulated surface, closed or open; seen along the normal of a triangle, its corners are ordered clockwise.
struct TriangleMesh {
  std::vector<Vector3> corners;
  std::vector<std::array<int, 3>> triangles;  ///< indices of corners
};

using ShapeGeometry = std::variant<Sphere, Cylinder, Capsule, Box, HalfSpace, std::shared_ptr<const TriangleMesh>>;

struct Shape {
  std::string name;
  ShapeGeometry geometry;
};

}  // namespace hersey::mbd
