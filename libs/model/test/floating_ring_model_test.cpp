#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "hersey/model/read.h"

// A floating ring from the model file: the parts that it is spelt out in, and what may be wrong with it.
namespace hersey::model {
namespace floating_ring_model_test {

std::string ring_machine(const std::string& ring, const std::string& outer = "17 mm", const std::string& more = "") {
  return R"(hersey: 1
lubricants: {oil: {viscosity: 20 mPa.s}, warm: {viscosity: 10 mPa.s}}
bodies:
  rotor: {mass: 1 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
joints: {turning: {type: planar, between: [ground, rotor], axis: z}}
drives: {motor: {joint: turning, coordinate: rotation, speed: -3000 rpm}}
bearings:
  front:
    kind: floating_ring
    shell: ground
    journal: rotor
    lubricant: oil
    cavitation: guembel
    inner: {diameter: 11 mm, width: 7 mm, radial_clearance: 20 um, lubricant: warm}
    outer: {width: 9 mm, radial_clearance: 40 um, diameter: )" +
         outer + "}\n    ring: " + ring + "\n" + more + "simulation: {analysis: steady}\n";
}

std::string ring_faults_of(const std::string& text) {
  try {
    (void)read_text(text, "m.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

void check_ring_fault(const std::string& text, const std::string& expected) {
  const std::string found = ring_faults_of(text);
  CAPTURE(found);
  CHECK(found.find(expected) != std::string::npos);
}

TEST_CASE("FloatingRing_ReadsAsItsPartsWrittenByHand") {
  const std::string path = "floating_ring_model_test.yaml";
  const std::string given = ring_machine("{density: 8000 kg/m^3, centring_stiffness: 1e5 N/m}");
  std::ofstream(path) << given;
  const Model by_hand = read_text(expanded_text(path, {}), path);
  std::filesystem::remove(path);
  const Model model = read_text(given, path);
  REQUIRE(model.composites.size() == 1);
  CHECK(by_hand.composites.empty());
  for (const Model* each : {&model, &by_hand}) {
    REQUIRE(each->bearings.size() == 2);
    CHECK(each->bearings[0].name == "front_inner");
    CHECK(each->bearings[0].lubricant == "warm");
    CHECK(each->bearings[1].lubricant == "oil");
    CHECK(each->forces.size() == 1);
    // A ring of bronze, 11 to 16.92 mm and as wide as the wider film.
    const double r = 5.5e-3, R = 8.46e-3, mass = 8000 * std::numbers::pi * (R * R - r * r) * 9e-3;
    const Body& ring = each->bodies.at(1);
    CHECK(ring.name == "front_ring");
    CHECK(ring.mass == doctest::Approx(mass).epsilon(1e-12));                                 // round-off
    CHECK(ring.inertia(2, 2) == doctest::Approx(mass * (R * R + r * r) / 2).epsilon(1e-12));  // likewise
    const double across = mass * (3 * (R * R + r * r) + 81e-6) / 12;
    CHECK(ring.inertia(0, 0) == doctest::Approx(across).epsilon(1e-12));  // likewise
    // It begins at a quarter of the drive's speed.
    CHECK(each->joints.at(1).initial.at(0).value.at(0) ==
          doctest::Approx(-25 * std::numbers::pi).epsilon(1e-12));  // likewise
  }
}

TEST_CASE("FaultsOfAFloatingRing_NameWhatTheFileSays") {
  CHECK(ring_faults_of(ring_machine("{}")) == "no fault");
  check_ring_fault(ring_machine("{}", "11 mm"),
                   "m.yaml:15:61: bearings.front.outer.diameter: 11 mm, in which a ring of that bore has no wall; "
                   "expected more than 11.08 mm");
  check_ring_fault(
      ring_machine("{rotation: locked}", "17 mm", "    operating_point: {journal_speed: 1 rpm, load: 1 N}\n"),
      "bearings.front.ring.rotation: a locked ring under a load, which sinks through its outer film");
  check_ring_fault(ring_machine("{}", "-17 mm"), "bearings.front.outer.diameter");
  check_ring_fault(ring_machine("{}", "17 mm", "    operating_point: {journal_speed: 0 rpm, load: 1 N}\n"),
                   "a journal at rest");
  std::string wrong = ring_machine("{}");
  wrong.replace(wrong.find("lubricant: warm"), 15, "lubricant: worm");
  check_ring_fault(wrong, "m.yaml:14:79: bearings.front.inner.lubricant: unknown lubricant 'worm'");
  wrong = ring_machine("{}");
  wrong.replace(wrong.find("lubricant: oil"), 14, "lubricant: ohl");
  check_ring_fault(wrong, "bearings.front.lubricant: unknown lubricant 'ohl'");
}

}  // namespace floating_ring_model_test
}  // namespace hersey::model
