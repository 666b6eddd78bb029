#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/build.h"
#include "hersey/run/simulate.h"
#include "small_rig.h"
#include "start/start.h"

namespace hersey::run {
namespace assembly_test {

/// Crank of 0.3 m, coupler of 0.5 m, rocker of 0.4 m; the closing ball `right` joins coupler and rocker.
std::string four_bar(const std::string& distance, const std::string& initial) {
  return R"(hersey: 1
bodies:
  ground: {frames: {far: {origin: )" +
         distance + R"( 0 0 m}}}
  crank: {mass: 1 kg, inertia: {xx: 0.1 kg.m^2, yy: 0.1 kg.m^2, zz: 0.1 kg.m^2}, frames: {tip: {origin: 0.3 0 0 m}}}
  coupler: {mass: 1 kg, inertia: {xx: 0.1 kg.m^2, yy: 0.1 kg.m^2, zz: 0.1 kg.m^2}, frames: {tip: {origin: 0.5 0 0 m}}}
  rocker: {mass: 1 kg, inertia: {xx: 0.1 kg.m^2, yy: 0.1 kg.m^2, zz: 0.1 kg.m^2}, frames: {tip: {origin: 0.4 0 0 m}}}
joints:
  a: {type: revolute, between: [ground, crank], initial: {rotation: )" +
         initial + R"( deg}}
  b: {type: cylindrical, between: [crank.tip, coupler]}
  c: {type: revolute, between: [ground.far, rocker]}
  right: {type: spherical, between: [coupler.tip, rocker.tip]}
simulation: {duration: 1 s, step: 1 ms}
)";
}

TEST_CASE("LoopThatCannotClose_SaysWhichJointIsHowFarOff") {
  // Stretched towards each other the links of 0.3, 0.5 and 0.4 m span 1.2 of 2 m.
  const std::string links = four_bar("2", "70");
  std::string hinges = links;  // which constrain some motions several times
  hinges.replace(hinges.find("cylindrical"), 11, "revolute").replace(hinges.find("spherical"), 9, "revolute");
  for (const std::string& text : {links, hinges}) {
    try {
      check(rig(text));
      FAIL("the loop closed");
    } catch (const InputError& error) {
      const Fault& fault = error.faults().front();
      CAPTURE(fault.text());
      CHECK(fault.path == "joints.right");
      CHECK(fault.found.find("joint right is 800 mm apart") != std::string::npos);
      const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(text.find("  right:")), '\n');
      CHECK(fault.position.line == line);
    }
  }
}

TEST_CASE("RoughGuess_IsAssembledWithTheGivenCoordinateFixed") {
  // From coupler and rocker both lying along x, whatever the crank's angle.
  for (const char* angle : {"0", "40", "90", "135", "150", "-120"}) {
    CAPTURE(std::string(angle));
    const model::Model model = rig(four_bar("0.6", angle));
    model::Machine machine = model::build(model);
    const solver::State state = starting_state(model, machine);
    const mbd::Observation observation = machine.mechanism->observe(state);
    // rtol of the start is 1e-12.
    CHECK(observation.joints[0].position[0] ==
          doctest::Approx(std::stod(angle) * std::numbers::pi / 180).epsilon(1e-12));
    const Vector3 gap =
        observation.bodies[2].X_WF * Vector3(0.5, 0, 0) - observation.bodies[3].X_WF * Vector3(0.4, 0, 0);
    CHECK(gap.norm() < 1e-11);  // rtol of the start is 1e-12
  }
}

TEST_CASE("GivenCoordinateOutOfReach_IsRefusedWithTheNearest") {
  // At 0.8 m the crank must point to the other side to within what coupler and rocker reach: 0.9 m; 180 deg is beyond.
  try {
    check(rig(four_bar("0.8", "180")));
    FAIL("the loop closed");
  } catch (const InputError& error) {
    const Fault& fault = error.faults().front();
    CAPTURE(fault.text());
    CHECK(fault.path == "joints.a.initial.rotation");
    CHECK(fault.position.line > 0);
    CHECK(fault.found.find("180 deg") != std::string::npos);
    CHECK(fault.found.find("joint right is 200 mm apart") != std::string::npos);
    CHECK(fault.expected.find("the nearest found has") != std::string::npos);
  }
}

}  // namespace assembly_test
}  // namespace hersey::run
