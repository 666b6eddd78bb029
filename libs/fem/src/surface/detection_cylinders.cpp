// Cylinders of a surface: a few facets around a facet give a fit, and the region grows over the facets that lie on it.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "hersey/core/two_pi.h"
#include "surface/detection_regions.h"

namespace hersey::fem {
namespace {

// Numbers of rings of facets around a facet that make the first fit: more rings are better unless they reach beyond the
// cylinder.
constexpr std::array<int, 3> kRings = {3, 2, 1};

// A nearly flat region fits a cylinder too: below this arc the first facets' sagitta is within `kRoundness`.
constexpr double kLeastFitArc = 6 * std::numbers::pi / 180;
constexpr double kLeastArc = 20 * std::numbers::pi / 180;

// Largest angle of a facet's normal from the radius: half a facet's arc, and the tilt of triangles whose corners lie on
// a cylinder.
const double kAlongRadius = std::cos(25 * std::numbers::pi / 180);

constexpr int kMostFits = 6;

const Vector3& position_of(const Mesh& mesh, int node) { return mesh.nodes[static_cast<std::size_t>(node)]; }

/// Corners of facets, each once, and midside nodes where `with_midside` finds them good.
template <typename WithMidside>
std::vector<Vector3> points_of(const Mesh& mesh, const SurfaceFacets& surface, const std::vector<int>& facets,
                               const WithMidside& with_midside) {
  std::vector<int> nodes;
  for (const int f : facets) {
    const Facet& facet = surface.facets[static_cast<std::size_t>(f)];
    for (std::size_t k = 0; k < facet.nodes.size(); ++k)
      if (k < facet.corners || with_midside(position_of(mesh, facet.nodes[k]))) nodes.push_back(facet.nodes[k]);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<Vector3> points;
  points.reserve(nodes.size());
  for (const int node : nodes) points.push_back(position_of(mesh, node));
  return points;
}

class CylinderFinder {
 public:
  CylinderFinder(const Mesh& mesh, const SurfaceFacets& surface, double size, std::vector<char>& taken)
      : mesh_(mesh),
        surface_(surface),
        size_(size),
        taken_(taken),
        visited_(surface.facets.size(), 0),
        too_short_(surface.facets.size(), 0) {}

  std::vector<CylinderRegion> regions() {
    std::vector<CylinderRegion> found;
    for (int f = 0; f < static_cast<int>(surface_.facets.size()); ++f) {
      if (taken_[static_cast<std::size_t>(f)] != 0 || is_flat_around(f)) continue;
      for (const int rings : kRings) {
        if (too_short_[static_cast<std::size_t>(f)] != 0) break;
        std::optional<CylinderRegion> region = region_from(f, rings);
        if (!region) continue;
        for (const int member : region->facets) taken_[static_cast<std::size_t>(member)] = 1;
        found.push_back(std::move(*region));
        break;
      }
    }
    return found;
  }

 private:
  [[nodiscard]] const Facet& facet(int f) const { return surface_.facets[static_cast<std::size_t>(f)]; }

  [[nodiscard]] bool is_flat_around(int f) const {
    for (const Vector3& normal : facet(f).normals)
      if (facet(f).normal.dot(normal) < 1 - 1e-8) return false;  // 1e-4: round-off of a file's numbers
    const auto& neighbours = surface_.neighbours[static_cast<std::size_t>(f)];
    return std::none_of(neighbours.begin(), neighbours.end(),
                        [](const FacetNeighbour& n) { return n.angle > 1e-4 && n.angle < kSmoothAngle; });
  }

  /// Facets reached from `f` over smooth edges, as far as `is_of` holds; within `rings` edges.
  template <typename IsOf>
  std::vector<int> reached(int f, int rings, const IsOf& is_of) {
    ++pass_;
    std::vector<int> facets{f}, front{f}, next;
    visited_[static_cast<std::size_t>(f)] = pass_;
    for (int ring = 0; ring < rings && !front.empty(); ++ring) {
      next.clear();
      for (const int from : front)
        for (const FacetNeighbour& to : surface_.neighbours[static_cast<std::size_t>(from)]) {
          const auto t = static_cast<std::size_t>(to.facet);
          if (to.angle > kSmoothAngle || visited_[t] == pass_ || taken_[t] != 0 || !is_of(to.facet)) continue;
          visited_[t] = pass_;
          next.push_back(to.facet);
        }
      facets.insert(facets.end(), next.begin(), next.end());
      front.swap(next);
    }
    std::sort(facets.begin(), facets.end());
    return facets;
  }

  std::optional<CylinderRegion> region_from(int seed, int rings) {
    const std::vector<int> first = reached(seed, rings, [](int) { return true; });
    // Normals of a cylinder are square to its axis: they hardly spread along it.
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const int f : first)
      for (const Vector3& normal : facet(f).normals)
        spread += facet(f).area / static_cast<double>(facet(f).normals.size()) * normal * normal.transpose();
    const Vector3 axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
    // A single ring has few corners; where midside nodes lie on straight edges their fit fails.
    const auto points = points_of(mesh_, surface_, first, [&](const Vector3&) { return rings == 1; });
    CylinderRegion region;
    std::optional<CylinderFit> fit = fit_cylinder(points, axis, size_);
    if (!fit) return std::nullopt;
    region.fit = *fit;
    region.facets = first;
    for (const Vector3& x : points)
      if (std::abs(fit->deviation(x)) > kRoundness * fit->radius) return std::nullopt;
    region.is_internal = fit->from_axis(facet(seed).centre).dot(facet(seed).normal) < 0;
    if (extent_of(mesh_, surface_, region).arc < kLeastFitArc || !lies_on(region, seed)) return std::nullopt;
    if (!grow(region, seed)) return std::nullopt;
    if (extent_of(mesh_, surface_, region).arc >= kLeastArc) return region;
    // Each of its facets would grow to the same again.
    for (const int member : region.facets) too_short_[static_cast<std::size_t>(member)] = 1;
    return std::nullopt;
  }

  /// Takes all facets on the fit, fits the cylinder to them, and repeats until the region does not change.
  bool grow(CylinderRegion& region, int seed) {
    std::size_t members = 0;
    for (int k = 0; k < kMostFits; ++k) {
      region.facets =
          reached(seed, static_cast<int>(surface_.facets.size()), [&](int f) { return lies_on(region, f); });
      if (region.facets.size() == members) return true;
      members = region.facets.size();
      const double within = kRoundness * region.fit.radius;
      const auto points = points_of(mesh_, surface_, region.facets,
                                    [&](const Vector3& x) { return std::abs(region.fit.deviation(x)) < within; });
      const std::optional<CylinderFit> fit = fit_cylinder(points, region.fit.axis, size_);
      if (!fit) return false;
      region.fit = *fit;
      if (!lies_on(region, seed)) return false;
    }
    return true;
  }

  [[nodiscard]] bool lies_on(const CylinderRegion& region, int f) const {
    const Facet& candidate = facet(f);
    const Vector3 radius = region.fit.from_axis(candidate.centre);
    const double outwards = candidate.normal.dot(radius) / radius.norm();
    if (!((region.is_internal ? -outwards : outwards) > kAlongRadius)) return false;
    for (std::size_t c = 0; c < candidate.corners; ++c)
      if (std::abs(region.fit.deviation(position_of(mesh_, candidate.nodes[c]))) > kRoundness * region.fit.radius)
        return false;
    // A midside node is on the cylinder, or no deeper than a straight edge's middle.
    for (std::size_t k = candidate.corners; k < candidate.nodes.size(); ++k) {
      const std::size_t c = k - candidate.corners, next = c + 1 == candidate.corners ? 0 : c + 1;
      const Vector3 edge = position_of(mesh_, candidate.nodes[next]) - position_of(mesh_, candidate.nodes[c]);
      const double sagitta = edge.squaredNorm() / (8 * region.fit.radius);
      const double deviation = region.fit.deviation(position_of(mesh_, candidate.nodes[k]));
      const double within = kRoundness * region.fit.radius;
      if (deviation > within || deviation < -1.2 * sagitta - within) return false;
    }
    return true;
  }

  const Mesh& mesh_;
  const SurfaceFacets& surface_;
  double size_;
  std::vector<char>& taken_;
  std::vector<int> visited_;     // index of the last pass that visited each facet
  std::vector<char> too_short_;  // part of a region that was
  int pass_ = 0;
};

}  // namespace

CylinderExtent extent_of(const Mesh& mesh, const SurfaceFacets& surface, const CylinderRegion& region) {
  const CylinderFit& fit = region.fit;
  CylinderExtent extent;
  extent.low = std::numeric_limits<double>::infinity(), extent.high = -extent.low;
  const Vector3 zero =
      fit.from_axis(surface.facets[static_cast<std::size_t>(region.facets.front())].centre).normalized();
  const Vector3 quarter = fit.axis.cross(zero);
  std::vector<std::pair<double, double>> angles;
  for (const int f : region.facets) {
    const Facet& facet = surface.facets[static_cast<std::size_t>(f)];
    const Vector3 middle = fit.from_axis(facet.centre);
    const double phi = std::atan2(quarter.dot(middle), zero.dot(middle));
    double before = 0, after = 0;
    for (std::size_t c = 0; c < facet.corners; ++c) {
      const Vector3& x = position_of(mesh, facet.nodes[c]);
      const Vector3 r = fit.from_axis(x);
      const double from_middle = std::remainder(std::atan2(quarter.dot(r), zero.dot(r)) - phi, two_pi);
      before = std::min(before, from_middle), after = std::max(after, from_middle);
      const double along = fit.axis.dot(x - fit.point);
      extent.low = std::min(extent.low, along), extent.high = std::max(extent.high, along);
      extent.deviation = std::max(extent.deviation, std::abs(fit.deviation(x)));
    }
    angles.emplace_back(phi + before, phi + after);
  }
  std::sort(angles.begin(), angles.end());
  double reached = angles.front().first;
  for (const auto& [from, to] : angles) {
    extent.arc += std::max(0.0, to - std::max(from, reached));
    reached = std::max(reached, to);
  }
  extent.arc -= std::max(0.0, reached - angles.front().first - two_pi);  // counted twice where the revolution closes
  return extent;
}

std::vector<CylinderRegion> cylinder_regions(const Mesh& mesh, const SurfaceFacets& surface, double size,
                                             std::vector<char>& taken) {
  return CylinderFinder(mesh, surface, size, taken).regions();
}

namespace {

bool are_of_one_cylinder(const CylinderRegion& a, const CylinderExtent& of_a, const CylinderRegion& b,
                         const CylinderExtent& of_b) {
  const double within = 5 * kRoundness * a.fit.radius;
  if (a.is_internal != b.is_internal || std::abs(a.fit.radius - b.fit.radius) > within) return false;
  const Vector3 first = b.fit.point + of_b.low * b.fit.axis, last = b.fit.point + of_b.high * b.fit.axis;
  if (a.fit.from_axis(first).norm() > within || a.fit.from_axis(last).norm() > within) return false;
  const auto [low, high] = std::minmax({a.fit.axis.dot(first - a.fit.point), a.fit.axis.dot(last - a.fit.point)});
  const double gap = std::max(low - of_a.high, of_a.low - high);
  return gap <= 0.5 * std::min(of_a.high - of_a.low, high - low);
}

}  // namespace

std::vector<CylinderRegion> merged_regions(const Mesh& mesh, const SurfaceFacets& surface,
                                           std::vector<CylinderRegion> regions) {
  std::vector<CylinderExtent> extents;
  extents.reserve(regions.size());
  for (const CylinderRegion& region : regions) extents.push_back(extent_of(mesh, surface, region));
  for (std::size_t a = 0; a < regions.size(); ++a)
    for (std::size_t b = a + 1; b < regions.size(); ++b) {
      if (!are_of_one_cylinder(regions[a], extents[a], regions[b], extents[b])) continue;
      CylinderRegion& whole = regions[a];
      const double within = kRoundness * whole.fit.radius;
      whole.facets.insert(whole.facets.end(), regions[b].facets.begin(), regions[b].facets.end());
      std::sort(whole.facets.begin(), whole.facets.end());
      const auto points = points_of(mesh, surface, whole.facets,
                                    [&](const Vector3& x) { return std::abs(whole.fit.deviation(x)) < within; });
      if (const auto fit = fit_cylinder(points, whole.fit.axis, 2 * whole.fit.radius)) whole.fit = *fit;
      extents[a] = extent_of(mesh, surface, whole);
      regions.erase(regions.begin() + static_cast<std::ptrdiff_t>(b));
      extents.erase(extents.begin() + static_cast<std::ptrdiff_t>(b));
      b = a;  // the longer piece may reach others now
    }
  return regions;
}

}  // namespace hersey::fem
