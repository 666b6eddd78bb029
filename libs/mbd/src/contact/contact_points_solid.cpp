// Contact points of smooth shapes: balls (spheres, ends of capsules, corners of boxes) on solids, cylinders on planes,
// capsules.
#include <algorithm>
#include <limits>

#include "contact/contact_points.h"
#include "contact/solid_distance.h"

namespace hersey::mbd {
namespace {

class BallsOnSolid final : public ContactSearchOf<BallsOnSolid> {
 public:
  BallsOnSolid(std::vector<Sphere> balls, ShapeGeometry solid, bool on_b)
      : balls_(std::move(balls)), solid_(std::move(solid)), on_b_(on_b) {}

  void find(const Pose& X_AB, std::vector<ContactPointId>& found) override {
    const PoseOf<double> X = plain_pose(X_AB);
    for (int i = 0; i < static_cast<int>(balls_.size()); ++i)
      if (at<double>({0, i, 0}, X).gap < 0) found.push_back({0, i, 0});
  }

  double smallest_gap(const Pose& X_AB) override {
    const PoseOf<double> X = plain_pose(X_AB);
    double gap = std::numeric_limits<double>::infinity();
    for (int i = 0; i < static_cast<int>(balls_.size()); ++i) gap = std::min(gap, at<double>({0, i, 0}, X).gap);
    return gap;
  }

  template <class T>
  [[nodiscard]] ContactPoint<T> at(const ContactPointId& id, const PoseOf<T>& X) const {
    const Sphere& ball = balls_[id.index];
    const auto distance = [&](const Vec3<T>& p) {
      if (const auto* plane = std::get_if<HalfSpace>(&solid_)) return distance_from(*plane, p);
      if (const auto* sphere = std::get_if<Sphere>(&solid_)) return distance_from(*sphere, p);
      if (const auto* capsule = std::get_if<Capsule>(&solid_)) return distance_from(*capsule, p);
      if (const auto* cylinder = std::get_if<Cylinder>(&solid_)) return distance_from(*cylinder, p);
      return distance_from(std::get<Box>(solid_), p);
    };
    return ball_contact_point(on_b_, ball.centre, ball.radius, 1, X, distance);
  }

 private:
  std::vector<Sphere> balls_;
  ShapeGeometry solid_;
  bool on_b_;
};

// Each rim touches in its lowest point and the three at multiples of 90 degrees from it: the lowest alone carries a
// lying cylinder, all four together a standing one, and the sum hardly depends on where on the rim they are
// (contact.3).
class RimsOnPlane final : public ContactSearchOf<RimsOnPlane> {
 public:
  RimsOnPlane(const Cylinder& cylinder, const HalfSpace& plane, bool on_b)
      : cylinder_(cylinder), plane_(plane), axis_((cylinder.to - cylinder.from).normalized()), on_b_(on_b) {}

  void find(const Pose& X_AB, std::vector<ContactPointId>& found) override {
    visit(X_AB, [&](const ContactPointId& id, double gap) {
      if (gap < 0) found.push_back(id);
    });
  }

  double smallest_gap(const Pose& X_AB) override {
    double smallest = std::numeric_limits<double>::infinity();
    visit(X_AB, [&](const ContactPointId&, double gap) { smallest = std::min(smallest, gap); });
    return smallest;
  }

  template <class T>
  [[nodiscard]] ContactPoint<T> at(const ContactPointId& id, const PoseOf<T>& X) const {
    // All in the cylinder's own frame.
    const Vec3<T> normal = on_b_ ? X.inverse_rotate(constant<T>(plane_.normal)) : X.rotate(constant<T>(plane_.normal));
    const Vec3<T> on_plane =
        on_b_ ? X.inverse_transform(constant<T>(plane_.point)) : X.transform(constant<T>(plane_.point));
    const Vec3<T> axis = constant<T>(axis_);
    const Vec3<T> down = scaled(dot(axis, normal), axis) - normal;
    const T tilt = value_of(dot(down, down)) > kUpright * kUpright ? length(down) : T(0.0);
    Vec3<T> e = tilt > T(0.0) ? scaled(T(1.0) / tilt, down) : constant<T>(axis_.unitOrthogonal());
    if (id.part % 2 == 1) e = cross(axis, e);
    if (id.part >= 2) e = -e;
    const Vec3<T> p = constant<T>(id.index == 0 ? cylinder_.from : cylinder_.to) + scaled(T(cylinder_.radius), e);
    const T gap = dot(normal, Vec3<T>(p - on_plane));
    const Vec3<T> middle = p - scaled(T(0.5) * gap, normal);
    if (on_b_) return {gap, X.rotate(normal), X.transform(middle), T(1.0)};
    return {gap, Vec3<T>(-normal), middle, T(1.0)};
  }

 private:
  /// Below this sine of the tilt the direction to the lowest point is round-off.
  static constexpr double kUpright = 1e-7;

