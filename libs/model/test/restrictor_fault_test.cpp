#include <doctest/doctest.h>

#include <numbers>
#include <string>
#include <vector>

#include "hersey/film/film_model.h"
#include "hersey/model/read.h"
#include "model_text.h"

// Restrictors in the model file: what they read as, and where their faults are.
namespace hersey::model {
namespace restrictor_fault_test {

const std::string text = R"(hersey: 1
lubricants:
  oil: {grade: iso_vg_46, temperature: 40 degC}
bearings:
  main:
    diameter: 100 mm
    width: 80 mm
    radial_clearance: 50 um
    lubricant: oil
    features:
      recess:
        shape: pocket
        arc: 45 deg
        length: 50 mm
        pressure: 40 bar
        restrictor: {type: capillary, length: 40 mm, diameter: 0.6 mm}
    operating_point: {journal_speed: 0 rpm, load: 5 kN}
)";

std::string faults_with(const std::string& old, const std::string& replacement,
                        const std::vector<std::string>& overrides = {}) {
  try {
    (void)read_text(edited(text, old, replacement), "m.yaml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const film::Restrictor& restrictor_of(const Model& model) { return *model.bearings[0].film.features[0].restrictor; }

TEST_CASE("RestrictorWithoutASupply_IsAFaultAtItsLine") {
  CHECK(faults_with("        pressure: 40 bar\n", "")
            .find("m.yaml:15:9: bearings.main.features.recess.restrictor: a restrictor without a supply; expected "
                  "'pressure' of the supply before it") != std::string::npos);
  for (const char* other : {"{type: orifice, diameter: 0.5 mm}", "{type: resistance, resistance: 1e11 Pa.s/m^3}"})
    CHECK(
        faults_with("        pressure: 40 bar\n        restrictor: {type: capillary, length: 40 mm, diameter: 0.6 mm}",
                    std::string("        restrictor: ") + other)
            .find("a restrictor without a supply") != std::string::npos);
}

TEST_CASE("PumpOfConstantFlow_NeedsNoPressure") {
  const std::string pump = "{type: constant_flow, flow: 0.5 l/min}";
  const Model model = read_text(edited(edited(text, "        pressure: 40 bar\n", ""),
                                       "{type: capillary, length: 40 mm, diameter: 0.6 mm}", pump),
                                "m.yaml");
  CHECK(model.bearings[0].film.features[0].is_fed);
  CHECK_FALSE(restrictor_of(model).has_supply_pressure());
  const std::vector<std::string> is_pump{"bearings.main.features.recess.restrictor=" + pump};
  CHECK(restrictor_of(read_text(text, "m.yaml", is_pump)).flow(0.025 * 40e5).value ==  // half of the valve's 5 %
        doctest::Approx(0.25e-3 / 60));
  CHECK(faults_with("pressure: 40 bar", "pressure: {expression: \"40 + t\", unit: bar}", is_pump)
            .find("a limit of a pump that varies") != std::string::npos);
  CHECK(faults_with("pressure: 40 bar", "pressure: 0 bar", is_pump).find("a pump whose limit is no pressure") !=
        std::string::npos);
}

TEST_CASE("OtherFaultsOfRestrictors_AreReported") {
  CHECK(faults_with("diameter: 0.6 mm", "diameter: 0 mm").find("a length > 0") != std::string::npos);
  CHECK(faults_with("type: capillary", "type: capilary").find("did you mean 'capillary'?") != std::string::npos);
  CHECK(faults_with("length: 40 mm, ", "").find("length") != std::string::npos);
  CHECK(faults_with("    lubricant: oil\n", "    lubricant: oil\n    solver: sor\n").find("`sor` with restrictors") !=
        std::string::npos);
  // Two recesses with pressures of their own have room between them.
  CHECK(faults_with("    operating_point",
                    "      other: {shape: pocket, arc: 45 deg, angle: 30 deg, length: 50 mm, pressure: 40 bar}\n"
                    "    operating_point")
            .find("which has another pressure") != std::string::npos);
}

// The oil in a restrictor is as warm as its supply; a measured resistance is what it is.
TEST_CASE("OilOfARestrictor_IsAsWarmAsItsSupply") {
  const Model cold = read_text(text, "m.yaml");
  CHECK(restrictor_of(cold).oil.mu == cold.bearings[0].film.lubricant.mu0);
  const std::string film = "bearings.main.thermal={model: film, supply_temperature: 60 degC}";
  const Model warm = read_text(text, "m.yaml", {film});
  const Model hot = read_text(text, "m.yaml", {film, "bearings.main.features.recess.temperature=80 degC"});
  CHECK(restrictor_of(warm).oil.mu < restrictor_of(cold).oil.mu);
  CHECK(restrictor_of(hot).oil.mu < restrictor_of(warm).oil.mu);
  const Model at_80 = read_text(text, "m.yaml", {"lubricants.oil.temperature=80 degC"});
  CHECK(restrictor_of(hot).oil.mu == doctest::Approx(restrictor_of(at_80).oil.mu).epsilon(1e-12));  // the same law
  CHECK(restrictor_of(hot).oil.density ==
        doctest::Approx(restrictor_of(at_80).oil.density).epsilon(1e-12));  // likewise
}

}  // namespace restrictor_fault_test
}  // namespace hersey::model
