#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "model_text.h"
#include "temporary_directory.h"

// A piston ring from the model file, and what may be wrong with it.
namespace hersey::model {
namespace piston_ring_model_test {

const std::string machine = R"(hersey: 1
bodies:
  piston: {mass: 0.4 kg, inertia: {xx: 1e-4 kg.m^2, yy: 1e-4 kg.m^2, zz: 1e-4 kg.m^2}}
joints: {guide: {type: prismatic, between: [ground, piston], axis: z}}
forces:
  ring:
    type: piston_ring
    between: [ground, piston]
    bore: 75 mm
    height: 1.5 mm
    tension: 8 N
    friction: 0.1
simulation: {duration: 1 ms, step: 0.1 ms}
)";

std::string with_friction(const std::string& friction) { return edited(machine, "friction: 0.1", friction); }

TEST_CASE("PistonRing_IsReadWithItsCurveOfFriction") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "stribeck.csv") << "hersey [1], friction [1]\n0, 0.12\n1e-4, 0.02\n4e-4, 0.03\n";
  std::ofstream(folder / "m.yaml") << with_friction(
      "friction: {table: {file: stribeck.csv, x: hersey, y: friction}}\n    viscosity: 8 mPa.s");
  const Model model = read((folder / "m.yaml").string());
  const auto* ring = model.forces.at(0).as<PistonRing>();
  REQUIRE(ring != nullptr);
  CHECK(ring->data.tension == 8);
  CHECK(ring->data.lowest == 0);
  CHECK(ring->data.highest == 4e-4);
  CHECK(ring->data.viscosity == doctest::Approx(8e-3));
  const double H = 5e-5;
  CHECK(ring->data.stribeck->value({&H, 1}) == doctest::Approx(0.07));
}

TEST_CASE("PistonRingsThatCannotBe_AreReported") {
  CHECK(faults_of(machine) == "no fault");
  const auto says = [](const std::string& text, const std::string& expected) {
    const std::string faults = faults_of(text);
    CAPTURE(faults);
    CHECK(faults.find(expected) != std::string::npos);
  };
  says(with_friction("friction: {expression: 0.1*exp(-1e4*hersey), unit: \"1\"}"),
       "friction over the Hersey number, and no 'viscosity'; expected the viscosity of the oil on the liner");
  says(with_friction("friction: -0.1"), "a coefficient of friction of -0.1");
  says(with_friction("friction: {expression: 0.1 - 1000*hersey, unit: \"1\"}\n    viscosity: 8 mPa.s"),
       "a coefficient of friction of");
  says(edited(machine, "tension: 8 N", "tension: -8 N"), "tension");
}

}  // namespace piston_ring_model_test
}  // namespace hersey::model
