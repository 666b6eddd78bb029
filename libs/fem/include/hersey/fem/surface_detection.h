#pragma once

#include <string>
#include <vector>

#include "hersey/fem/mesh.h"

/// Detection of planes and cylinders on a mesh's outer surface from its faces, independent of the program that made the
/// mesh (docs/mesh-files.md).
namespace hersey::fem {

struct FoundSurface {
  enum class Kind { plane, cylinder };
  /// Use of the surface in a bearing.
  enum class Use { none, bore, journal };

  Kind kind = Kind::plane;
  std::string name;  ///< name made from kind and position, or that of the mesh's own surface with the same faces
  std::vector<ElementFace> faces;
  Vector3 centre = Vector3::Zero();  ///< centre of a plane's faces, or middle of a cylinder's axis [m]
  Vector3 axis =
      Vector3::UnitZ();      ///< outward normal of a plane, or axis of a cylinder with its largest component positive
  double area = 0;           ///< [m^2]
  double radius = 0;         ///< radius of a cylinder [m]
  double width = 0;          ///< width of a cylinder along its axis [m]
  double arc = 0;            ///< angle of a cylinder that faces cover somewhere along the axis [rad]
  double cover = 0;          ///< area over arc x radius x width: less than 1 by holes and grooves
  double deviation = 0;      ///< largest deviation of the faces' corners from plane or cylinder [m]
  bool is_internal = false;  ///< true: the solid lies around the cylinder
  bool runs_into_neighbours =
      false;  ///< part of a cylinder whose sides continue without an edge: a fillet, a slot's end

  /// Returns the use: a bore is internal, has an arc of at least 120 degrees, and is no fillet; a journal is external,
  /// of at least 300 degrees. Both are wider than a tenth of their diameter. A bore is no wider than two diameters: a
  /// wider one is the hole of a screw.
  [[nodiscard]] Use use() const;
};

/// Detects the surfaces of a mesh: cylinders first, bores before others, larger before smaller; then planes, larger
/// before smaller.
///
/// Connected faces without an edge of more than 40 degrees belong to one cylinder where their corners lie on it to 2e-4
/// of its radius; the cylinder is a least-squares fit, which facets of first order do not disturb. Pieces of one
/// cylinder (two halves, the lands beside a groove no wider than half a land) form one surface. The remaining faces
/// belong to planes where their nodes lie on one; faces on the same plane are one surface even if they do not touch.
/// Cylinders of less than 60 degrees, cones and other shapes are not reported.
/// @verified_by surface_detection_test.cpp
[[nodiscard]] std::vector<FoundSurface> find_surfaces(const Mesh& mesh);

/// Adds each surface to the mesh as a surface and a node set, unless the mesh has a surface of its name.
void add_surfaces(Mesh& mesh, const std::vector<FoundSurface>& found);

}  // namespace hersey::fem
