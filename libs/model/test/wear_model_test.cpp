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
