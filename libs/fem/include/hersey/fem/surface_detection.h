#pragma once

#include <string>
#include <vector>

#include "hersey/fem/mesh.h"

/// Planes and cylinders of a mesh's outer surface, found from its faces whatever program the mesh comes from
/// (docs/mesh-files.md).
namespace hersey::fem {

struct FoundSurface {
  enum class Kind { plane, cylinder };
  /// What a bearing can be built on it.
  enum class Use { none, bore, journal };

  Kind kind = Kind::plane;
  std::string name;  ///< by its place, or that of the mesh's own surface with the same faces
  std::vector<ElementFace> faces;
  Vector3 centre = Vector3::Zero();   ///< of a plane its faces' centre, of a cylinder the middle of its axis [m]
  Vector3 axis = Vector3::UnitZ();    ///< of a plane its outward normal; of a cylinder with its largest part positive
  double area = 0;                    ///< [m^2]
  double radius = 0;                  ///< of a cylinder [m]
  double width = 0;                   ///< of a cylinder, along its axis [m]
  double arc = 0;                     ///< of a cylinder, what of its turn faces cover somewhere along it [rad]
  double cover = 0;                   ///< share of arc x radius x width that is area: less than 1 by holes and grooves
  double deviation = 0;               ///< of the faces' corners from plane or cylinder, at most [m]
  bool is_internal = false;           ///< the solid lies around the cylinder
  bool runs_into_neighbours = false;  ///< a part of a turn whose sides go on without an edge: a fillet, a slot's end

  /// A bore is internal, of 120 degrees at least, and no fillet; a journal is external, of 300 degrees at least; both
  /// are wider than a tenth of their diameter, a bore no wider than two diameters: that is the hole of a screw.
  [[nodiscard]] Use use() const;
};

/// Cylinders first, bores before others, larger before smaller; then planes, larger before smaller.
///
/// Faces that hang together without an edge of more than 40 degrees are of one cylinder where their corners lie on it
/// to 2e-4 of its radius: a fit, which facets of first order do not disturb. Pieces of one cylinder (two halves, the
/// lands beside a groove no wider than half a land) are one. What faces remain are of planes where their nodes lie on
/// one; faces on the same plane are one surface though they do not touch. Cylinders of less than 60 degrees, cones and
/// other shapes are not told.
/// @verified_by surface_detection_test.cpp
[[nodiscard]] std::vector<FoundSurface> find_surfaces(const Mesh& mesh);

/// Adds each as a surface of the mesh and a node set, unless there is a surface of its name.
void add_surfaces(Mesh& mesh, const std::vector<FoundSurface>& found);

}  // namespace hersey::fem
