#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/study/bearing_study.h"
#include "meshed_bearing.h"
#include "ring_file.h"

// Bearings whose shell is in a body that conducts heat, from the model file to the figures.
namespace hersey::study {
namespace heated_body_test {

/// Case F3 of an independent program that conducts heat in three dimensions: a steel ring of 200 mm in air around a
/// film.
const std::string machine =
    MeshedBearing{
        .title = "A ring that conducts",
        .ring = {"heated_body_test_ring.inp",
                 "heat:\n"
                 "  conductivity: 50 W/m/K\n"
                 "  cooling:\n"
                 "    outside: {heat_transfer: 80 W/m^2/K, ambient: 40 degC}\n"
                 "    ends: {heat_transfer: 80 W/m^2/K, ambient: 40 degC}",
                 kHub},
        .load = "",
        .oil =
            "{viscosity: {law: exponential, viscosity: 27.7 mPa.s, reference: 40 degC, coefficient: 0.034 1/K}, "
            "density: 860 kg/m^3, specific_heat: 2000 J/kg/K, conductivity: 0.13 W/m/K}",
        .diameter = "100 mm",
        .width = "80 mm",
        .clearance = "145 um",
        .edge_pressure = "",
        .film =
            "shear_force: torque_only\n"
            "grid: {circumferential: 60, axial: 13}\n"
            "features:\n"
            "  groove: {shape: axial_groove, angle: 0 deg, arc: 18 deg, length: 70 mm, pressure: 70 kPa}\n"
            "thermal: {model: film, supply_temperature: 40 degC, shell: {wall: body}}\n"
            "operating_point: {journal_speed: 2000 rpm, eccentricity_ratio: 0.7, eccentricity_angle: 230 deg}"}
        .text();

/// Model and mesh in the working directory.
struct Written {
  explicit Written(bool is_fine = false) {
    RingFile ring{.inner = 50, .outer = 100, .width = 80, .around = 48, .along = 4, .through = 4};
    if (is_fine) ring.around = 60, ring.along = 6, ring.through = 8;
    std::ofstream("heated_body_test_ring.inp") << ring.text();
    std::ofstream("heated_body_test_shaft.inp")
        << RingFile{.inner = 20, .outer = 50, .width = 80, .around = 48, .along = 4, .through = 4}.text();
    std::ofstream("heated_body_test.yaml") << machine;
  }
  ~Written() {
    std::filesystem::remove("heated_body_test_ring.inp");
    std::filesystem::remove("heated_body_test_shaft.inp");
    std::filesystem::remove("heated_body_test.yaml");
  }
  Written(const Written&) = delete;
  Written& operator=(const Written&) = delete;
};

BearingSolution solved(const std::vector<std::string>& overrides, bool grid_error = false) {
  auto solutions =
      solve_bearings("heated_body_test.yaml", {{overrides, "", "", {}}}, {.bearing = "", .grid_error = grid_error});
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

TEST_CASE("MeshedRing_IsThatOfAnIndependentProgram") {
  const Written files(true);
  // As many nodes as it takes for the shaft's bar: on 60 x 13 it is 0.22 K off, by the groove's rim.
  const std::string around = "bearings.main.grid.circumferential=120", along = "bearings.main.grid.axial=17";
  const BearingSolution body = solved({around, along});
  CHECK(figure(body, "load") == doctest::Approx(6775).epsilon(0.01));  // bars of the reference
  CHECK(std::abs(figure(body, "T_journal") - 45.78) < 0.2);            // as well
  CHECK(std::abs(figure(body, "T_body_max") - 51.44) < 0.3);           // as well
  // 0.1 % of the film's power: the control volumes on the groove's rim, where oil is coldest, take none back.
  CHECK(figure(body, "heat_to_shell") == doctest::Approx(40.32).epsilon(0.015));
  CHECK(figure(body, "heat_balance_error") < 1e-8);  // the film's residual
  CHECK(body.summary.heat_iterations <= 20);
  // And nearly that of a ring with one temperature per angle.
  const BearingSolution ring =
      solved({around, along, "bearings.main.thermal.shell={wall: ring, outer_diameter: 200 mm, ambient: 40 degC}"});
  CHECK(figure(body, "load") ==
        doctest::Approx(figure(ring, "load")).epsilon(5e-3));  // walls 0.5 K apart: oil 1.5 % thinner
  CHECK(std::abs(figure(body, "T_shell_max") - figure(ring, "T_shell_max")) < 0.5);  // as well: it has the middle's
  CHECK(figure(body, "heat_to_shell") == doctest::Approx(figure(ring, "heat_to_shell")).epsilon(0.03));  // as well
  bool has_growth = false;
  for (const BearingFigure& f : figures_of(body)) has_growth = has_growth || f.key == "bore_growth";
  CHECK_FALSE(has_growth);
}

// Free, the ring grows with its mean temperature; supported at its outside it grows inwards.
TEST_CASE("RingThatExpands_OpensItsBearing_OrClosesItWhereItIsSupported") {
  const Written files;
  const std::string expands = "bodies.ring.flexible.heat.expansion=12e-6 1/K";
  const BearingSolution cold = solved({}), free = solved({expands});
  const double growth = figure(free, "bore_growth");
  const double T_mean = free.state.heat->T_body.mean() - 273.15;
  CHECK(growth == doctest::Approx(12e-6 * 50e3 * (T_mean - 20)).epsilon(0.05));  // um; even but for a few kelvin
  CHECK(figure(free, "bore_distortion") < 0.2 * growth);
  CHECK(figure(free, "load") < 0.8 * figure(cold, "load"));
  CHECK(figure(free, "h_min") == doctest::Approx(43.5 + growth).epsilon(0.02));  // um; and a distortion of half of one
  const BearingSolution supported = solved({expands, "bodies.ring.flexible.heat.fixed=[outside]"});
  CHECK(figure(supported, "bore_growth") < -10);
  CHECK(figure(supported, "load") > 1.5 * figure(cold, "load"));
  // At the reference temperature of its surroundings it is cold where no film warms it.
  const BearingSolution warm = solved({expands, "bodies.ring.flexible.heat.reference_temperature=40 degC"});
  CHECK(figure(warm, "bore_growth") ==
        doctest::Approx(growth - 12e-6 * 50e3 * 20).epsilon(0.2));  // a thinner film: hotter
}

// With a surface that pressure deforms on the same mesh, under a load, and with its error of the grid.
TEST_CASE("ShellThatHeatAndPressureDeform_CarriesItsLoad") {
  const Written files;
  const BearingSolution both = solved({"bodies.ring.flexible.heat.expansion=12e-6 1/K",
                                       "bearings.main.shell_surface={faces: bore, functions: [16, 3], modes: 12}",
                                       "bearings.main.grid={circumferential: 48, axial: 9}",
                                       "bearings.main.operating_point={journal_speed: 2000 rpm, load: 5 kN}"},
                                      true);
  CHECK(both.grid_error.known);
  CHECK(both.state.d_shell.size() == both.state.shapes.thermal_shell.size());
  CHECK(figure(both, "load") == doctest::Approx(5000).epsilon(1e-9));  // Newton's tolerance, 1e-10
  CHECK(both.summary.heat_iterations <= 30);
  const film::FilmFields fields = bearing::steady_fields(both.model, both.state);
  CHECK(1e6 * fields.h.minCoeff() ==
        doctest::Approx(figure(both, "h_min")).epsilon(0.02));  // between nodes it is smaller
}

/// With a hollow shaft that oil in its bore cools, and what else is said.
std::vector<std::string> with_shaft(std::vector<std::string> overrides, const std::string& expansion) {
  const std::vector<std::string> shaft = {
      "bodies.shaft={flexible: {mesh: heated_body_test_shaft.inp, length_unit: 1 mm, material: {youngs_modulus: 210 "
      "GPa, "
      "poisson_ratio: 0.3, density: 7850 kg/m^3}, heat: {conductivity: 50 W/m/K, expansion: " +
          expansion +
          ", cooling: {bore: {heat_transfer: 200 W/m^2/K, ambient: 50 degC}}}}, frames: {axis: {nodes: bore, "
          "connection: "
          "average, origin: 0 0 0 mm}}}",
      "joints.slide.between=[ground, shaft.axis]", "bearings.main.journal=shaft.axis",
      "bearings.main.thermal.journal={wall: body}"};
  overrides.insert(overrides.begin(), shaft.begin(), shaft.end());
  return overrides;
}

// Against the lumped body of the same conductance, in the clearance that the shaft leaves.
TEST_CASE("MeshedShaft_IsALumpedBodyInASmallerClearance") {
  const Written files;
  const BearingSolution body = solved(with_shaft({}, "12e-6 1/K"));
  CHECK(figure(body, "heat_balance_error") < 1e-8);  // the film's residual
  const double growth = figure(body, "journal_growth"), heat = figure(body, "heat_to_journal");
  CHECK(std::abs(heat) > 2);  // W
  const double pi = 3.14159265358979;
  const double out = 200 * 2 * pi * 0.02 * 0.08, per_log = 1 / (2 * pi * 50 * 0.08);
  CHECK(figure(body, "T_journal") ==
        doctest::Approx(50 + heat * (1 / out + per_log * std::log(2.5))).epsilon(2e-3));  // flat faces, four across
  CHECK(figure(body, "T_journal_body_max") >= figure(body, "T_journal") - 1e-6);          // round-off
  const double T_mean = body.state.heat->T_journal_body.mean() - 273.15;
  CHECK(growth == doctest::Approx(12e-6 * 50e3 * (T_mean - 20)).epsilon(0.03));  // um; its nodes are denser inside
  CHECK(figure(body, "journal_distortion") < 0.05 * growth);  // a few per cent of the slope at its free ends
  CHECK(figure(body, "clearance_of_bodies") == doctest::Approx(145 - growth).epsilon(1e-9));  // round-off
  const BearingSolution lumped =
      solved({"thermal.nodes={shaft: {heat_capacity: 1 kJ/K}, oil: {fixed: 50 degC}}",
              "thermal.paths={out: {between: [shaft, oil], conductance: " +
                  std::to_string(heat / (figure(body, "T_journal") - 50)) + " W/K}}",
              "bearings.main.thermal.journal={wall: node, node: shaft}",
              "bearings.main.radial_clearance=" + std::to_string(145 - growth) + " um",
              "bearings.main.operating_point.eccentricity_ratio=" + std::to_string(0.7 * 145 / (145 - growth))});
  CHECK(figure(lumped, "load") == doctest::Approx(figure(body, "load")).epsilon(3e-3));            // by its shape along
  CHECK(figure(lumped, "T_journal") == doctest::Approx(figure(body, "T_journal")).epsilon(1e-3));  // likewise
  CHECK(figure(lumped, "heat_to_journal") == doctest::Approx(heat).epsilon(5e-3));                 // likewise
}

TEST_CASE("ShellAndJournalInBodies_CarryALoadTogether") {
  const Written files;
  const BearingSolution both = solved(
      with_shaft({"bodies.ring.flexible.heat.expansion=12e-6 1/K", "bearings.main.grid={circumferential: 48, axial: 9}",
                  "bearings.main.operating_point={journal_speed: 2000 rpm, load: 5 kN}"},
                 "12e-6 1/K"),
      true);
  CHECK(both.grid_error.known);
  CHECK(figure(both, "load") == doctest::Approx(5000).epsilon(1e-9));  // Newton's tolerance, 1e-10
  CHECK(figure(both, "heat_balance_error") < 1e-8);                    // the film's residual
  CHECK(
      figure(both, "clearance_of_bodies") ==
      doctest::Approx(145 + figure(both, "bore_growth") - figure(both, "journal_growth")).epsilon(1e-9));  // round-off
  CHECK(both.summary.heat_iterations <= 30);
  const film::FilmFields fields = bearing::steady_fields(both.model, both.state);
  CHECK(1e6 * fields.h.minCoeff() ==
        doctest::Approx(figure(both, "h_min")).epsilon(0.02));  // between nodes it is smaller
}

TEST_CASE("JournalInABodyAtRest_IsRefused") {
  const Written files;
  try {
    (void)solved(
        with_shaft({"bearings.main.thermal.shell=insulated", "bearings.main.operating_point.journal_speed=0 rpm",
                    "bearings.main.operating_point.shell_speed=100 rpm"},
                   "0 1/K"));
    FAIL("no fault");
  } catch (const InputError& error) {
    const std::string what = error.what();
    CAPTURE(what);
    CHECK(what.find("operating_point.journal_speed: a journal at rest, whose temperatures are those of a body") !=
          std::string::npos);
    CHECK(what.find("because it rotates") != std::string::npos);
  }
  const auto total = solve_bearings("heated_body_test.yaml", {{with_shaft({}, "0 1/K"), "", "", {}}},
                                    {.bearing = "", .thermal_coefficients = ThermalCoefficients::total});
  CHECK_FALSE(total.at(0).solved());
  CHECK(total.at(0).message.find("'total' of surfaces that deform") != std::string::npos);
}

TEST_CASE("ShellInABodyThatRotates_IsRefused") {
  const Written files;
  CHECK_THROWS_AS((void)solved({"bearings.main.operating_point.shell_speed=10 rad/s"}), InputError);
}

}  // namespace heated_body_test
}  // namespace hersey::study
