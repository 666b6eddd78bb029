// Contact points of triangulated surfaces: a ball on the mesh, and the mesh's corners on a solid.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/contact_points.h"
#include "contact/mesh_surface.h"
#include "contact/solid_distance.h"

namespace hersey::mbd {
namespace {

// The ball touches each face, edge and corner whose distance from its centre is a local minimum: one contact point on
// flat and convex surfaces, one per wall in a corner. Where faces meet at an edge the distance is continuous with its
// gradient.
class BallOnMesh final : public ContactSearchOf<BallOnMesh> {
 public:
  BallOnMesh(const Sphere& ball, std::shared_ptr<const TriangleMesh> mesh, bool on_b)
      : ball_(ball), surface_(std::move(mesh)), on_b_(on_b) {}

  void find(const Pose& X_AB, std::vector<ContactPointId>& found) override {
    const Vector3 centre = centre_on_mesh(X_AB);
    near_.clear();
    const double reach2 = ball_.radius * ball_.radius;
    surface_.triangles().visit([&](const BoxTree::Box& box) { return box.squaredExteriorDistance(centre) < reach2; },
                               [&](int triangle) { examine(triangle, centre); });
    const auto nearest = std::min_element(near_.begin(), near_.end(), [](const Near& x, const Near& y) {
      return x.nearest.distance < y.nearest.distance;
    });
    if (nearest == near_.end()) return;
    if (nearest->is_behind) {  // the centre has passed the surface: too deep to be resolved, which the gap shows
      found.push_back(id_of(*nearest));
      return;
    }
    for (const Near& candidate : near_)
      if (!candidate.is_behind) found.push_back(id_of(candidate));
  }

  double smallest_gap(const Pose& X_AB) override {
    const Vector3 centre = centre_on_mesh(X_AB);
    double nearest = std::numeric_limits<double>::infinity();
    bool is_behind = false;
    surface_.triangles().visit(
        [&](const BoxTree::Box& box) { return box.squaredExteriorDistance(centre) < nearest * nearest; },
        [&](int triangle) {
          const NearestOnTriangle on_triangle = surface_.nearest_on(triangle, centre);
          if (on_triangle.distance >= nearest) return;
          nearest = on_triangle.distance;
          is_behind =
              on_triangle.feature == Feature::face && surface_.normal(triangle).dot(centre - on_triangle.point) < 0;
        });
    return (is_behind ? -nearest : nearest) - ball_.radius;
  }

  template <class T>
  [[nodiscard]] ContactPoint<T> at(const ContactPointId& id, const PoseOf<T>& X) const {
    const auto distance = [&](const Vec3<T>& p) {
      const Vec3<T> corner = constant<T>(surface_.corner(id.index, id.part));
      const auto feature = static_cast<Feature>(id.kind);
      if (feature == Feature::corner) return distance_from(corner, p);
      if (feature == Feature::edge) {
        const Vec3<T> along =
            constant<T>((surface_.corner(id.index, id.part + 1) - surface_.corner(id.index, id.part)).normalized());
        return distance_from(Vec3<T>(corner + scaled(dot(along, Vec3<T>(p - corner)), along)), p);
      }
      const Vec3<T> normal = constant<T>(surface_.normal(id.index));
      return SurfaceDistance<T>{dot(normal, Vec3<T>(p - corner)), normal};
    };
    return ball_contact_point(on_b_, ball_.centre, ball_.radius, 1, X, distance);
  }

 private:
  struct Near {
    int triangle = 0;
    NearestOnTriangle nearest;
    bool is_behind = false;
  };

  [[nodiscard]] Vector3 centre_on_mesh(const Pose& X_AB) const {
    return on_b_ ? X_AB * ball_.centre : X_AB.inverse() * ball_.centre;
  }

  static ContactPointId id_of(const Near& candidate) {
    return {static_cast<int>(candidate.nearest.feature), candidate.triangle, candidate.nearest.part};
  }

