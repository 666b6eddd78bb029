#include <fmt/format.h>

#include "hersey/model/build.h"
#include "model_text.h"

// Beams in the model file: their values, their division, and the faults reported for wrong ones.
namespace hersey::model {
namespace beam_test {

constexpr double kRoundOff = 1e-15;    // of lengths of 0.1 m in mm
constexpr double kSevenDigits = 1e-6;  // of the area written here

const std::string kMachine = R"(hersey: 1
title: Beam
bodies:
  shaft:
    beam:
      points: [10 0 0 mm, 110 0 0 mm, 110 0 200 mm]
      section: {circle: {diameter: 20 mm, bore: 10 mm}}
      up: y
      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}
      elements: 6
      damping: {stiffness: 2 us}
    frames:
      left: {along: start}
      disc: {along: 130 mm, rotation: {axis: x, angle: 90 deg}}
      right: {along: end}
joints:
  hinge: {type: revolute, between: [ground, shaft.left]}
simulation: {duration: 1 ms, step: 0.1 ms}
)";

std::string faults_with(const std::string& from, const std::string& to) {
  return faults_of(edited(kMachine, from, to));
}

TEST_CASE("Beam_IsReadAndDividedAtItsPointsAndFrames") {
  const Model model = read_text(kMachine, "m.yaml");
  REQUIRE(model.bodies[0].beam);
  const Beam& beam = *model.bodies[0].beam;
  // 100 mm to the bend, 30 to the disc, 170 to the end; about 50 mm each.
  const std::vector<Vector3> nodes = {
      {0, 0, 0},    {0.05, 0, 0}, {0.1, 0, 0}, {0.1, 0, 0.03}, {0.1, 0, 0.03 + 0.17 / 3}, {0.1, 0, 0.03 + 0.34 / 3},
      {0.1, 0, 0.2}};
  REQUIRE(beam.nodes.size() == nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) CHECK((beam.nodes[i] - nodes[i]).norm() < kRoundOff);
  CHECK((beam.axes[0] - (Matrix3() << 1, 0, 0, 0, 0, 1, 0, 1, 0).finished() * Vector3(1, -1, 1).asDiagonal()).norm() <
        1e-15);
  CHECK((beam.axes[5].col(0) - Vector3::UnitZ()).norm() < kRoundOff);
  CHECK(beam.section.area == doctest::Approx(235.6194e-6).epsilon(kSevenDigits));
  CHECK(beam.damping == 2e-6);
  const std::vector<Frame>& frames = model.bodies[0].frames;
  CHECK(frames[0].nodes == std::vector<int>{0});
  CHECK(frames[1].nodes == std::vector<int>{3});
  CHECK(frames[2].nodes == std::vector<int>{6});
}

TEST_CASE("Beam_IsBuiltFromSegmentsBetweenNodes") {
  const Machine machine = build(read_text(kMachine, "m.yaml"));
  REQUIRE(machine.beams.size() == 1);
  const BuiltBeam& beam = machine.beams[0];
  CHECK(beam.segments.size() == 6);
  CHECK(beam.is_named == std::vector<bool>{true, false, false, true, false, false, true});
  double mass = 0;
  for (const auto& segment : beam.segments) mass += segment->mass();
  CHECK(mass == doctest::Approx(7850 * 235.6194e-6 * 0.3).epsilon(kSevenDigits));
  CHECK(machine.mechanism->nv() == 1 + 6 * 6);
  const mbd::MechanismSpec& spec = machine.mechanism->spec();
  CHECK(spec.bodies[static_cast<std::size_t>(beam.ids.bodies[3].index)].name == "shaft.disc");
  CHECK(spec.bodies[static_cast<std::size_t>(beam.ids.bodies[4].index)].name == "shaft.node 5");
}

TEST_CASE("BeamInertia_MayBeGivenApartFromItsStiffness") {
  const std::string given =
      "damping: {stiffness: 2 us}\n      inertia: {mass_per_length: 3 kg/m, yy: 2e-3 kg.m, zz: 1e-3 kg.m}";
  const std::string text = edited(kMachine, "damping: {stiffness: 2 us}", given);
  const Beam& beam = *read_text(text, "m.yaml").bodies[0].beam;
  CHECK(beam.mass_per_length == 3);
  CHECK((beam.inertia_per_length - Vector3(3e-3, 2e-3, 1e-3)).norm() < kRoundOff);
  CHECK(beam.section.area == doctest::Approx(235.6194e-6).epsilon(kSevenDigits));
  double mass = 0;
  const Machine machine = build(read_text(text, "m.yaml"));
  for (const auto& segment : machine.beams[0].segments) mass += segment->mass();
  CHECK(mass == doctest::Approx(3 * 0.3));
  CHECK(contains(faults_of(edited(text, "zz: 1e-3 kg.m", "zz: 1e-3 kg.m, xx: 0.9e-3 kg.m")),
                 "moments of inertia 0.0009, 0.002 and 0.001 kg.m about x, y and z; expected each at most the sum"));
}

