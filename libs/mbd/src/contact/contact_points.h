#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "contact/dual.h"
#include "hersey/mbd/shape.h"

namespace hersey::mbd {

/// Pair of nearest points of two surfaces: the geometry that the contact law needs, in frame A.
template <class T>
struct ContactPoint {
  T gap;             ///< along the normal, negative where they overlap [m]
  Vec3<T> normal;    ///< unit vector from A to B
  Vec3<T> position;  ///< half-way between the surfaces
  T weight;          ///< share of the law's force; the area [m^2] where the law gives a pressure
};

/// Identifies a contact point of a pair of shapes; the meaning of the numbers is defined by the search.
struct ContactPointId {
  int kind = 0;
  int index = 0;
  int part = 0;
};

/// Geometry of a pair of shapes: finds contact points that overlap and evaluates them with their derivatives.
class ContactSearch {
 public:
  ContactSearch() = default;
  ContactSearch(const ContactSearch&) = delete;
  ContactSearch& operator=(const ContactSearch&) = delete;
  virtual ~ContactSearch() = default;

  /// Adds every contact point with gap < 0. Allocates nothing once `found` and the workspace have their final size.
  virtual void find(const Pose& X_AB, std::vector<ContactPointId>& found) = 0;
  [[nodiscard]] virtual ContactPoint<double> point(const ContactPointId& id, const PoseOf<double>& X_AB) const = 0;
  [[nodiscard]] virtual ContactPoint<Dual> point(const ContactPointId& id, const PoseOf<Dual>& X_AB) const = 0;
  /// Adds every possible contact point, for deforming corners, each of which has its own position.
  virtual void find_all(std::vector<ContactPointId>& found) const { (void)found; }
  /// Returns the smallest gap of all contact points [m], touching or not.
  [[nodiscard]] virtual double smallest_gap(const Pose& X_AB) = 0;
  /// True if the weight of a contact point is an area.
  [[nodiscard]] virtual bool weighs_area() const { return false; }
};

/// Passes both number types on to the derived class's template `at`.
template <class Derived>
class ContactSearchOf : public ContactSearch {
 public:
  [[nodiscard]] ContactPoint<double> point(const ContactPointId& id, const PoseOf<double>& X_AB) const override {
    return static_cast<const Derived&>(*this).template at<double>(id, X_AB);
  }
  [[nodiscard]] ContactPoint<Dual> point(const ContactPointId& id, const PoseOf<Dual>& X_AB) const override {
    return static_cast<const Derived&>(*this).template at<Dual>(id, X_AB);
  }
};

/// Returns a pose without derivatives.
[[nodiscard]] inline PoseOf<double> plain_pose(const Pose& X) { return {X.R.col(0), X.R.col(1), X.R.col(2), X.r}; }

/// Returns the contact point between a ball on one body and a surface on the other.
/// @param on_b      the ball is on B, its surface's partner on A; else the other way round
/// @param centre    centre of the ball in the frame of its body
/// @param distance  gives distance and normal of a point in the surface's frame
template <class T, class Distance>
ContactPoint<T> ball_contact_point(bool on_b, const Vector3& centre, double radius, double weight,
                                   const PoseOf<T>& X_AB, Distance distance) {
  const Vec3<T> own = constant<T>(centre);
  const auto nearest = distance(on_b ? X_AB.transform(own) : X_AB.inverse_transform(own));
  const T middle = T(0.5) * (nearest.distance + T(radius));
  if (on_b)
    return {nearest.distance - T(radius), nearest.normal, Vec3<T>(X_AB.transform(own) - scaled(middle, nearest.normal)),
            T(weight)};
  const Vec3<T> normal = -X_AB.rotate(nearest.normal);
  return {nearest.distance - T(radius), normal, Vec3<T>(own + scaled(middle, normal)), T(weight)};
}

/// Returns the search for a pair of shapes; null if the pair is not supported.
[[nodiscard]] std::unique_ptr<ContactSearch> make_contact_search(const ShapeGeometry& a, const ShapeGeometry& b);

// Searches of the supported pairs. `on_b`: the first shape is on body B.
[[nodiscard]] std::unique_ptr<ContactSearch> balls_on_solid(std::vector<Sphere> balls, ShapeGeometry solid, bool on_b);
[[nodiscard]] std::unique_ptr<ContactSearch> rims_on_plane(const Cylinder& cylinder, const HalfSpace& plane, bool on_b);
[[nodiscard]] std::unique_ptr<ContactSearch> capsule_on_capsule(const Capsule& a, const Capsule& b);
[[nodiscard]] std::unique_ptr<ContactSearch> ball_on_mesh(const Sphere& ball, std::shared_ptr<const TriangleMesh> mesh,
                                                          bool on_b);
[[nodiscard]] std::unique_ptr<ContactSearch> corners_on_solid(std::shared_ptr<const TriangleMesh> mesh,
                                                              ShapeGeometry solid, bool on_b);

}  // namespace hersey::mbd
