#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "hersey/study/bearing_study.h"
#include "relative.h"

// Thrust bearings and sliders whose films have temperatures: fixed pads, pads that tilt, grooves between them.
namespace hersey::study {
namespace warm_thrust_test {

const std::string oil = R"(hersey: 1
lubricants:
  oil: {viscosity: {law: exponential, viscosity: 28 mPa.s, reference: 40 degC, coefficient: 0.034 1/K}, density: 860 kg/m^3,
        specific_heat: 2000 J/kg/K, conductivity: 0.13 W/m/K}
)";

const std::string sectors = oil + R"(parameters: {speed: 3000 rpm, carry: 0.8, count: 6}
bearings:
  main:
    kind: thrust
    inner_diameter: 100 mm
    outer_diameter: 200 mm
    pads: {count: "${count}", arc: 50 deg}
    shape: [{profile: ramp, rise: 40 um}]
    lubricant: oil
    grid: {along: 15, radial: 7}
    thermal: {model: film, supply_temperature: 40 degC, carry_over: "${carry}"}
    operating_point: {speed: "${speed}", film_thickness: 30 um}
)";

const std::string tilting = oil + R"(parameters: {speed: 3000 rpm, carry: 0.8, sense: positive}
bearings:
  main:
    kind: tilting_pad_thrust
    inner_diameter: 100 mm
    outer_diameter: 200 mm
    pads: {count: 6, arc: 50 deg, offset: 0.6, pivot_radius: 78 mm}
    sense: "${sense}"
    lubricant: oil
    grid: {along: 15, radial: 9}
    thermal:
      model: film
      supply_temperature: 40 degC
      carry_over: "${carry}"
      stator: {wall: pad, thickness: 20 mm, heat_transfer: 300 W/m^2/K, ambient: 40 degC}
    operating_point: {speed: "${speed}", load: 30 kN}
)";

const std::string slider = oil + R"(bearings:
  main:
    kind: plane_slider
    length: 40 mm
    width: 20 mm
    shape: [{profile: ramp, rise: 30 um}]
    lubricant: oil
    grid: {along: 21, across: 9}
    thermal: {model: film, supply_temperature: 40 degC}
    operating_point: {speed: 20 m/s, film_thickness: 30 um}
)";

BearingSolution solved(const std::string& text, std::vector<std::string> overrides = {},
                       ThermalCoefficients coefficients = ThermalCoefficients::frozen) {
  const std::string path = "warm_thrust_test.yaml";
  std::ofstream(path) << text;
  auto solutions = solve_bearings(path, {{std::move(overrides), "", "", {}}},
                                  {.grid_error = false, .thermal_coefficients = coefficients});
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

constexpr double same = 1e-6;  // temperatures are found to 1e-8 of their rise

// A groove leads what leaves a sector to the next, which is itself.
TEST_CASE("WarmSectorAlone_IsOneOfMany") {
  const BearingSolution six = solved(sectors), one = solved(sectors, {"count=1"});
  for (const char* key : {"T_max", "T_face_mean", "T_runner", "T_side", "p_max"})
    CHECK(figure(one, key) == relative(figure(six, key)).epsilon(same));
  for (const char* key : {"load", "power_film", "heat_to_oil"})
    CHECK(6 * figure(one, key) == relative(figure(six, key)).epsilon(same));
}

TEST_CASE("WarmThrustBearings_AreInBalance") {
  double last = 40;
  for (const char* carry_over : {"0", "0.6", "1"}) {
    const BearingSolution found = solved(sectors, {fmt::format("carry={}", carry_over)});
    CHECK(std::abs(figure(found, "heat_balance_error")) < 1e-7);  // what alternating film and heat leaves
    CHECK(std::abs(figure(found, "heat_to_runner")) < 1e-6 * figure(found, "power_film"));  // the same
    CHECK(figure(found, "T_max") > last + 1);
    last = figure(found, "T_max");
  }
}

// Without carry-over a pad does not know of the others but by the runner.
TEST_CASE("PadThatDrawsFreshOil_DoesNotFeelItsNeighbour") {
  const auto with = [](const std::string& pads) {
    std::string text = sectors;
    const std::string equal = "pads: {count: \"${count}\", arc: 50 deg}";
    text.replace(text.find(equal), equal.size(), "sectors: " + pads);
    text.erase(text.find(", count: 6"), 10);
    return solved(text, {"carry=0", "bearings.main.thermal.runner={wall: given, temperature: 55 degC}"});
  };
  const BearingSolution alone = with("{a: {middle: 0 deg, arc: 50 deg}}"),
                        beside = with("{a: {middle: 0 deg, arc: 50 deg}, b: {middle: 60 deg, arc: 50 deg}}");
  CHECK(figure(beside, "T_max") == relative(figure(alone, "T_max")).epsilon(same));
  CHECK(figure(beside, "heat_to_runner") == relative(2 * figure(alone, "heat_to_runner")).epsilon(1e-5));  // of 55 degC
}

// All heat of the films reaches the cooler of the sump that they draw from and drain to.
TEST_CASE("OilOfAThrustBearing_WarmsNoSumpTwice") {
  const std::string cooled = sectors + R"(thermal:
  nodes: {sump: {heat_capacity: 1 kJ/K}, cooler: {fixed: 40 degC}}
  paths: {flow: {between: [sump, cooler], conductance: 500 W/K}}
)";
  for (const char* carry_over : {"0", "0.6", "1"}) {
    const BearingSolution found = solved(
        cooled, {fmt::format("bearings.main.thermal={{model: film, supply_temperature: {{node: sump}}, carry_over: {}, "
                             "drains_to: sump}}",
                             carry_over)});
    CHECK(500 * (figure(found, "T_node_sump") - 40) == relative(figure(found, "power_film")).epsilon(same));
  }
}

