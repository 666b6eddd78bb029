#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "contact/dual.h"
#include "hersey/mbd/shape.h"

namespace hersey::mbd {

/// One place where two surfaces are close: all that the contact law needs to know of shapes. In frame A.
template <class T>
struct ContactPoint {
  T gap;             ///< along the normal, negative where they overlap [m]
  Vec3<T> normal;    ///< unit vector from A to B
  Vec3<T> position;  ///< half-way between the surfaces
  T weight;          ///< share of the law's force; the area [m^2] where the law gives a pressure
};

/// Names one spot of a pair of shapes; what the numbers mean is the finder's own affair.
struct ContactPointId {
  int kind = 0;
  int index = 0;
  int part = 0;
};

/// The geometry of a pair of shapes: finds spots that overlap, and gives each with its derivatives.
class ContactSearch {
 public:
  ContactSearch() = default;
  ContactSearch(const ContactSearch&) = delete;
  ContactSearch& operator=(const ContactSearch&) = delete;
  virtual ~ContactSearch() = default;

  /// Adds every spot with gap < 0. Allocates nothing once `found` and the finder's workspace have grown to their size.
  virtual void find(const Pose& X_AB, std::vector<ContactPointId>& found) = 0;
  [[nodiscard]] virtual ContactPoint<double> spot(const ContactPointId& id, const PoseOf<double>& X_AB) const = 0;
  [[nodiscard]] virtual ContactPoint<Dual> spot(const ContactPointId& id, const PoseOf<Dual>& X_AB) const = 0;
  /// Every spot that there may be, where each of them has its own place: of corners that deform.
  virtual void find_all(std::vector<ContactPointId>& found) const { (void)found; }
  /// Smallest gap of all spots [m], touching or not.
  [[nodiscard]] virtual double smallest_gap(const Pose& X_AB) = 0;
  /// Whether a spot's weight is an area.
  [[nodiscard]] virtual bool weighs_area() const { return false; }
};

/// Passes both number types on to the derived class's template `at`.
template <class Derived>
class ContactSearchOf : public ContactSearch {
 public:
  [[nodiscard]] ContactPoint<double> spot(const ContactPointId& id, const PoseOf<double>& X_AB) const override {
    return static_cast<const Derived&>(*this).template at<double>(id, X_AB);
  }
  [[nodiscard]] ContactPoint<Dual> spot(const ContactPointId& id, const PoseOf<Dual>& X_AB) const override {
    return static_cast<const Derived&>(*this).template at<Dual>(id, X_AB);
  }
};

/// A pose without derivatives.
[[nodiscard]] inline PoseOf<double> plain_pose(const Pose& X) { return {X.R.col(0), X.R.col(1), X.R.col(2), X.r}; }

/// The spot between a ball on one body and a surface on the other.
/// @param on_b      the ball is on B, its surface's partner on A; else the other way round
/// @param centre    of the ball, in its own body's frame
/// @param distance  gives distance and normal of a point in the surface's frame
template <class T, class Distance>
ContactPoint<T> ball_spot(bool on_b, const Vector3& centre, double radius, double weight, const PoseOf<T>& X_AB,
                          Distance distance) {
  const Vec3<T> own = constant<T>(centre);
  const auto seen = distance(on_b ? X_AB.place(own) : X_AB.place_back(own));
  const T middle = T(0.5) * (seen.distance + T(radius));
  if (on_b)
    return {seen.distance - T(radius), seen.normal, Vec3<T>(X_AB.place(own) - scaled(middle, seen.normal)), T(weight)};
  const Vec3<T> normal = -X_AB.turn(seen.normal);
  return {seen.distance - T(radius), normal, Vec3<T>(own + scaled(middle, normal)), T(weight)};
}

/// The finder for a pair of shapes; null if the pair is not supported.
[[nodiscard]] std::unique_ptr<ContactSearch> make_spot_finder(const ShapeGeometry& a, const ShapeGeometry& b);

// Those it chooses from. `on_b`: the first shape is on body B.
[[nodiscard]] std::unique_ptr<ContactSearch> balls_on_solid(std::vector<Sphere> balls, ShapeGeometry solid, bool on_b);
[[nodiscard]] std::unique_ptr<ContactSearch> rims_on_plane(const Cylinder& cylinder, const HalfSpace& plane, bool on_b);
[[nodiscard]] std::unique_ptr<ContactSearch> capsule_on_capsule(const Capsule& a, const Capsule& b);
[[nodiscard]] std::unique_ptr<ContactSearch> ball_on_mesh(const Sphere& ball, std::shared_ptr<const TriangleMesh> mesh,
                                                          bool on_b);
[[nodiscard]] std::unique_ptr<ContactSearch> corners_on_solid(std::shared_ptr<const TriangleMesh> mesh,
                                                              ShapeGeometry solid, bool on_b);

}  // namespace hersey::mbd
