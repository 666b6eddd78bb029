#include "start/bearing_axes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "edited.h"
#include "hersey/run/simulate.h"
#include "small_rig.h"

namespace hersey::run {
namespace bearing_axes_test {

/// The rig with a journal that a joint rotates in a shell fixed to ground.
std::string constrained(const std::string& axis) {
  std::string text = rig_with("between: [ground, rod], initial: {x: 0 um}", "between: [ground, rod], axis: z");
  const auto replace = [&](const std::string& old, const std::string& replacement) {
    text.replace(text.find(old), old.size(), replacement);
  };
  replace("type: planar, between: [ground, rod], axis: z", "type: fixed, between: [ground, rod]");
  replace("  hold: {joint: guide, coordinate: rotation, position: 0 deg}\n", "");
  replace("between: [ground, pin]", "between: [ground, pin], axis: " + axis);
  return text;
}

std::vector<std::string> axis_warnings_of(const std::string& text) {
  std::vector<std::string> warnings;
  for (const Fault& warning : check(rig(text)))
    if (warning.text().find("axis") != std::string::npos) warnings.push_back(warning.text());
  return warnings;
}

TEST_CASE("JointAcrossItsBearing_IsWarnedOf") {
  // The shell is ground's by a fixed joint: journal and shell are joined all the same.
  const std::vector<std::string> across = axis_warnings_of(constrained("x"));
  REQUIRE(across.size() == 1);
  CHECK(contains(across[0], "rig.yaml:10:"));
  CHECK(contains(across[0],
                 "joints.main.axis: the joint rotates the journal of bearing big_end about an axis 90 deg off"));
  CHECK(axis_warnings_of(constrained("z")).empty());
  CHECK(axis_warnings_of(constrained("0 0 -1")).empty());
  CHECK(axis_warnings_of(constrained("0 0.001 1")).empty());  // less than the clearance allows: 34 um on 15.6 mm
  CHECK(axis_warnings_of(constrained("0 0.02 1")).size() == 1);
}

TEST_CASE("RodThatAPlaneKeepsInItsGuide_IsNotWarnedOf") {
  const auto valve = [](const std::string& axis, const std::string& rates) {
    return R"(hersey: 1
lubricants: {oil: {viscosity: 10 mPa.s}}
bodies: {valve: {mass: 60 g, inertia: {xx: 5e-5 kg.m^2, yy: 5e-5 kg.m^2, zz: 5e-5 kg.m^2}}}
joints: {plane: {type: planar, between: [ground, valve], axis: )" +
           axis + ", initial: {" + rates + R"(}}}
bearings:
  guide: {shell: ground, journal: valve, diameter: 6 mm, width: 40 mm, radial_clearance: 20 um, lubricant: oil}
simulation: {duration: 10 ms, step: 0.05 ms}
)";
  };
  CHECK(axis_warnings_of(valve("y", "x_rate: 0 m/s")).empty());
  CHECK(axis_warnings_of(valve("0 0.707 0.707", "x_rate: 0 m/s")).size() == 1);  // rotates half across
  CHECK(axis_warnings_of(valve("y", "rotation_rate: 1000 rpm")).size() == 1);    // strikes the guide
}

TEST_CASE("JournalThatRotatesAcrossItsBearing_IsWarnedOf") {
  // No joint connects pin and rod; the pin's hinge on ground rotates it about x.
  const std::vector<std::string> warnings =
      axis_warnings_of(rig_with("between: [ground, pin]", "between: [ground, pin], axis: x"));
  REQUIRE(warnings.size() == 1);
  CHECK(contains(warnings[0],
                 "bearings.big_end: at the start the journal rotates across the bearing's axis, with 314 rad/s"));
  CHECK(axis_warnings_of(kSmallRig).empty());
}

}  // namespace bearing_axes_test
}  // namespace hersey::run
