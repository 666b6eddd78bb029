#pragma once

#include <cmath>
#include <numbers>

#include "hersey/bearing/coordinates.h"

namespace hersey::bearing {

/// Returns the angle from `a` to `b`, from x towards y [rad]; of two numbers 0, or pi if their signs differ.
[[nodiscard]] inline double angle_between(const Coordinates& a, const Coordinates& b) {
  if (a.size() != 2) return a.dot(b) < 0 ? std::numbers::pi : 0;
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

}  // namespace hersey::bearing
