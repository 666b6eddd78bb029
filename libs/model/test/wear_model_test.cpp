#include <string>

#include "hersey/model/read.h"
#include "model_text.h"

// Wear of bearings in the model file.
namespace hersey::model {
namespace wear_model_test {

const std::string kBush = R"(hersey: 1
lubricants: {oil: {viscosity: 30 mPa.s}}
bearings:
  bush: {diameter: 50 mm, width: 25 mm, radial_clearance: 30 um, lubricant: oil,
         asperities: {model: greenwood_tripp_fit, roughness: 0.8 um, elastic_factor: 3e-3, composite_modulus: 110 GPa, friction: 0.1},
         wear: {shell: {coefficient: 2e-15 1/Pa, lining: 20 um}, acceleration: 1000, cycle: 40 ms},
         operating_point: {journal_speed: 120 rpm, load: 3 kN}}
)";

TEST_CASE("WearOfABearing_IsRead") {
  const auto wear = read_text(kBush, "m.yaml").bearings.front().wear;
  REQUIRE(wear);
  CHECK(wear->fixed.coefficient == 2e-15);
  CHECK(wear->fixed.lining == doctest::Approx(20e-6));
  CHECK(wear->moving.coefficient == 0);
  CHECK(wear->acceleration == 1000);
  CHECK(wear->cycle == doctest::Approx(0.04));
}

TEST_CASE("WearByWorkOfFriction_IsThatOfItsCoefficient") {
  const auto wear =
      read_text(edited(kBush, "coefficient: 2e-15 1/Pa", "energy_density: 5e13 J/m^3"), "m.yaml").bearings.front().wear;
  CHECK(wear->fixed.coefficient == doctest::Approx(0.1 / 5e13));
}

TEST_CASE("RunningIn_IsReadAsRatioOfRoughness") {
  const std::string text = edited(kBush, "cycle: 40 ms", "running_in: {roughness: 0.2 um, depth: 0.5 um}");
  const auto run_in = read_text(text, "m.yaml").bearings.front().wear->running_in;
  REQUIRE(run_in);
  CHECK(run_in->ratio == doctest::Approx(0.25));
  CHECK(run_in->depth == doctest::Approx(0.5e-6));
  CHECK_FALSE(read_text(kBush, "m.yaml").bearings.front().wear->running_in);
  const std::string fault = faults_of(edited(text, "roughness: 0.2 um", "roughness: 2 um"));
  CHECK(fault.find("run in from 0.8 um to 2 um") != std::string::npos);
  CHECK(fault.find("at most `asperities.roughness`") != std::string::npos);
}

TEST_CASE("WearAroundAJournal_IsReadAndPadsHaveNone") {
  const std::string local =
      edited(kBush, "acceleration: 1000", "journal: {coefficient: 1e-17 1/Pa, around: local}, acceleration: 1000");
  CHECK(read_text(local, "m.yaml").bearings.front().wear->around == bearing::WearAround::local);
  CHECK(read_text(edited(local, ", around: local", ""), "m.yaml").bearings.front().wear->around ==
        bearing::WearAround::even);
  CHECK(faults_of(edited(local, "around: local", "around: crank")).find("even or local") != std::string::npos);
  CHECK(faults_of(edited(kBush, "lining: 20 um", "around: local")).find("unknown key 'around'") != std::string::npos);
}

const std::string kPads = R"(hersey: 1
lubricants: {oil: {viscosity: 30 mPa.s}}
bearings:
  front: {kind: tilting_pad, diameter: 50 mm, width: 25 mm, radial_clearance: 30 um, lubricant: oil,
          pads: {count: 4, arc: 70 deg},
          asperities: {model: greenwood_tripp_fit, roughness: 0.8 um, elastic_factor: 3e-3, composite_modulus: 110 GPa},
          wear: {shell: {coefficient: 2e-15 1/Pa}, journal: {coefficient: 1e-17 1/Pa}},
          operating_point: {journal_speed: 120 rpm, load: 3 kN}}
)";

