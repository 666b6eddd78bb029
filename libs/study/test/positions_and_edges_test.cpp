#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "hersey/study/bearing_study.h"

// Results must not depend on the side from which a position reaches a node, on the sense of rotation, or on nodes along
// the edges.
namespace hersey::study {
namespace positions_and_edges_test {

const std::string hot_line = R"(hersey: 1
parameters: {s: 3000 rpm, a: -90 deg, l: 90 deg, p: -60 deg, w: 0}
lubricants:
  oil:
    viscosity: {law: exponential, viscosity: 40 mPa.s, reference: 40 degC, coefficient: 0.03 1/K}
    density: 870 kg/m^3
    specific_heat: 1950 J/kg/K
    conductivity: 0.14 W/m/K
    pressure_viscosity: 1.5e-8 1/Pa
bearings:
  main:
    diameter: 80 mm
    width: 40 mm
    radial_clearance: 60 um
    lubricant: oil
    grid: {circumferential: 60, axial: 7}
    supply: {line: "${l}", pressure: 2 bar}
    features:
      pocket: {shape: pocket, angle: "${p}", arc: 36 deg, length: 20 mm, depth: 20 um}
    thermal: {model: film, supply_temperature: 50 degC, carry_over: 0}
    operating_point: {journal_speed: "${s}", load: 10 kN, load_angle: "${a}"}
)";

const std::string short_bearing = R"(hersey: 1
lubricants:
  oil: {viscosity: 100 mPa.s}
bearings:
  main:
    diameter: 100 mm
    width: 30 mm
    radial_clearance: 0.1 mm
    lubricant: oil
    cavitation: guembel
    grid: {circumferential: 120, axial: 7}
    operating_point: {journal_speed: 1500 rpm, load: 525 N}
)";

const std::string squeeze = R"(hersey: 1
lubricants:
  oil: {viscosity: 5 mPa.s}
bearings:
  main:
    diameter: 100 mm
    width: 10 mm
    radial_clearance: 0.1 mm
    lubricant: oil
    cavitation: guembel
    grid: {circumferential: 90, axial: 13}
    operating_point: {journal_speed: 0 rpm, eccentricity_ratio: 0.4, radial_velocity: 20 mm/s}
)";

BearingSolution solved(const std::string& model, const std::vector<std::string>& overrides, bool grid_error = false) {
  const std::string path = "positions_and_edges_test.yaml";
  std::ofstream(path) << model;
  auto solutions = solve_bearings(path, {{overrides, "", "", {}}}, {.bearing = "", .grid_error = grid_error});
  std::filesystem::remove(path);
  INFO(solutions.at(0).message);
  REQUIRE(solutions.at(0).solved());
  return solutions.front();
}

BearingFigure figure_of(const BearingSolution& solution, const std::string& key) {
  const std::vector<BearingFigure> all = figures_of(solution);
  const auto found = std::find_if(all.begin(), all.end(), [&](const BearingFigure& f) { return f.key == key; });
  REQUIRE_MESSAGE(found != all.end(), key);
  return *found;
}

double figure(const BearingSolution& solution, const std::string& key) { return figure_of(solution, key).value; }

void check_same(const BearingSolution& one, const BearingSolution& other, double tolerance) {
  for (const char* key : {"h_min", "h_min_centre", "p_max", "eccentricity_ratio", "friction_journal", "side_flow",
                          "flow_supply", "T_max", "T_journal", "T_side", "heat_to_oil"}) {
    CAPTURE(key);
    CHECK(figure(other, key) == doctest::Approx(figure(one, key)).epsilon(tolerance));
  }
}

TEST_CASE("SameHotMachine_HasTheSameNumbersMirroredAndTurned") {
  // Films and temperatures are found to 1e-8; a line that lies on nodes, and between them.
  constexpr double solved_for = 1e-6;
  for (const int line : {90, 92}) {
    CAPTURE(line);
    const std::string there = std::to_string(line), opposite = std::to_string(180 + line);
    const BearingSolution one = solved(hot_line, {"l=" + there + " deg"});
    check_same(one, solved(hot_line, {"s=-3000 rpm", "a=90 deg", "p=60 deg", "l=-" + there + " deg"}), solved_for);
    check_same(one, solved(hot_line, {"a=90 deg", "p=120 deg", "l=" + opposite + " deg"}), solved_for);
  }
}

TEST_CASE("LineBesideANode_IsThatOnTheNode") {
  const BearingSolution on = solved(hot_line, {});
  // A millionth of a cell's six degrees; no figure changes by more than some times itself over a cell.
  for (const char* beside : {"l=89.999994 deg", "l=90.000006 deg"}) {
    CAPTURE(beside);
    check_same(on, solved(hot_line, {beside}), 1e-5);
  }
}

