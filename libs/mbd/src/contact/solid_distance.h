#pragma once

#include <algorithm>
#include <array>

#include "contact/dual.h"
#include "hersey/mbd/shape.h"

namespace hersey::mbd {

// Signed distance of a point from the surface of a solid, in the solid's body frame, for T = double or Dual; negative
// inside (theory manual eq. (contact.2)). Exact; its gradient is the normal.

template <class T>
struct SurfaceDistance {
  T distance;
  Vec3<T> normal;  ///< unit vector, outwards
};

/// Returns the distance from a point.
template <class T>
SurfaceDistance<T> distance_from(const Vec3<T>& from, const Vec3<T>& p) {
  const Vec3<T> r = p - from;
  const T l = length(r);
  if (value_of(l) == 0) return {T(0.0), constant<T>(Vector3::UnitZ())};
  return {l, scaled(T(1.0) / l, r)};
}

template <class T>
SurfaceDistance<T> distance_from(const HalfSpace& plane, const Vec3<T>& p) {
  const Vec3<T> n = constant<T>(plane.normal);
  return {dot(n, Vec3<T>(p - constant<T>(plane.point))), n};
}

template <class T>
SurfaceDistance<T> distance_from(const Sphere& ball, const Vec3<T>& p) {
  SurfaceDistance<T> distance = distance_from(constant<T>(ball.centre), p);
  distance.distance -= T(ball.radius);
  return distance;
}

/// Returns the parameter of the point of the segment from a to b that is nearest to p, 0..1.
template <class T>
T nearest_on_segment(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& p) {
  const Vec3<T> along = b - a;
  const T s = dot(along, Vec3<T>(p - a)) / dot(along, along);
  if (value_of(s) <= 0) return T(0.0);
  return value_of(s) >= 1 ? T(1.0) : s;
}

template <class T>
SurfaceDistance<T> distance_from(const Capsule& capsule, const Vec3<T>& p) {
  const Vec3<T> a = constant<T>(capsule.from), b = constant<T>(capsule.to);
  const Vec3<T> foot = a + scaled(nearest_on_segment(a, b, p), Vec3<T>(b - a));
  SurfaceDistance<T> distance = distance_from(foot, p);
  distance.distance -= T(capsule.radius);
  return distance;
}

template <class T>
SurfaceDistance<T> distance_from(const Cylinder& cylinder, const Vec3<T>& p) {
  using std::sqrt;
  const Vector3 axis = (cylinder.to - cylinder.from).normalized();
  const double half = 0.5 * (cylinder.to - cylinder.from).norm();
  const Vec3<T> n = constant<T>(axis), r = p - constant<T>(0.5 * (cylinder.from + cylinder.to));
  const T z = dot(n, r);
  const Vec3<T> radial = r - scaled(z, n);
  const bool on_axis = dot(radial, radial) <= T(0.0);
  const T rho = on_axis ? T(0.0) : length(radial);
  const Vec3<T> side = on_axis ? constant<T>(axis.unitOrthogonal()) : scaled(T(1.0) / rho, radial);
  const Vec3<T> end = z < T(0.0) ? Vec3<T>(-n) : n;
  const T over_side = rho - T(cylinder.radius), over_end = (z < T(0.0) ? -z : z) - T(half);
  if (over_side > T(0.0) && over_end > T(0.0)) {  // nearest to the rim
    const T distance = sqrt(over_side * over_side + over_end * over_end);
    return {distance, Vec3<T>(scaled(over_side / distance, side) + scaled(over_end / distance, end))};
  }
  if (over_side > over_end) return {over_side, side};
  return {over_end, end};
}

template <class T>
SurfaceDistance<T> distance_from(const Box& box, const Vec3<T>& p) {
  const Vec3<T> r = p - constant<T>(box.X_BS.r);
  const Vector3 half = 0.5 * box.size;
  std::array<T, 3> over;
  std::array<Vec3<T>, 3> face;
  int outside = 0, nearest = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3<T> axis = constant<T>(box.X_BS.R.col(i));
    const T x = dot(axis, r);
    over[i] = (x < T(0.0) ? -x : x) - T(half[i]);
    face[i] = x < T(0.0) ? Vec3<T>(-axis) : axis;
    if (over[i] > T(0.0)) ++outside;
    if (over[i] > over[nearest]) nearest = i;
  }
  if (outside <= 1) return {over[nearest], face[nearest]};
  Vec3<T> away = constant<T>(Vector3::Zero());
  for (int i = 0; i < 3; ++i)
    if (over[i] > T(0.0)) away += scaled(over[i], face[i]);
  const T distance = length(away);
  return {distance, scaled(T(1.0) / distance, away)};
}

}  // namespace hersey::mbd
