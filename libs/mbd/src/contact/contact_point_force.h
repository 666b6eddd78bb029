#pragma once

#include <cmath>

#include "contact/contact_points.h"
#include "hersey/mbd/contact_law.h"

namespace hersey::mbd {

/// Normal and friction force of one contact point.
template <class T>
struct ContactPointForce {
  T normal;          ///< N >= 0 [N]
  Vec3<T> friction;  ///< on B [N]
};

/// Theory manual eqs. (contact.6) to (contact.8).
/// @param velocity  of B's material relative to A's at the contact point, A's axes
template <class T>
ContactPointForce<T> contact_point_force(const ContactLaw& law, const ContactPoint<T>& point, const Vec3<T>& velocity) {
  using std::pow;
  using std::sqrt;
  ContactPointForce<T> force{T(0.0), constant<T>(Vector3::Zero())};
  if (!(point.gap < T(0.0))) return force;
  const T rate = -dot(point.normal, velocity);  // of penetration
  const T damped = T(1.0) + T(law.damping) * rate;
  if (damped <= T(0.0)) return force;  // no adhesion
  force.normal = point.weight * T(law.stiffness) * pow(-point.gap, law.exponent) * damped;
  if (law.friction > 0) {
    const Vec3<T> slip = velocity + scaled(rate, point.normal);
    const T speed = sqrt(dot(slip, slip) + T(law.slip_speed * law.slip_speed));
    force.friction = scaled(-(T(law.friction) * force.normal / speed), slip);
  }
  return force;
}

}  // namespace hersey::mbd
