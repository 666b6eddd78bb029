#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "hersey/film/thermal_model.h"
#include "hersey/study/bearing_study.h"

// Bores of arcs and tilting pads whose films have temperatures: grooves between them mix the oil.
namespace hersey::study {
namespace warm_arcs_test {

const std::string oil = R"(hersey: 1
lubricants:
  oil: {viscosity: {law: exponential, viscosity: 28 mPa.s, reference: 40 degC, coefficient: 0.034 1/K}, density: 860 kg/m^3,
        specific_heat: 2000 J/kg/K, conductivity: 0.13 W/m/K}
)";

const std::string arcs = oil + R"(parameters: {speed: 3000 rpm, load_angle: -80 deg, carry: 1, axial: 5}
thermal:
  nodes: {sump: {heat_capacity: 1 kJ/K}, cooler: {fixed: 40 degC}}
  paths: {flow: {between: [sump, cooler], conductance: 200 W/K}}
bearings:
  main:
    diameter: 100 mm
    width: 60 mm
    radial_clearance: 80 um
    lubricant: oil
    grid: {circumferential: 72, axial: "${axial}"}
    arcs:
      a: {middle: -90 deg, arc: 110 deg, preload: 0.2, offset: 0.5}
      b: {middle: 40 deg, arc: 90 deg, preload: 0.4, offset: 0.6}
      c: {middle: 150 deg, arc: 80 deg}
    thermal: {model: film, supply_temperature: 40 degC, carry_over: "${carry}"}
    operating_point: {journal_speed: "${speed}", load: 4 kN, load_angle: "${load_angle}"}
)";

const std::string pads = oil + R"(bearings:
  main:
    kind: tilting_pad
    diameter: 100 mm
    width: 70 mm
    radial_clearance: 78.44 um
    lubricant: oil
    grid: {circumferential: 60, axial: 7}
    pads: {count: 4, arc: 75 deg, machined_clearance: 148 um}
    thermal:
      model: film
      supply_temperature: 40 degC
      shell: {wall: pad, thickness: 20 mm, heat_transfer: 100 W/m^2/K, ambient: 40 degC}
    operating_point: {journal_speed: 2000 rpm, load: 10 kN}
)";

BearingSolution solved(const std::string& text, std::vector<std::string> overrides = {}) {
  const std::string path = "warm_arcs_test.yaml";
  std::ofstream(path) << text;
  auto solutions = solve_bearings(path, {{std::move(overrides), "", "", {}}}, {.grid_error = false});
  std::filesystem::remove(path);
  INFO(solutions.at(0).message);
  REQUIRE(solutions.at(0).solved());
  return solutions.front();
}

double figure(const BearingSolution& solution, const std::string& key) {
  const std::vector<BearingFigure> all = figures_of(solution);
  const auto found = std::find_if(all.begin(), all.end(), [&](const BearingFigure& f) { return f.key == key; });
  REQUIRE_MESSAGE(found != all.end(), key);
  return found->value;
}

TEST_CASE("WarmArcs_DoNotDependOnTheSenseOfRotation") {
  const BearingSolution one = solved(arcs);
  const BearingSolution mirrored = solved(
      arcs, {"speed=-3000 rpm", "load_angle=260 deg",
             "bearings.main.arcs={a: {middle: 270 deg, arc: 110 deg, preload: 0.2, offset: 0.5}, b: {middle: 140 "
             "deg, arc: 90 deg, preload: 0.4, offset: 0.4}, c: {middle: 30 deg, arc: 80 deg}}"});
  constexpr double same = 1e-6;  // temperatures are found to 1e-8 of their rise
  for (const char* key : {"h_min", "p_max", "power_film", "T_max", "T_journal", "T_side"})
    CHECK(figure(mirrored, key) == doctest::Approx(figure(one, key)).epsilon(same));
}

TEST_CASE("WarmArcs_AreInBalance") {
  for (const char* carry_over : {"0", "0.6", "1"}) {
    const BearingSolution found = solved(arcs, {fmt::format("carry={}", carry_over)});
    CHECK(std::abs(figure(found, "heat_balance_error")) < 1e-7);  // what alternating film and heat leaves
  }
}