TEST_CASE("WarmSectors_DoNotDependOnTheSenseOfRotation") {
  const BearingSolution one = solved(sectors),
                        other = solved(sectors, {"speed=-3000 rpm", "bearings.main.sense=negative"});
  for (const char* key : {"load", "p_max", "power_film", "T_max", "T_runner", "T_side"})
    CHECK(figure(other, key) == relative(figure(one, key)).epsilon(same));
}

// Narrow sectors of a large radius are sliders in a row, of which none leads its oil to the next.
TEST_CASE("NarrowSectorOfALargeRadius_IsAWarmSlider") {
  const BearingSolution plane = solved(slider);
  const auto sector = [](double R) {
    return solved(oil + fmt::format(R"(bearings:
  main:
    kind: thrust
    inner_diameter: {} m
    outer_diameter: {} m
    pads: {{count: 1, arc: {} rad}}
    shape: [{{profile: ramp, rise: 30 um}}]
    lubricant: oil
    grid: {{along: 21, radial: 9}}
    thermal: {{model: film, supply_temperature: 40 degC, carry_over: 0}}
    operating_point: {{speed: {} rad/s, film_thickness: 30 um}}
)",
                                    2 * R - 0.02, 2 * R + 0.02, 0.04 / R, 20 / R));
  };
  const BearingSolution near = sector(1), far = sector(4);
  for (const char* key : {"load", "power_film", "T_max", "T_face_mean", "T_runner"}) {
    CAPTURE(key);
    CHECK(figure(far, key) == relative(figure(plane, key)).epsilon(5e-3));  // of the width over the radius
    CHECK(std::abs(figure(far, key) - figure(plane, key)) < 0.6 * std::abs(figure(near, key) - figure(plane, key)));
  }
}

// Two films of an oil of one viscosity: what is warm does not move what is cold.
TEST_CASE("OilThatDoesNotThin_MovesAsIfCold") {
  const std::string constant = "lubricants.oil.viscosity=28 mPa.s";
  for (const std::string& text : {sectors, tilting, slider}) {
    const BearingSolution hot = solved(text, {constant}),
                          cold = solved(text, {constant, "bearings.main.thermal=isothermal"});
    for (const char* key : {"load", "h_min", "p_max", "power_film", "stiffness"})
      CHECK(figure(hot, key) == relative(figure(cold, key)).epsilon(same));
  }
}

TEST_CASE("TotalStiffnessOfSectors_IsThatOfLoadsNearby") {
  const BearingSolution total = solved(sectors, {}, ThermalCoefficients::total);
  const auto load_at = [](const char* film) {
    return figure(solved(sectors, {fmt::format("bearings.main.operating_point.film_thickness={}", film)}), "load");
  };
  const double stiffness = (load_at("29.9 um") - load_at("30.1 um")) / 0.2e-6;
  CHECK(figure(total, "stiffness") ==
        relative(stiffness).epsilon(1e-4));  // the square of 0.1 um over 30 um, and 1e-8/1e-3
  CHECK(figure(total, "stiffness") < 0.9 * figure(solved(sectors), "stiffness"));  // a closer film is warmer
}

TEST_CASE("WarmTiltingPads_AreAlikeAndInBalance") {
  const BearingSolution found = solved(tilting), other = solved(tilting, {"speed=-3000 rpm", "sense=negative"});
  CHECK(figure(found, "pad_T_max_4") == relative(figure(found, "pad_T_max_1")).epsilon(same));
  CHECK(figure(found, "T_max") == relative(figure(found, "pad_T_max_2")).epsilon(same));
  CHECK(std::abs(figure(found, "heat_balance_error")) < 1e-6);  // what alternating motion and heat leaves
  CHECK(std::abs(figure(found, "heat_to_runner")) < 1e-6 * figure(found, "heat_dissipated"));  // the same
  CHECK(figure(found, "heat_to_pads") > 0.01 * figure(found, "heat_dissipated"));
  for (const char* key : {"h_min", "p_max", "power_film", "T_max", "T_runner", "pad_tilt_along_1", "stiffness"})
    CHECK(figure(other, key) == relative(figure(found, key)).epsilon(same));
}

// The load of pads at frozen viscosities: stiffness is what it is in a cold oil of the same figures, which the warm
// film of one layer and one temperature has.
TEST_CASE("CarriedOverOil_WarmsTiltingPads") {
  double last = 40;
  for (const char* carry_over : {"0", "0.5", "1"}) {
    const BearingSolution found = solved(tilting, {fmt::format("carry={}", carry_over)});
    CHECK(figure(found, "pad_T_max_3") > last + 0.5);
    last = figure(found, "pad_T_max_3");
  }
}

}  // namespace warm_thrust_test
}  // namespace hersey::study