TEST_CASE("RotaryInertia_MayBeGivenApartFromSecondMomentsOfArea") {
  const std::string circle = "{circle: {diameter: 20 mm, bore: 10 mm}}";
  const auto with = [&](const std::string& rotary) {
    return edited(kMachine, circle, "{circle: {diameter: 20 mm, bore: 10 mm}, rotary_inertia: " + rotary + "}");
  };
  const Beam own = *read_text(kMachine, "m.yaml").bodies[0].beam;
  const Beam given = *read_text(with("{yy: 2e-3 kg.m, zz: 1e-3 kg.m}"), "m.yaml").bodies[0].beam;
  CHECK(given.mass_per_length == own.mass_per_length);
  CHECK(given.section.I_y == own.section.I_y);
  CHECK((given.inertia_per_length - Vector3(3e-3, 2e-3, 1e-3)).norm() < kRoundOff);
  // Values that equal those of the section itself change nothing.
  const double yy = own.inertia_per_length.y();
  const Beam same =
      *read_text(with(fmt::format("{{yy: {0:.17g} kg.m, zz: {0:.17g} kg.m}}", yy)), "m.yaml").bodies[0].beam;
  CHECK(same.inertia_per_length == own.inertia_per_length);
  CHECK(contains(faults_of(with("{yy: 2e-3 kg.m, zz: 1e-3 kg.m, xx: 0.9e-3 kg.m}")),
                 "bodies.shaft.beam.section.rotary_inertia: moments of inertia 0.0009, 0.002 and 0.001 kg.m"));
  CHECK(contains(faults_of(edited(with("{yy: 2e-3 kg.m, zz: 1e-3 kg.m}"), "damping: {stiffness: 2 us}",
                                  "inertia: {mass_per_length: 3 kg/m, yy: 2e-3 kg.m, zz: 1e-3 kg.m}")),
                 "`rotary_inertia` of a section beside `inertia` of the beam; expected one of them"));
}

TEST_CASE("BeamAlongZ_NeedsNoUp") {
  const Model model = read_text(
      edited(edited(kMachine, "10 0 0 mm, 110 0 0 mm, 110 0 200 mm", "0 0 0 mm, 0 0 200 mm"), "      up: y\n", ""),
      "m.yaml");
  CHECK((model.bodies[0].beam->axes[0].col(2) - Vector3::UnitX()).norm() < kRoundOff);
}

TEST_CASE("Beam_FaultsNameTheAlternatives") {
  CHECK(contains(faults_with("[10 0 0 mm, 110 0 0 mm, 110 0 200 mm]", "[10 0 0 mm]"),
                 "m.yaml:6:15: bodies.shaft.beam.points: a beam with one point"));
  CHECK(contains(faults_with("110 0 0 mm,", "10 0 0 mm,"), "the position of the point before it"));
  CHECK(contains(faults_with("bore: 10 mm", "bore: 20 mm"), "a bore of 20 mm"));
  CHECK(contains(faults_with("circle: {diameter", "circel: {diameter"), "circle"));
  CHECK(contains(faults_with("{circle: {diameter: 20 mm, bore: 10 mm}}",
                             "{circle: {diameter: 20 mm}, rectangle: {width: 1 mm, height: 1 mm}}"),
                 "bodies.shaft.beam.section"));
  CHECK(contains(faults_with("up: y", "up: x"), "bodies.shaft.beam.up: a beam that runs along the section's z-axis"));
  CHECK(contains(faults_with("130 mm", "400 mm"),
                 "bodies.shaft.frames.disc.along: a position 400 mm along a beam of 300 mm"));
  CHECK(contains(faults_with("130 mm", "ende"), "bodies.shaft.frames.disc.along"));
  CHECK(contains(faults_with("{along: end}", "{}"), "a frame of a beam without `along`"));
  CHECK(contains(faults_with("{along: end}", "{along: end, origin: 1 0 0 mm}"), "`origin` of a frame on a beam"));
  CHECK(contains(faults_with("{along: end}", "{along: end, nodes: tip}"), "`nodes` of a frame"));
  CHECK(
      contains(faults_with("    frames:", "    centre_of_mass: 1 0 0 mm\n    frames:"), "`centre_of_mass` of a beam"));
  CHECK(contains(faults_with("    frames:", "    shapes: {ball: {shape: sphere, diameter: 1 mm}}\n    frames:"),
                 "`shapes` of a beam"));
  CHECK(contains(faults_with("    beam:", "    mass: 1 kg\n    beam:"), "bodies.shaft"));
  CHECK(contains(faults_with("density: 7850 kg/m^3", "density: 7850 kg"), "bodies.shaft.beam.material.density"));
  CHECK(contains(faults_of(edited(good_model, "{origin: 0 50 0 mm,", "{along: start, origin: 0 50 0 mm,")),
                 "`along` of a frame on a body that is no beam"));
}

}  // namespace beam_test
}  // namespace hersey::model