  void examine(int triangle, const Vector3& centre) {
    const NearestOnTriangle on_triangle = surface_.nearest_on(triangle, centre);
    if (on_triangle.distance >= ball_.radius || !surface_.is_local_minimum(triangle, on_triangle, centre)) return;
    const Near candidate{
        triangle, on_triangle,
        on_triangle.feature == Feature::face && surface_.normal(triangle).dot(centre - on_triangle.point) < 0};
    // Neighbours find the same edge or corner; its position agrees within the round-off of the distances.
    const double same = 10 * std::sqrt(MeshSurface::round_off) * ball_.radius;
    for (Near& other : near_) {
      if ((other.nearest.point - on_triangle.point).norm() > same) continue;
      if (on_triangle.feature < other.nearest.feature)
        other = candidate;  // the normal of a face does not depend on the position
      return;
    }
    near_.push_back(candidate);
  }

  Sphere ball_;
  MeshSurface surface_;
  bool on_b_;
  std::vector<Near> near_;
};

// Each corner of the mesh represents the area around it.
class CornersOnSolid final : public ContactSearchOf<CornersOnSolid> {
 public:
  CornersOnSolid(std::shared_ptr<const TriangleMesh> mesh, ShapeGeometry solid, bool on_b)
      : surface_(std::move(mesh)), solid_(std::move(solid)), on_b_(on_b) {}

  void find(const Pose& X_AB, std::vector<ContactPointId>& found) override {
    const Pose X_SM = on_b_ ? X_AB : X_AB.inverse();
    // No point of a box is nearer to the solid than its centre less half its diagonal.
    surface_.corners().visit(
        [&](const BoxTree::Box& box) { return distance(X_SM * box.center()) < 0.5 * box.diagonal().norm() + 1e-300; },
        [&](int corner) {
          if (distance(X_SM * surface_.mesh().corners[corner]) < 0) found.push_back({0, corner, 0});
        });
  }

  void find_all(std::vector<ContactPointId>& found) const override {
    for (int corner = 0; corner < static_cast<int>(surface_.mesh().corners.size()); ++corner)
      found.push_back({0, corner, 0});
  }

  double smallest_gap(const Pose& X_AB) override {
    const Pose X_SM = on_b_ ? X_AB : X_AB.inverse();
    double nearest = std::numeric_limits<double>::infinity();
    surface_.corners().visit(
        [&](const BoxTree::Box& box) { return distance(X_SM * box.center()) - 0.5 * box.diagonal().norm() < nearest; },
        [&](int corner) { nearest = std::min(nearest, distance(X_SM * surface_.mesh().corners[corner])); });
    return nearest;
  }

  [[nodiscard]] bool weighs_area() const override { return true; }

  template <class T>
  [[nodiscard]] ContactPoint<T> at(const ContactPointId& id, const PoseOf<T>& X) const {
    return ball_contact_point(on_b_, surface_.mesh().corners[id.index], 0, surface_.corner_areas()[id.index], X,
                              [&](const Vec3<T>& p) { return surface_distance(p); });
  }

 private:
  template <class T>
  [[nodiscard]] SurfaceDistance<T> surface_distance(const Vec3<T>& p) const {
    if (const auto* plane = std::get_if<HalfSpace>(&solid_)) return distance_from(*plane, p);
    if (const auto* ball = std::get_if<Sphere>(&solid_)) return distance_from(*ball, p);
    if (const auto* capsule = std::get_if<Capsule>(&solid_)) return distance_from(*capsule, p);
    if (const auto* cylinder = std::get_if<Cylinder>(&solid_)) return distance_from(*cylinder, p);
    return distance_from(std::get<Box>(solid_), p);
  }
  [[nodiscard]] double distance(const Vector3& p) const { return surface_distance<double>(p).distance; }

  MeshSurface surface_;
  ShapeGeometry solid_;
  bool on_b_;
};

}  // namespace

std::unique_ptr<ContactSearch> ball_on_mesh(const Sphere& ball, std::shared_ptr<const TriangleMesh> mesh, bool on_b) {
  return std::make_unique<BallOnMesh>(ball, std::move(mesh), on_b);
}

std::unique_ptr<ContactSearch> corners_on_solid(std::shared_ptr<const TriangleMesh> mesh, ShapeGeometry solid,
                                                bool on_b) {
  return std::make_unique<CornersOnSolid>(std::move(mesh), std::move(solid), on_b);
}

}  // namespace hersey::mbd