  template <class Visit>
  void visit(const Pose& X_AB, Visit see) const {
    const PoseOf<double> X = plain_pose(X_AB);
    for (int end = 0; end < 2; ++end)
      for (int part = 0; part < 4; ++part) {
        const ContactPointId id{0, end, part};
        see(id, at<double>(id, X).gap);
      }
  }

  Cylinder cylinder_;
  HalfSpace plane_;
  Vector3 axis_;
  bool on_b_;
};

/// 0 below `low`, 1 above `high`, twice differentiable between.
template <class T>
T smooth_step(const T& x, double low, double high) {
  if (x <= T(low)) return T(0.0);
  if (x >= T(high)) return T(1.0);
  const T s = (x - T(low)) / T(high - low);
  return s * s * s * (s * (s * T(6.0) - T(15.0)) + T(10.0));
}

template <class T>
T clamped(const T& s) {
  return s < T(0.0) ? T(0.0) : s > T(1.0) ? T(1.0) : s;
}

// Crossed capsules touch in one point, parallel ones in two, the ends of the length that they share, with half the
// weight each; between 1 and 4 degrees the weights blend.
class CapsuleOnCapsule final : public ContactSearchOf<CapsuleOnCapsule> {
 public:
  CapsuleOnCapsule(const Capsule& a, const Capsule& b) : a_(a), b_(b) {}

  void find(const Pose& X_AB, std::vector<ContactPointId>& found) override {
    const PoseOf<double> X = plain_pose(X_AB);
    for (int kind = 0; kind < 3; ++kind)
      if (const ContactPoint<double> s = at<double>({kind, 0, 0}, X); s.gap < 0 && s.weight > 0)
        found.push_back({kind, 0, 0});
  }

  double smallest_gap(const Pose& X_AB) override {
    const PoseOf<double> X = plain_pose(X_AB);
    double gap = std::numeric_limits<double>::infinity();
    for (int kind = 0; kind < 3; ++kind)
      if (const ContactPoint<double> s = at<double>({kind, 0, 0}, X); s.weight > 0) gap = std::min(gap, s.gap);
    return gap;
  }

  template <class T>
  [[nodiscard]] ContactPoint<T> at(const ContactPointId& id, const PoseOf<T>& X) const {
    const Vec3<T> a = constant<T>(a_.from), along_a = constant<T>(a_.to - a_.from);
    const Vec3<T> b = X.transform(constant<T>(b_.from)), along_b = X.rotate(constant<T>(b_.to - b_.from));
    const T aa = dot(along_a, along_a), bb = dot(along_b, along_b), ab = dot(along_a, along_b);
    const T sine2 = T(1.0) - ab * ab / (aa * bb);
    const T crossed = smooth_step(sine2, kParallel * kParallel, kCrossed * kCrossed);
    if (id.kind == 0 && crossed > T(0.0)) {
      const T ca = dot(along_a, Vec3<T>(a - b)), cb = dot(along_b, Vec3<T>(a - b));
      T s = clamped((ab * cb - ca * bb) / (aa * bb - ab * ab));
      const T t = clamped((ab * s + cb) / bb);
      s = clamped((ab * t - ca) / aa);
      return between(Vec3<T>(a + scaled(s, along_a)), Vec3<T>(b + scaled(t, along_b)), crossed);
    }
    const T weight = id.kind == 0 ? T(0.0) : T(0.5) * (T(1.0) - crossed);
    const T s0 = dot(along_a, Vec3<T>(b - a)) / aa;
    const T s = clamped(id.kind == 1 ? s0 : s0 + ab / aa);
    const Vec3<T> foot = a + scaled(s, along_a);
    const T t = nearest_on_segment(b, Vec3<T>(b + along_b), foot);
    return between(foot, Vec3<T>(b + scaled(t, along_b)), weight);
  }

 private:
  static constexpr double kParallel = 0.0175, kCrossed = 0.0698;  ///< sines of 1 and 4 degrees

  template <class T>
  [[nodiscard]] ContactPoint<T> between(const Vec3<T>& on_a, const Vec3<T>& on_b, const T& weight) const {
    const SurfaceDistance<T> between_axes = distance_from(on_a, on_b);
    const T gap = between_axes.distance - T(a_.radius + b_.radius);
    return {gap, between_axes.normal, Vec3<T>(on_a + scaled(T(a_.radius) + T(0.5) * gap, between_axes.normal)), weight};
  }

  Capsule a_, b_;
};

}  // namespace

std::unique_ptr<ContactSearch> balls_on_solid(std::vector<Sphere> balls, ShapeGeometry solid, bool on_b) {
  return std::make_unique<BallsOnSolid>(std::move(balls), std::move(solid), on_b);
}

std::unique_ptr<ContactSearch> rims_on_plane(const Cylinder& cylinder, const HalfSpace& plane, bool on_b) {
  return std::make_unique<RimsOnPlane>(cylinder, plane, on_b);
}

std::unique_ptr<ContactSearch> capsule_on_capsule(const Capsule& a, const Capsule& b) {
  return std::make_unique<CapsuleOnCapsule>(a, b);
}

}  // namespace hersey::mbd
