// Planes of a surface: connected facets without curvature.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "surface/detection_regions.h"

namespace hersey::fem {
namespace {

constexpr double kFlatness = 1e-5;   // of the mesh's size: coordinates of five figures
constexpr double kFlatAngle = 2e-2;  // [rad]: what that does to the normals of small facets

class PlaneFinder {
 public:
  PlaneFinder(const Mesh& mesh, const SurfaceFacets& surface, double size, std::vector<char>& taken)
      : mesh_(mesh), surface_(surface), within_(kFlatness * size), taken_(taken) {}

  std::vector<PlaneRegion> regions() {
    std::vector<int> order(surface_.facets.size());
    std::iota(order.begin(), order.end(), 0);
    // The largest facet has the best normal.
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return facet(a).area > facet(b).area; });
    std::vector<PlaneRegion> found;
    for (const int f : order) {
      if (taken_[static_cast<std::size_t>(f)] != 0) continue;
      PlaneRegion region{facet(f).normal, facet(f).centre, {}};
      if (!lies_on(region, f)) continue;
      grow(region, f);
      if (!is_surface_of_its_own(region)) {
        for (const int member : region.facets) taken_[static_cast<std::size_t>(member)] = 0;
        taken_[static_cast<std::size_t>(f)] = 2;  // tried
        continue;
      }
      add(std::move(region), found);
    }
    for (char& entry : taken_)
      if (entry == 2) entry = 0;
    return found;
  }

 private:
  [[nodiscard]] const Facet& facet(int f) const { return surface_.facets[static_cast<std::size_t>(f)]; }

  [[nodiscard]] bool lies_on(const PlaneRegion& region, int f) const {
    if (!(facet(f).normal.dot(region.normal) > std::cos(kFlatAngle))) return false;
    return std::all_of(facet(f).nodes.begin(), facet(f).nodes.end(), [&](int node) {
      return std::abs(region.normal.dot(mesh_.nodes[static_cast<std::size_t>(node)] - region.point)) <= within_;
    });
  }

  void grow(PlaneRegion& region, int seed) {
    region.facets = {seed};
    taken_[static_cast<std::size_t>(seed)] = 1;
    for (std::size_t k = 0; k < region.facets.size(); ++k)
      for (const FacetNeighbour& to : surface_.neighbours[static_cast<std::size_t>(region.facets[k])]) {
        char& taken = taken_[static_cast<std::size_t>(to.facet)];
        if (taken == 1 || !lies_on(region, to.facet)) continue;
        taken = 1;
        region.facets.push_back(to.facet);
      }
    std::sort(region.facets.begin(), region.facets.end());
  }

  /// True if edges form half of its rim, or if it has a corner inside: otherwise it is one of the strips or facets of a
  /// curved surface.
  [[nodiscard]] bool is_surface_of_its_own(const PlaneRegion& region) const {
    double rim = 0, edges = 0;
    std::vector<int> inner, on_rim;
    for (const int f : region.facets) {
      inner.insert(inner.end(), facet(f).nodes.begin(), facet(f).nodes.begin() + static_cast<int>(facet(f).corners));
      for (const FacetNeighbour& to : surface_.neighbours[static_cast<std::size_t>(f)]) {
        if (std::binary_search(region.facets.begin(), region.facets.end(), to.facet)) continue;
        const double length =
            (mesh_.nodes[static_cast<std::size_t>(to.last)] - mesh_.nodes[static_cast<std::size_t>(to.first)]).norm();
        rim += length;
        if (to.angle > kSmoothAngle) edges += length;
        on_rim.insert(on_rim.end(), {to.first, to.last});
      }
    }
    if (edges >= rim / 2) return true;
    std::sort(on_rim.begin(), on_rim.end());
    return std::any_of(inner.begin(), inner.end(),
                       [&](int node) { return !std::binary_search(on_rim.begin(), on_rim.end(), node); });
  }

  void add(PlaneRegion region, std::vector<PlaneRegion>& found) const {
    for (PlaneRegion& other : found) {
      const auto is_on_other = [&](int f) { return lies_on(other, f); };
      if (!std::all_of(region.facets.begin(), region.facets.end(), is_on_other)) continue;
      other.facets.insert(other.facets.end(), region.facets.begin(), region.facets.end());
      std::sort(other.facets.begin(), other.facets.end());
      return;
    }
    found.push_back(std::move(region));
  }

  const Mesh& mesh_;
  const SurfaceFacets& surface_;
  double within_;  // [m]
  std::vector<char>& taken_;
};

}  // namespace

std::vector<PlaneRegion> plane_regions(const Mesh& mesh, const SurfaceFacets& surface, double size,
                                       std::vector<char>& taken) {
  return PlaneFinder(mesh, surface, size, taken).regions();
}

}  // namespace hersey::fem