// The sump gives the oil that is drawn and takes what leaves for good: all heat of the film reaches its cooler.
TEST_CASE("OilThatCirculates_WarmsNoSumpTwice") {
  for (const char* carry_over : {"0", "0.6", "1"}) {
    const BearingSolution found = solved(
        arcs, {fmt::format("bearings.main.thermal={{model: film, supply_temperature: {{node: sump}}, carry_over: {}, "
                           "drains_to: sump}}",
                           carry_over)});
    constexpr double balanced = 1e-6;  // what alternating film and heat leaves
    CHECK(200 * (figure(found, "T_node_sump") - 40) == doctest::Approx(figure(found, "power_film")).epsilon(balanced));
  }
}

// Half of a groove's arc from either neighbour: the same film, whose ends are lines of the grid here and a supply
// there.
TEST_CASE("OneArcAroundTheBore_IsABoreWithAGroove") {
  const std::string common = oil + R"(bearings:
  main:
    diameter: 100 mm
    width: 60 mm
    radial_clearance: 80 um
    lubricant: oil
    thermal: {model: film, supply_temperature: 40 degC}
    operating_point: {journal_speed: 3000 rpm, load: 4 kN, load_angle: -90 deg}
)";
  const BearingSolution arc = solved(common + "    grid: {circumferential: 144, axial: 9}\n" +
                                     "    arcs: {a: {middle: -90 deg, arc: 340 deg}}\n");
  const BearingSolution bore =
      solved(common +
             "    grid: {circumferential: 144, axial: 9}\n    features: {g: {shape: axial_groove, angle: 90 deg, "
             "arc: 20 deg, length: 60 mm, pressure: 0 Pa, depth: 5 mm}}\n");
  constexpr double cells = 0.01;  // a groove's edges lie between lines, an arc's on lines
  for (const char* key : {"h_min", "power_film"})
    CHECK(figure(arc, key) == doctest::Approx(figure(bore, key)).epsilon(cells));
  for (const char* key : {"T_max", "T_journal"})
    CHECK(figure(arc, key) - 40 == doctest::Approx(figure(bore, key) - 40).epsilon(2 * cells));
}

TEST_CASE("WarmPads_ShowTheirTemperatures") {
  const BearingSolution found = solved(pads);
  double hottest = 0;
  for (const char* pad : {"1", "2", "3", "4"})
    hottest = std::max(hottest, figure(found, std::string("pad_T_max_") + pad));
  CHECK(hottest == figure(found, "T_max"));
  CHECK(std::abs(figure(found, "heat_balance_error")) < 1e-6);  // what alternating motion and heat leaves
  // A journal that gives off no heat but to the films.
  CHECK(std::abs(figure(found, "heat_to_journal")) < 1e-6 * figure(found, "heat_dissipated"));  // the same
  CHECK(figure(found, "heat_to_shell") > 0.02 * figure(found, "heat_dissipated"));
}

TEST_CASE("PadsOnAColdCarrier_CloseTheClearance") {
  film::ThermalExpansion walls{.shell = 12e-6, .journal = 11e-6, .T_reference = 293.15};
  const double as_one = walls.growth(0.05, 330, 325);
  walls.carrier = {.T = 330, .thickness = 0.02};
  CHECK(walls.growth(0.05, 330, 325) == doctest::Approx(as_one));
  walls.carrier->T = 310;
  // R and the pad's thickness follow the carrier, the thickness the pad.
  const double expected = 12e-6 * (0.07 * (310 - 293.15) - 0.02 * (330 - 293.15)) - 11e-6 * 0.05 * (325 - 293.15);
  CHECK(walls.growth(0.05, 330, 325) == doctest::Approx(expected));

  const auto with = [](const char* carrier) {
    return solved(pads, {"bearings.main.thermal.expansion={shell: 1.2e-5 1/K, journal: 1.2e-5 1/K}",
                         fmt::format("bearings.main.thermal.shell={{wall: pad, thickness: 20 mm, heat_transfer: 100 "
                                     "W/m^2/K, ambient: 40 degC, carrier: {}}}",
                                     carrier)});
  };
  const BearingSolution cold = with("30 degC"), warm = with("50 degC");
  CHECK(figure(cold, "pad_h_pivot_3") < figure(warm, "pad_h_pivot_3") - 5);  // um, of 16.8 um between the carriers
  CHECK(figure(cold, "T_max") > figure(warm, "T_max"));
}

}  // namespace warm_arcs_test
}  // namespace hersey::study
