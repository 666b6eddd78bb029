#include <algorithm>
#include <cmath>
#include <numbers>

#include "hersey/fem/load_distributions.h"
#include "hersey/fem/surface_detection.h"
#include "surface/detection_names.h"
#include "surface/detection_regions.h"

namespace hersey::fem {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kLeastArcOfBore = 120 * kDegree;
constexpr double kNearlyFull = 300 * kDegree;
constexpr double kLeastReportedArc = 60 * kDegree;
constexpr double kNarrowest = 0.1, kWidestBore = 2;  // by the diameter

/// True if more than half of a cylinder's sides, the parts of its rim along the axis, continue without an edge.
bool has_smooth_sides(const Mesh& mesh, const SurfaceFacets& surface, const CylinderRegion& region) {
  double sides = 0, smooth = 0;
  for (const int f : region.facets)
    for (const FacetNeighbour& to : surface.neighbours[static_cast<std::size_t>(f)]) {
      if (std::binary_search(region.facets.begin(), region.facets.end(), to.facet)) continue;
      const Vector3 edge =
          mesh.nodes[static_cast<std::size_t>(to.last)] - mesh.nodes[static_cast<std::size_t>(to.first)];
      const double along = std::abs(region.fit.axis.dot(edge));
      if (along < edge.norm() / 2) continue;
      sides += along;
      if (to.angle <= kSmoothAngle) smooth += along;
    }
  return smooth > sides / 2;
}

void take_faces(const SurfaceFacets& surface, const std::vector<int>& facets, FoundSurface& found) {
  Vector3 moment = Vector3::Zero();
  for (const int f : facets) {
    const Facet& facet = surface.facets[static_cast<std::size_t>(f)];
    found.faces.push_back(facet.face);
    found.area += facet.area;
    moment += facet.area * facet.centre;
  }
  found.centre = moment / found.area;
}

FoundSurface cylinder_of(const Mesh& mesh, const SurfaceFacets& surface, const CylinderRegion& region) {
  FoundSurface found;
  found.kind = FoundSurface::Kind::cylinder;
  take_faces(surface, region.facets, found);
  const CylinderExtent extent = extent_of(mesh, surface, region);
  Eigen::Index largest = 0;
  region.fit.axis.cwiseAbs().maxCoeff(&largest);
  found.axis = region.fit.axis[largest] < 0 ? Vector3(-region.fit.axis) : region.fit.axis;
  found.centre = region.fit.point + (extent.low + extent.high) / 2 * region.fit.axis;
  found.radius = region.fit.radius;
  found.width = extent.high - extent.low;
  found.arc = extent.arc;
  found.cover = found.area / (found.arc * found.radius * found.width);
  found.deviation = extent.deviation;
  found.is_internal = region.is_internal;
  found.runs_into_neighbours = found.arc < kNearlyFull && has_smooth_sides(mesh, surface, region);
  return found;
}

FoundSurface plane_of(const Mesh& mesh, const SurfaceFacets& surface, const PlaneRegion& region) {
  FoundSurface found;
  take_faces(surface, region.facets, found);
  Vector3 normal = Vector3::Zero();
  for (const int f : region.facets) {
    const Facet& facet = surface.facets[static_cast<std::size_t>(f)];
    normal += facet.area * facet.normal;
  }
  found.axis = normal.normalized();
  for (const int f : region.facets)
    for (const int node : surface.facets[static_cast<std::size_t>(f)].nodes)
      found.deviation = std::max(found.deviation,
                                 std::abs(found.axis.dot(mesh.nodes[static_cast<std::size_t>(node)] - found.centre)));
  return found;
}

/// Order: bores, journals, other cylinders, planes; within each kind the larger first, then by position.
bool comes_before(const FoundSurface& a, const FoundSurface& b) {
  const auto rank = [](const FoundSurface& s) {
    if (s.kind == FoundSurface::Kind::plane) return 3;
    return s.use() == FoundSurface::Use::bore ? 0 : s.use() == FoundSurface::Use::journal ? 1 : 2;
  };
  if (rank(a) != rank(b)) return rank(a) < rank(b);
  const double size_a = rank(a) == 3 ? a.area : a.radius, size_b = rank(a) == 3 ? b.area : b.radius;
  // Sizes that are equal except for round-off are ordered by position.
  if (std::abs(size_a - size_b) > 1e-6 * size_a) return size_a > size_b;
  for (int i = 0; i < 3; ++i)
    if (std::abs(a.centre[i] - b.centre[i]) > 1e-9) return a.centre[i] < b.centre[i];
  return false;
}

}  // namespace

FoundSurface::Use FoundSurface::use() const {
  if (kind == Kind::plane || runs_into_neighbours || width < kNarrowest * 2 * radius) return Use::none;
  if (!is_internal) return arc >= kNearlyFull ? Use::journal : Use::none;
  return arc >= kLeastArcOfBore && width <= kWidestBore * 2 * radius ? Use::bore : Use::none;
}

std::vector<FoundSurface> find_surfaces(const Mesh& mesh) {
  const SurfaceFacets surface = surface_facets(mesh);
  if (surface.facets.empty()) return {};
  Vector3 lower = mesh.nodes.front(), upper = lower;
  for (const Vector3& x : mesh.nodes) lower = lower.cwiseMin(x), upper = upper.cwiseMax(x);
  const double size = (upper - lower).norm();
  std::vector<char> taken(surface.facets.size(), 0);
  std::vector<CylinderRegion> cylinders = cylinder_regions(mesh, surface, size, taken);
  cylinders = merged_regions(mesh, surface, std::move(cylinders));
  std::vector<FoundSurface> found;
  for (const CylinderRegion& region : cylinders) {
    FoundSurface cylinder = cylinder_of(mesh, surface, region);
    if (cylinder.arc >= kLeastReportedArc) found.push_back(std::move(cylinder));
  }
  for (const PlaneRegion& region : plane_regions(mesh, surface, size, taken))
    found.push_back(plane_of(mesh, surface, region));
  std::stable_sort(found.begin(), found.end(), comes_before);
  name_surfaces(mesh, lower, upper, found);
  return found;
}

void add_surfaces(Mesh& mesh, const std::vector<FoundSurface>& found) {
  for (const FoundSurface& surface : found) {
    if (!mesh.surfaces.try_emplace(surface.name, surface.faces).second) continue;
    mesh.node_sets.try_emplace(surface.name, nodes_on(mesh, surface.faces));
  }
}

}  // namespace hersey::fem
