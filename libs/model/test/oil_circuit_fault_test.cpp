#include <doctest/doctest.h>

#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "hersey/model/read.h"
#include "model_text.h"

// The oil circuit in the model file: what it reads as, and where its faults are.
namespace hersey::model {
namespace oil_circuit_fault_test {

const std::string text = R"(hersey: 1
lubricants:
  oil: {grade: iso_vg_46, temperature: 40 degC}
bodies:
  rotor: {mass: 20 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
joints:
  turning: {type: planar, between: [ground, rotor], axis: z}
drives:
  motor: {joint: turning, coordinate: rotation, speed: 3000 rpm}
circuit:
  lubricant: oil
  nodes:
    sump: {pressure: 0 bar}
    gallery: {volume: 200 cm^3, free_air: 0.03}
    hole: {}
  elements:
    pump: {type: pump, from: sump, to: gallery, displacement: 12 cm^3, joint: turning, ratio: 0.5}
    relief: {type: relief_valve, from: gallery, to: sump, opening_pressure: 4 bar, conductance: 12 l/min/bar}
    crank: {type: drilling, from: gallery, to: hole, length: 60 mm, diameter: 4 mm, joint: turning, radii: [30 mm, 55 mm]}
bearings:
  main:
    shell: ground
    journal: rotor
    diameter: 100 mm
    width: 80 mm
    radial_clearance: 50 um
    lubricant: oil
    features:
      bore: {shape: axial_groove, arc: 30 deg, length: 50 mm, circuit: hole}
simulation: {duration: 10 ms, step: 1 ms}
)";

std::string faults_with(const std::string& old, const std::string& replacement) {
  try {
    (void)read_text(edited(text, old, replacement), "m.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool reports(const std::string& old, const std::string& replacement, const std::string& message) {
  const std::string faults = faults_with(old, replacement);
  CAPTURE(faults);
  CHECK(faults.find(message) != std::string::npos);
  return faults.find(message) != std::string::npos;
}

TEST_CASE("DrillingThroughAnAxis_HasADistanceFromItAtEitherEnd") {
  CHECK(reports("radii: [30 mm, 55 mm]}", "radii: [0 mm, 55 mm], course: through_axis}", "a drilling through an axis"));
  const Model model =
      read_text(edited(text, "radii: [30 mm, 55 mm]}", "radii: [30 mm, 55 mm], course: through_axis}"), "m.yaml");
  CHECK(model.circuit->network.elements[2].passes_axis);
  CHECK(!read_text(text, "m.yaml").circuit->network.elements[2].passes_axis);
}

TEST_CASE("CircuitWithTemperatures_NeedsThemWherePressuresAreGiven") {
  CHECK(reports("gallery: {volume: 200 cm^3, free_air: 0.03}", "gallery: {volume: 200 cm^3, temperature: 60 degC}",
                "circuit.nodes.sump: a sump or supply without a temperature"));
  CHECK(reports("sump: {pressure: 0 bar}", "sump: {pressure: 0 bar, temperature: {node: pan}}",
                "unknown thermal node 'pan'"));
  CHECK(
      reports("    hole: {}\n  elements:",
              "    hole: {}\n  elements:\n    cold: {type: cooler, from: gallery, to: sump, resistance: 1e10 Pa.s/m^3, "
              "conductance: 5 W/K, coolant: 20 degC}",
              "a cooler in a circuit whose oil has one temperature"));
}

TEST_CASE("TemperaturesOfACircuit_AreNodesOfTheThermalNetwork") {
  const Model model =
      read_text(edited(text, "sump: {pressure: 0 bar}", "sump: {pressure: 0 bar, temperature: 60 degC}"), "m.yaml");
  REQUIRE(model.circuit->temperatures.has_value());
  const CircuitTemperatures& all = *model.circuit->temperatures;
  CHECK(all.nodes == std::vector<std::size_t>{0, 1, 2});
  REQUIRE(all.added.size() == 3);
  CHECK(all.added[0].is_fixed);
  CHECK(all.added[1].heat_capacity == doctest::Approx(all.heat_capacity * 200e-6).epsilon(1e-14));  // a product
  CHECK(all.added[2].heat_capacity == 0);
  CHECK(all.T == std::vector<double>{333.15, 313.15, 313.15});  // others begin with that of the lubricant
}

TEST_CASE("HeatOfACircuitInSteadyMotion_NeedsAWayOut") {
  std::string closed = edited(text, "simulation: {duration: 10 ms, step: 1 ms}",
                              "simulation: {analysis: steady}\nthermal: {nodes: {pan: {heat_capacity: 1 kJ/K}}}");
  closed = edited(closed, "sump: {pressure: 0 bar}", "sump: {pressure: 0 bar, temperature: {node: pan}}");
  std::string faults;
  try {
    (void)read_text(closed, "m.yaml");
  } catch (const InputError& error) {
    faults = error.what();
  }
  CHECK(faults.find("oil whose heat reaches no surroundings") != std::string::npos);
}

TEST_CASE("Circuit_IsReadInUnitsOfItsLaws") {
  const Model model = read_text(text, "m.yaml");
  REQUIRE(model.circuit);
  const circuit::Network& network = model.circuit->network;
  REQUIRE(network.nodes.size() == 3);
  CHECK(network.nodes[0].is_given);
  CHECK(network.nodes[1].storage->volume == doctest::Approx(2e-4));
  CHECK(std::get<circuit::DisplacementPump>(network.elements[0].law).displacement ==
        doctest::Approx(12e-6 / (2 * std::numbers::pi)));
  CHECK(model.circuit->shafts[0].ratio == 0.5);
  CHECK(std::get<circuit::ReliefValve>(network.elements[1].law).conductance == doctest::Approx(2e-9));
  CHECK(network.elements[2].r_to == doctest::Approx(0.055));
  CHECK(network.oil.mu == model.bearings[0].film.lubricant.mu0);
  REQUIRE(model.bearings[0].circuit_ports.size() == 1);
  CHECK(model.bearings[0].circuit_ports[0].node == 2);
  CHECK(model.bearings[0].film.features[0].is_fed);
}

TEST_CASE("CircuitAndPump_HaveTheirCavitationPressureAndEfficiency") {
  const Model model = read_text(edited(edited(text, "  nodes:", "  cavitation_pressure: -0.4 bar\n  nodes:"),
                                       "ratio: 0.5}", "ratio: 0.5, mechanical_efficiency: 0.8}"),
                                "m.yaml");
  CHECK(model.circuit->network.nodes[1].p_cav == doctest::Approx(-4e4));
  CHECK(std::get<circuit::DisplacementPump>(model.circuit->network.elements[0].law).mechanical_efficiency == 0.8);
  const Model usual = read_text(text, "m.yaml");
  CHECK(usual.circuit->network.nodes[1].p_cav == -circuit::standard_atmosphere);
  CHECK(std::get<circuit::DisplacementPump>(usual.circuit->network.elements[0].law).mechanical_efficiency == 1);
  CHECK(reports("ratio: 0.5}", "ratio: 0.5, mechanical_efficiency: 1.2}", "mechanical_efficiency"));
}

// Two films on one node cavitate together.
TEST_CASE("FilmsOnOneNode_HaveOneCavitationPressure") {
  const std::string second = R"(  other:
    shell: ground
    journal: rotor
    diameter: 100 mm
    width: 80 mm
    radial_clearance: 50 um
    lubricant: oil
    cavitation: {model: mass_conserving, pressure: -0.9 bar}
    features:
      bore: {shape: axial_groove, arc: 30 deg, length: 50 mm, circuit: hole}
simulation:)";
  CHECK(reports(
      "simulation:", second,
      "bearings.other: a cavitation pressure of -0.9 bar, and 0 bar of bearing 'main' on the same node 'hole'"));
  const std::string elsewhere = edited(second, "circuit: hole", "circuit: gallery");
  CHECK(faults_with("simulation:", elsewhere).empty());
}

TEST_CASE("FaultsOfACircuit_AreReportedByNameAndLine") {
  CHECK(reports("circuit: hole", "circuit: hol",
                "m.yaml:29:72: bearings.main.features.bore.circuit: unknown node 'hol' of the circuit"));
  CHECK(reports("circuit: hole", "circuit: hole, pressure: 2 bar", "a pressure beside `circuit`"));
  CHECK(reports("to: hole,", "to: sump,", "a feed from node 'hole', which no element of the circuit meets"));
  CHECK(reports("opening_pressure: 4 bar", "opening_pressure: -1 bar",
                "m.yaml:18:77: circuit.elements.relief.opening_pressure: a relief valve that opens at -1 bar, not "
                "above ambient"));
  CHECK(reports("ratio: 0.5", "ratio: -0.5",
                "m.yaml:17:5: circuit.elements.pump: a pump that turns backwards, at -1500 rpm"));
  CHECK(reports("joint: turning, ratio: 0.5", "speed: -3000 rpm", "a pump that turns backwards, at -3000 rpm"));
  CHECK(reports(", joint: turning, ratio: 0.5", "", "neither 'speed' nor 'joint'"));
  CHECK(reports("joint: turning, ratio: 0.5", "joint: turnin", "unknown joint 'turnin'"));
  CHECK(reports("from: gallery, to: sump", "from: galery, to: sump", "did you mean 'gallery'?"));
  CHECK(reports("from: gallery, to: sump", "from: sump, to: sump", "an element from a node to itself"));
  CHECK(reports("radii: [30 mm, 55 mm]", "roughness: 1 um", "a rotation of a drilling without `radii`"));
  CHECK(reports("type: relief_valve", "type: releif_valve", "did you mean 'relief_valve'?"));
}

// Without pump and sump only a bearing is left, which drains, but nothing feeds it.
TEST_CASE("CircuitWithoutASourceOrALevel_IsAFault") {
  const std::string pump =
      "    pump: {type: pump, from: sump, to: gallery, displacement: 12 cm^3, joint: turning, ratio: 0.5}\n";
  std::string unfed = edited(edited(text, pump, ""), "sump: {pressure: 0 bar}", "sump: {}");
  try {
    (void)read_text(unfed, "m.yaml");
    CHECK(false);
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).find("m.yaml:10:1: circuit: a circuit without a source") != std::string::npos);
  }
  const std::string island =
      "    hole: {}\n    tank: {volume: 100 cm^3}\n    other: {}\n  elements:\n"
      "    island: {type: orifice, from: tank, to: other, diameter: 1 mm}\n";
  CHECK(reports("    hole: {}\n  elements:\n", island, "circuit.nodes.tank: a pressure without a level"));
}

TEST_CASE("FeedOfTheCircuit_IsNoPressureOfAPartitionedCoupling") {
  CHECK(reports("    lubricant: oil\n    features:",
                "    lubricant: oil\n    coupling: {scheme: partitioned}\n    features:", "partitioned"));
}

// The mouth of the drilling as a hole of the journal that passes the groove.
const std::string passing = edited(
    edited(edited(text, "    hole: {}\n", "    hole: {}\n    pin: {pressure: 0 bar}\n"),
           "    crank: {type: drilling, from: gallery, to: hole,",
           "    mouth: {type: hole_over_groove, from: gallery, to: hole, bearing: main, hole: mouth, groove: bore}\n"
           "    crank: {type: drilling, from: hole, to: pin,"),
    "length: 50 mm, circuit: hole}",
    "length: 50 mm, circuit: gallery}\n      mouth: {shape: hole, on: journal, diameter: 14 mm, circuit: hole}");

bool reports_passing(const std::string& old, const std::string& replacement, const std::string& message) {
  std::string faults;
  try {
    (void)read_text(edited(passing, old, replacement), "m.yaml");
  } catch (const InputError& error) {
    faults = error.what();
  }
  CAPTURE(faults);
  CHECK(faults.find(message) != std::string::npos);
  return faults.find(message) != std::string::npos;
}

TEST_CASE("HoleOverAGroove_IsReadWithItsFeatures") {
  const Model model = read_text(passing, "m.yaml");
  REQUIRE(model.circuit->holes.size() == 1);
  CHECK(model.circuit->holes[0].of_bearing == 0);
  CHECK(model.bearings[0].film.features[model.circuit->holes[0].hole_feature].name == "mouth");
  CHECK(model.bearings[0].film.features[model.circuit->holes[0].groove_feature].name == "bore");
  for (const Fault& warning : model.warnings) CHECK(warning.found.find("passes over") == std::string::npos);
}

TEST_CASE("FaultsOfAHoleOverAGroove_AreReportedByNameAndLine") {
  CHECK(reports_passing("bearing: main,", "bearing: mian,",
                        "m.yaml:20:71: circuit.elements.mouth.bearing: unknown bearing 'mian'"));
  CHECK(reports_passing("hole: mouth,", "hole: moth,", "unknown feature 'moth' of bearing 'main'"));
  CHECK(reports_passing("hole: mouth,", "hole: moth,", "did you mean 'mouth'?"));
  CHECK(reports_passing("hole: mouth, groove: bore", "hole: bore, groove: mouth", "'bore', which is not round"));
  CHECK(reports_passing("on: journal, diameter", "diameter", "in the same surface as 'mouth', which never passes it"));
  CHECK(reports_passing("on: journal, diameter", "on: journal, z: 33 mm, diameter", "always passes"));
  CHECK(reports_passing("to: hole, bearing", "to: sump, bearing", "'mouth' is fed by node 'hole'"));
}

}  // namespace oil_circuit_fault_test
}  // namespace hersey::model