// A node beside the line has film by what the line presses in, whichever of the two cells the line is counted to.
TEST_CASE("CavitatedShareBesideALine_IsThatOfTheMirrorImageAndContinuous") {
  const std::string free = "bearings.main.features={}";
  const auto share = [&](std::vector<std::string> overrides) {
    overrides.push_back(free);
    return figure(solved(hot_line, overrides), "cavitated_share");
  };
  const double on = share({});
  constexpr double solved_for = 1e-6;  // films and temperatures are found to 1e-8
  CHECK(share({"s=-3000 rpm", "a=90 deg", "l=-90 deg"}) == doctest::Approx(on).epsilon(solved_for));
  CHECK(share({"s=-3000 rpm"}) == doctest::Approx(on).epsilon(solved_for));
  CHECK(share({"a=90 deg", "l=270 deg"}) == doctest::Approx(on).epsilon(solved_for));
  // A millionth of a cell's six degrees; over a cell the share changes by a tenth.
  for (const char* beside : {"l=89.999994 deg", "l=90.000006 deg"}) {
    CAPTURE(beside);
    CHECK(share({beside}) == doctest::Approx(on).epsilon(solved_for));
  }
}

TEST_CASE("FrictionBesideOpenEdges_IsOfSecondOrder") {
  for (const char* law : {"guembel", "reynolds", "mass_conserving"}) {
    CAPTURE(law);
    std::vector<std::string> model{std::string("bearings.main.cavitation=") + law};
    if (law == std::string("mass_conserving"))
      model.emplace_back("bearings.main.supply={line: widest_gap, pressure: 0.01 bar}");
    const auto on = [&](const char* axial) {
      std::vector<std::string> all = model;
      all.push_back(std::string("bearings.main.grid.axial=") + axial);
      return solved(short_bearing, all);
    };
    const BearingSolution coarse = on("7"), fine = on("49");
    for (const char* key : {"torque_journal", "power_film"}) {
      CAPTURE(key);
      // 1/36 of the film over the width is what a parabola's sum may be off by on six cells, a fifth of it is left.
      CHECK(figure(coarse, key) == doctest::Approx(figure(fine, key)).epsilon(0.006));
    }
    // One of 120 lines of nodes.
    CHECK(std::abs(figure(coarse, "cavitated_share") - figure(fine, "cavitated_share")) < 1.0 / 120);
  }
}

TEST_CASE("HalfFilm_ReportsTheFlowOfTheActingPressure") {
  const BearingSolution turning = solved(short_bearing, {"bearings.main.grid.axial=25"});
  CHECK(figure(turning, "mass_balance_error") < 1e-9);  // the solver leaves 1e-10
  // A short bearing's pressure pumps u c eps L/2 over each edge in all, the wedge of its positive half.
  const double epsilon = figure(turning, "eccentricity_ratio"), u = 50 * std::acos(-1.0) * 0.05;
  CHECK(turning.state.film.flow_out() == doctest::Approx(u * 1e-4 * epsilon * 0.03).epsilon(0.1));
  const BearingSolution squeezed = solved(squeeze, {});
  CHECK(figure(squeezed, "mass_balance_error") < 1e-9);  // round-off and the solver's tolerance of 1e-10
  // What the approaching half displaces: 2 R L times the velocity.
  CHECK(squeezed.state.film.flow_out() == doctest::Approx(2 * 0.05 * 0.01 * 0.02).epsilon(0.02));
}

TEST_CASE("ColumnOnAnAbsoluteScale_IsThatOnAGaugeScale") {
  const std::string column = "bearings.main.compliance={model: column, composite_modulus: 2 GPa, length: 2 mm}";
  const BearingSolution gauge = solved(squeeze, {column});
  const BearingSolution absolute =
      solved(squeeze, {column, "bearings.main.pressures=absolute", "bearings.main.edge_pressure=1.01325 bar",
                       "bearings.main.cavitation={model: guembel, pressure: 1.01325 bar}"});
  // Films are found to 1e-8; nothing amplifies that here.
  for (const char* key : {"h_min", "load", "side_flow", "power_film", "stiffness_xx", "damping_xx"}) {
    CAPTURE(key);
    // The solver's tolerance, amplified in derivatives.
    CHECK(figure(absolute, key) == doctest::Approx(figure(gauge, key)).epsilon(1e-7));
  }
}

}  // namespace positions_and_edges_test
}  // namespace hersey::study