TEST_CASE("PadsWear_AndTheirJournalIsOneSurface") {
  const auto alone = read_text(kPads, "m.yaml").composites.front().alone;
  REQUIRE(alone);
  for (const Bearing& pad : alone->bearings) {
    REQUIRE(pad.wear);
    CHECK(pad.wear->fixed.coefficient == 2e-15);
    CHECK(pad.wear->moving.coefficient == 1e-17);
    CHECK(pad.worn_group == "front");
  }
  const std::string named = edited(kPads, "coefficient: 1e-17 1/Pa", "coefficient: 1e-17 1/Pa, group: shaft");
  CHECK(read_text(named, "m.yaml").composites.front().alone->bearings.front().worn_group == "shaft");
  CHECK(faults_of(edited(kPads, "1e-17 1/Pa}", "1e-17 1/Pa, around: crank}")).find("even or local") !=
        std::string::npos);
  CHECK(faults_of(edited(kPads, "shell: {coefficient", "shell: {group: a, coefficient")).find("unknown key 'group'") !=
        std::string::npos);
}

TEST_CASE("FilmsOfOneGroup_HaveOneSurface") {
  const std::string keys = R"(, radial_clearance: 30 um, lubricant: oil, asperities: {model: greenwood_tripp_fit,
         roughness: 0.8 um, elastic_factor: 3e-3, composite_modulus: 110 GPa}, )";
  const auto model = [&](const std::string& size, const std::string& wear) {
    return "hersey: 1\nlubricants: {oil: {viscosity: 30 mPa.s}}\nbearings:\n  a: {diameter: 50 mm, width: 25 mm" +
           keys +
           "arcs: {pad: {middle: 0 deg, arc: 100 deg}}, grid: {circumferential: 72}, "
           "wear: {journal: {coefficient: 1e-17 1/Pa, group: j, around: local}}}\n  b: {" +
           size + keys + "arcs: {pad: {middle: 180 deg, arc: 100 deg}}, " + wear + "}\n";
  };
  const std::string same = "diameter: 50 mm, width: 25 mm", grid = "grid: {circumferential: 72}, ";
  const auto worn = [](const std::string& more) { return "wear: {journal: {coefficient: 1e-17 1/Pa, group: j" + more; };
  CHECK(faults_of(model(same, grid + worn(", around: local}}"))) == "no fault");
  const auto finds = [&](const std::string& text, const std::string& what) {
    const std::string fault = faults_of(text);
    CAPTURE(fault);
    CHECK(fault.find("bearings.b.wear.journal.group: a film with " + what + " than bearing 'a' of that group") !=
          std::string::npos);
  };
  finds(model("diameter: 50 mm, width: 20 mm", grid + worn(", around: local}}")), "another size");
  finds(model(same, grid + worn("}}")), "another `around`");
  finds(model(same, grid + worn(", around: local}, acceleration: 2}")), "another `acceleration`");
  finds(model(same, "grid: {circumferential: 72, axial: 7}, " + worn(", around: local}}")), "other rows of its grid");
  finds(model(same, "grid: {circumferential: 90}, " + worn(", around: local}}")),
        "other distances of its grid's lines");
}

TEST_CASE("FaultsOfWear_SayWhatItNeeds") {
  const std::string asperities =
      "         asperities: {model: greenwood_tripp_fit, roughness: 0.8 um, elastic_factor: 3e-3, composite_modulus: "
      "110 "
      "GPa, friction: 0.1},\n";
  CHECK(faults_of(edited(kBush, asperities, "")).find("`wear` of surfaces that never touch") != std::string::npos);
  CHECK(
      faults_of(edited(kBush, "shell: {coefficient: 2e-15 1/Pa, lining: 20 um}, ", "")).find("`wear` of no surface") !=
      std::string::npos);
  CHECK(faults_of(edited(kBush, "lining: 20 um", "energy_density: 5e13 J/m^3")).find("energy_density") !=
        std::string::npos);
  const std::string without_friction = edited(kBush, "friction: 0.1", "friction: 0");
  CHECK(faults_of(edited(without_friction, "coefficient: 2e-15 1/Pa", "energy_density: 5e13 J/m^3"))
            .find("without friction") != std::string::npos);
}

}  // namespace wear_model_test
}  // namespace hersey::model
