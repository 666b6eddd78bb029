#pragma once

#include <vector>

#include "surface/detection_cylinder_fit.h"
#include "surface/detection_facets.h"

/// Facets that lie on one plane or cylinder.
namespace hersey::fem {

/// Facets meet in an edge, no longer on one smooth surface, where their normals differ by more: a circle of nine flat
/// facets is round, a hexagon and an octagon are not.
inline constexpr double kSmoothAngle = 40 * 3.14159265358979323846 / 180;  // [rad]

/// How far corners may lie off a cylinder, by its radius: coordinates of five figures do.
inline constexpr double kRoundness = 2e-4;

struct CylinderRegion {
  CylinderFit fit;
  std::vector<int> facets;   ///< ascending
  bool is_internal = false;  ///< the solid lies around it
};

/// Of the facets whose entry in `taken` is 0, those on cylinders; sets their entries. Each region hangs together, and
/// has 20 degrees of its turn at least. @param size  of the whole mesh: no cylinder has a larger radius [m]
[[nodiscard]] std::vector<CylinderRegion> cylinder_regions(const Mesh& mesh, const SurfaceFacets& surface, double size,
                                                           std::vector<char>& taken);

/// Puts together what is one cylinder with gaps: two halves, the lands beside a groove. Axes and radii agree to
/// 1e-3 of the radius; along the axis pieces overlap, or are no farther apart than half the narrower one is wide.
[[nodiscard]] std::vector<CylinderRegion> merged_regions(const Mesh& mesh, const SurfaceFacets& surface,
                                                         std::vector<CylinderRegion> regions);

/// What a region takes of its cylinder.
struct CylinderExtent {
  double low = 0, high = 0;  ///< along the axis from the fit's point [m]
  double arc = 0;            ///< [rad]
  double deviation = 0;      ///< of corners, at most [m]
};
[[nodiscard]] CylinderExtent extent_of(const Mesh& mesh, const SurfaceFacets& surface, const CylinderRegion& region);

struct PlaneRegion {
  Vector3 normal = Vector3::UnitZ(), point = Vector3::Zero();
  std::vector<int> facets;  ///< ascending
};

/// Of the facets whose entry in `taken` is 0, those on planes, one region for each plane and direction. A strip between
/// smooth edges, as a cone has many, is none.
[[nodiscard]] std::vector<PlaneRegion> plane_regions(const Mesh& mesh, const SurfaceFacets& surface, double size,
                                                     std::vector<char>& taken);

}  // namespace hersey::fem
