#pragma once

#include <vector>

#include "surface/detection_cylinder_fit.h"
#include "surface/detection_facets.h"

/// Facets that lie on one plane or cylinder.
namespace hersey::fem {

/// Angle of the normals above which two facets meet in an edge instead of a smooth surface: a circle of nine flat
/// facets is round, a hexagon and an octagon are not.
inline constexpr double kSmoothAngle = 40 * 3.14159265358979323846 / 180;  // [rad]

/// Largest deviation of corners from a cylinder, by its radius: enough for coordinates of five figures.
inline constexpr double kRoundness = 2e-4;

struct CylinderRegion {
  CylinderFit fit;
  std::vector<int> facets;   ///< ascending
  bool is_internal = false;  ///< the solid lies around it
};

/// Finds cylinders among the facets whose entry in `taken` is 0, and sets the entries of their facets. Each region is
/// connected and has an arc of at least 20 degrees. @param size  of the whole mesh: no cylinder has a larger radius [m]
[[nodiscard]] std::vector<CylinderRegion> cylinder_regions(const Mesh& mesh, const SurfaceFacets& surface, double size,
                                                           std::vector<char>& taken);

/// Merges the regions of one cylinder with gaps: two halves, the lands beside a groove. Axes and radii agree to 1e-3 of
/// the radius; along the axis the pieces overlap, or their distance is at most half the width of the narrower one.
[[nodiscard]] std::vector<CylinderRegion> merged_regions(const Mesh& mesh, const SurfaceFacets& surface,
                                                         std::vector<CylinderRegion> regions);

/// Extent of a region on its cylinder.
struct CylinderExtent {
  double low = 0, high = 0;  ///< along the axis from the fit's point [m]
  double arc = 0;            ///< [rad]
  double deviation = 0;      ///< largest deviation of corners [m]
};
[[nodiscard]] CylinderExtent extent_of(const Mesh& mesh, const SurfaceFacets& surface, const CylinderRegion& region);

struct PlaneRegion {
  Vector3 normal = Vector3::UnitZ(), point = Vector3::Zero();
  std::vector<int> facets;  ///< ascending
};

/// Finds planes among the facets whose entry in `taken` is 0, one region for each plane and direction. A strip between
/// smooth edges, of which a cone has many, is no plane.
[[nodiscard]] std::vector<PlaneRegion> plane_regions(const Mesh& mesh, const SurfaceFacets& surface, double size,
                                                     std::vector<char>& taken);

}  // namespace hersey::fem
