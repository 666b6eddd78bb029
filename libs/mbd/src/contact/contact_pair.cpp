// Contact searches of all pairs of shapes.
#include "contact/contact_points.h"

namespace hersey::mbd {
namespace {

template <class S>
const S* as(const ShapeGeometry& shape) {
  return std::get_if<S>(&shape);
}

using MeshPointer = std::shared_ptr<const TriangleMesh>;

std::vector<Sphere> corners_of(const Box& box) {
  std::vector<Sphere> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i) {
    const Vector3 signs((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5, (i & 4) != 0 ? 0.5 : -0.5);
    corners.push_back({box.X_BS * signs.cwiseProduct(box.size), 0});
  }
  return corners;
}

/// Returns the search of contact points of `first` on the surface of `second`; null if there is none.
std::unique_ptr<ContactSearch> search_of(const ShapeGeometry& first, const ShapeGeometry& second, bool first_on_b) {
  if (const auto* ball = as<Sphere>(first)) {
    if (const auto* mesh = as<MeshPointer>(second)) return ball_on_mesh(*ball, *mesh, first_on_b);
    return balls_on_solid({*ball}, second, first_on_b);
  }
  if (const auto* mesh = as<MeshPointer>(first)) {
    if (as<MeshPointer>(second) != nullptr || as<Sphere>(second) != nullptr) return nullptr;
    return corners_on_solid(*mesh, second, first_on_b);
  }
  const auto* plane = as<HalfSpace>(second);
  if (plane == nullptr) return nullptr;
  if (const auto* capsule = as<Capsule>(first))
    return balls_on_solid({{capsule->from, capsule->radius}, {capsule->to, capsule->radius}}, *plane, first_on_b);
  if (const auto* box = as<Box>(first)) return balls_on_solid(corners_of(*box), *plane, first_on_b);
  if (const auto* cylinder = as<Cylinder>(first)) return rims_on_plane(*cylinder, *plane, first_on_b);
  return nullptr;
}

}  // namespace

std::unique_ptr<ContactSearch> make_contact_search(const ShapeGeometry& a, const ShapeGeometry& b) {
  if (as<Capsule>(a) != nullptr && as<Capsule>(b) != nullptr)
    return capsule_on_capsule(std::get<Capsule>(a), std::get<Capsule>(b));
  if (auto search = search_of(b, a, true)) return search;
  return search_of(a, b, false);
}

}  // namespace hersey::mbd
