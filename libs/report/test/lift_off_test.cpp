#include "lift_off.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace hersey::report {
namespace lift_off_test {

/// A journal that goes up to 10 rad/s and down again in equal steps.
std::vector<double> up_and_down(int steps) {
  std::vector<double> speed;
  for (int k = 0; k <= 2 * steps; ++k) speed.push_back(10.0 * (k <= steps ? k : 2 * steps - k) / steps);
  return speed;
}

/// Contact that carries all at rest and less in proportion to speed: 5 % at `up` [rad/s] on the way up, at `down` on
/// the way down.
std::vector<double> contact(const std::vector<double>& speed, double up, double down) {
  std::vector<double> part;
  for (std::size_t k = 0; k < speed.size(); ++k)
    part.push_back(1 - 0.95 * speed[k] / (2 * k < speed.size() ? up : down));
  return part;
}

// Values pass through a few sums and products.
constexpr double kRounding = 1e-12;

TEST_CASE("LiftOffAndTouchDown_AreWhereContactCrossesItsPart_WhateverTheRows") {
  for (const int steps : {7, 50, 333}) {
    CAPTURE(steps);
    const std::vector<double> speed = up_and_down(steps);
    const LiftOffs found = find_lift_offs(speed, contact(speed, 3.21, 1.17));
    REQUIRE(found.lift_off);
    REQUIRE(found.touch_down);
    CHECK(found.lift_off->speed == doctest::Approx(3.21).epsilon(kRounding));
    CHECK(found.touch_down->speed == doctest::Approx(1.17).epsilon(kRounding));
    CHECK(speed[found.lift_off->row] >= 3.21);
    CHECK(speed[found.touch_down->row] <= 1.17);
  }
}

TEST_CASE("SenseOfRotation_ChangesNoLiftOff") {
  std::vector<double> speed = up_and_down(50);
  const std::vector<double> part = contact(speed, 3.21, 1.17);
  const LiftOffs forwards = find_lift_offs(speed, part);
  for (double& v : speed) v = -v;
  const LiftOffs backwards = find_lift_offs(speed, part);
  CHECK(backwards.lift_off->speed == forwards.lift_off->speed);
  CHECK(backwards.touch_down->speed == forwards.touch_down->speed);
}

TEST_CASE("OfSeveralLiftOffs_TheFastestCounts") {
  std::vector<double> speed = up_and_down(50), part = contact(speed, 3, 1);
  const std::vector<double> again = speed, more = contact(speed, 4, 0.5);
  speed.insert(speed.end(), again.begin(), again.end());
  part.insert(part.end(), more.begin(), more.end());
  const LiftOffs found = find_lift_offs(speed, part);
  CHECK(found.lift_off->speed == doctest::Approx(4).epsilon(kRounding));
  CHECK(found.touch_down->speed == doctest::Approx(1).epsilon(kRounding));
}

TEST_CASE("JournalThatNeitherStartsNorStops_HasNoLiftOff") {
  std::vector<double> speed = up_and_down(50);
  const std::vector<double> part = contact(speed, 3, 3);
  for (double& v : speed) v += 2;
  CHECK(!find_lift_offs(speed, part).lift_off);
  for (double& v : speed) v -= 7;  // it swings
  CHECK(!find_lift_offs(speed, part).lift_off);
  CHECK(!find_lift_offs({}, {}).touch_down);
}

}  // namespace lift_off_test
}  // namespace hersey::report
