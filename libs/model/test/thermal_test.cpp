#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <variant>

#include "hersey/model/oil_grades.h"
#include "model_text.h"
#include "relative.h"

// Oils over temperature and the heat of films, as a model file has them.
namespace hersey::model {
namespace thermal_test {

// Digits of the conversion of units.
constexpr double digits = 1e-12;

std::string with(const std::string& oil, const std::string& thermal) {
  return "hersey: 1\nlubricants:\n  oil: {" + oil +
         "}\nbearings:\n  main:\n    diameter: 100 mm\n    width: 50 mm\n    radial_clearance: 50 um\n    lubricant: "
         "oil\n"
         "    supply: {line: 0 deg, pressure: 1 bar}\n" +
         (thermal.empty() ? "" : "    thermal: {" + thermal + "}\n");
}

Bearing read_bearing(const std::string& oil, const std::string& thermal) {
  return read_text(with(oil, thermal), "m.yaml").bearings.at(0);
}

bool reports(const std::string& oil, const std::string& thermal, const std::string& what) {
  const std::string faults_after = faults_of(with(oil, thermal));
  CAPTURE(faults_after);
  CHECK(faults_after.find(what) != std::string::npos);
  return faults_after.find(what) != std::string::npos;
}

TEST_CASE("Oils_HaveTheViscosityOfTheirTemperature") {
  // ISO VG 32 at 60 degC, ASTM D341 by an independent program: 12.722 mPa.s.
  CHECK(read_bearing("grade: iso_vg_32, temperature: 60 degC", "").film.lubricant.mu0 ==
        relative(0.012722091814).epsilon(1e-9));
  CHECK(read_bearing("grade: iso_vg_32", "model: isothermal, temperature: 60 degC").film.lubricant.mu0 ==
        relative(0.012722091814).epsilon(1e-9));  // the program's digits
  const auto mu_at_60 = [](const std::string& law) {
    return read_bearing("temperature: 60 degC, viscosity: {" + law + "}", "").film.lubricant.mu0;
  };
  CHECK(mu_at_60("law: exponential, viscosity: 20 mPa.s, reference: 40 degC, coefficient: 0.03 1/K") ==
        relative(0.02 * std::exp(-0.6)).epsilon(digits));
  CHECK(mu_at_60("law: vogel, a: 6e-5 Pa.s, b: 850 K, c: 100 K") ==
        relative(6e-5 * std::exp(850 / 233.15)).epsilon(digits));
  CHECK(mu_at_60("law: walther, nu40: 32 mm^2/s, nu100: 5.4 mm^2/s") ==
        relative(0.012722091814 * 850 / 863).epsilon(1e-9));  // of the usual density
  CHECK(
      mu_at_60("law: table, temperatures: [40 degC, 60 degC, 100 degC], viscosities: [30 mPa.s, 14 mPa.s, 5 mPa.s]") ==
      relative(0.014).epsilon(digits));
  // A grade's numbers are overridden by those of the file, key by key.
  const film::Lubricant own =
      read_bearing("grade: iso_vg_32, density: 900 kg/m^3, temperature: 60 degC", "").film.lubricant;
  CHECK(own.mu0 == relative(0.012722091814 * 900 / 863).epsilon(1e-9));  // the program's digits
}

TEST_CASE("TablesOverPressure_AreRead") {
  const film::Lubricant oil =
      read_bearing(
          "temperature: 40 degC, viscosity: {law: table, temperatures: [40 degC, 80 degC], pressures: [0 MPa, 100 "
          "MPa], viscosities: [[30 mPa.s, 90 mPa.s], [9 mPa.s, 20 mPa.s]]}",
          "")
          .film.lubricant;
  CHECK(oil.mu0 == relative(0.03).epsilon(digits));
  CHECK(film::log_viscosity_ratio(oil, 50e6).value == relative(0.5 * std::log(3)).epsilon(digits));
  CHECK(film::log_viscosity_ratio(oil, 50e6, 0.009).value == relative(0.5 * std::log(20.0 / 9)).epsilon(digits));
}

TEST_CASE("DensityFalls_WhereTheOilExpands") {
  const auto density = [](const std::string& oil) { return read_bearing(oil, "").film.lubricant.density; };
  CHECK(density("viscosity: 10 mPa.s, density: 870 kg/m^3, temperature: 115 degC") == 870);
  CHECK(density("viscosity: 10 mPa.s, density: 870 kg/m^3, thermal_expansion: 7e-4 1/K, temperature: 115 degC") ==
        relative(870 * 0.93).epsilon(digits));
  CHECK(density("grade: iso_vg_46, temperature: 115 degC") == relative(869 * 0.935).epsilon(digits));
}

/// Warnings of a bearing.
std::string warned(const std::string& oil, const std::string& thermal) {
  std::string all;
  for (const Fault& warning : read_text(with(oil, thermal), "m.yaml").warnings) all += warning.text() + "\n";
  return all;
}

TEST_CASE("TemperaturesBeyondTheKnownRange_CauseAWarning") {
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  CHECK(warned("grade: iso_vg_46", "model: film, supply_temperature: 50 degC").empty());
  CHECK(has(warned("grade: iso_vg_46", "model: film, supply_temperature: -30 degC"),
            "-30 degC is below -21 degC, the pour point typical of iso_vg_46"));
  CHECK(has(warned("grade: iso_vg_46, temperature: 230 degC", ""), "220 degC, the flash point typical of iso_vg_46"));
  const std::string table =
      "viscosity: {law: table, temperatures: [40 degC, 80 degC], viscosities: [30 mPa.s, 9 mPa.s]}";
  CHECK(
      has(warned(table, "model: isothermal, temperature: 90 degC"), "90 degC is above 80 degC, the end of its table"));
  // Faults that only the film reports.
  const OilValidity validity = read_bearing("grade: iso_vg_46", "model: film, supply_temperature: 50 degC").validity;
  CHECK(film_warnings(validity, 273.15 + 150, 1e7).empty());
  REQUIRE(film_warnings(validity, 273.15 + 230, 1e7).size() == 1);
  CHECK(has(film_warnings(validity, 273.15 + 230, 1e7).front(), "flash point"));
}

TEST_CASE("ShearThinning_IsRead") {
  const auto of = [](const std::string& oil) { return read_bearing(oil, "").film.lubricant; };
  const film::ShearThinning cross = of("viscosity: 10 mPa.s, shear_thinning: {law: cross, limit_viscosity: 6 mPa.s, "
                                       "critical_shear_rate: 1e6 1/s, exponent: 0.8}")
                                        .shear_thinning;
  CHECK(0.01 * cross.ratio(1e5, 0.01).value == relative(0.009452772445587159).epsilon(digits));
  const film::ShearThinning carreau = of("viscosity: 10 mPa.s, shear_thinning: {law: carreau, limit_ratio: 0.25, "
                                         "critical_stress: 10 kPa, exponent: 0.7, transition: 1.5}")
                                          .shear_thinning;
  CHECK(carreau.ratio(1e6, 0.01).value == relative(0.25 + 0.75 * std::pow(2, -0.2)).epsilon(digits));
  // A grade's own, through its viscosity at high shear; none where it is said, nor of an oil without polymers.
  const film::Lubricant hot = of("grade: sae_5w30, temperature: 150 degC");
  CHECK(hot.mu0 * hot.shear_thinning.ratio(1e6, hot.mu0).value == relative(3.1e-3).epsilon(1e-9));  // of 150 degC in K
  CHECK(of("grade: sae_5w30, temperature: 150 degC, shear_thinning: none").shear_thinning.is_newtonian());
  CHECK(of("grade: sae_30, temperature: 150 degC").shear_thinning.is_newtonian());
}

TEST_CASE("Grades_AreThoseOfTheirStandards") {
  for (const OilGrade& grade : oil_grades()) {
    CAPTURE(grade.name);
    const std::string name(grade.name);
    if (name.starts_with("iso_vg_")) CHECK(grade.nu40 == relative(1e-6 * std::stod(name.substr(7))).epsilon(digits));
    // SAE J300 (2015): limits of the viscosity at 100 degC.
    if (name.ends_with("_16")) CHECK((6.1e-6 <= grade.nu100 && grade.nu100 < 8.2e-6));
    if (name.ends_with("_30")) CHECK((9.3e-6 <= grade.nu100 && grade.nu100 < 12.5e-6));
    if (name.ends_with("_40")) CHECK((12.5e-6 <= grade.nu100 && grade.nu100 < 16.3e-6));
    if (name.ends_with("_50") && !name.starts_with("iso")) CHECK((16.3e-6 <= grade.nu100 && grade.nu100 < 21.9e-6));
    if (name.ends_with("_60")) CHECK((21.9e-6 <= grade.nu100 && grade.nu100 < 26.1e-6));
    CHECK(grade.nu40 > grade.nu100);
    // Least viscosity at 150 degC and 1e6 1/s; that at rest lies above, by no more than polymers add.
    if (grade.hths == 0) continue;
    const auto below = [&](const char* end, double least) { return name.ends_with(end) && grade.hths < least; };
    const bool is_light = name.starts_with("sae_0") || name.starts_with("sae_5") || name.starts_with("sae_10");
    CHECK(!(below("_16", 2.3e-3) || below("_20", 2.6e-3) || below("_30", 2.9e-3)));
    CHECK(!(below("_40", is_light ? 3.5e-3 : 3.7e-3) || below("_50", 3.7e-3)));
    CHECK(grade.shear_thinning().critical_stress > 2e3);
    CHECK(grade.shear_thinning().critical_stress < 40e3);
    CHECK(grade.pour_point < grade.flash_point);
  }
}

TEST_CASE("EverythingAboutHeat_IsRead") {
  const Bearing bearing = read_bearing(
      "grade: iso_vg_46, specific_heat: 1900 J/kg/K, conductivity: 0.14 W/m/K",
      "model: film, supply_temperature: 50 degC, edge_temperature: 30 degC, layers: 7, carry_over: 0.8, shell: {wall: "
      "ring, outer_diameter: 160 mm, conductivity: 40 W/m/K, heat_transfer: 25 W/m^2/K, ambient: 20 degC}, journal: "
      "{wall: given, temperature: 70 degC}");
  const auto& heat = std::get<film::ThermalModel>(bearing.heat);
  CHECK(heat.layers == 7);
  CHECK(heat.T_supply == relative(323.15).epsilon(digits));
  CHECK(heat.T_edges == relative(303.15).epsilon(digits));
  CHECK(heat.carry_over == 0.8);
  const auto& ring = std::get<film::RingWall>(heat.shell);
  CHECK(ring.outer_radius == relative(0.08).epsilon(digits));
  CHECK(ring.conductivity == 40);
  CHECK(ring.transfer == 25);
  CHECK(ring.T_ambient == relative(293.15).epsilon(digits));
  CHECK(std::get<film::WallAtTemperature>(heat.journal).T == relative(343.15).epsilon(digits));
  CHECK(bearing.film.lubricant.specific_heat == 1900);
  CHECK(bearing.film.lubricant.conductivity == 0.14);
  // The film's own viscosity is that of the oil as supplied.
  CHECK(bearing.film.lubricant.mu0 == read_bearing("grade: iso_vg_46, temperature: 50 degC", "").film.lubricant.mu0);
}

TEST_CASE("MaterialsThatRub_AreRead") {
  const auto with_materials = [](const std::string& shell) {
    return "model: film, supply_temperature: 50 degC}\n    materials: {shell: {youngs_modulus: 60 GPa, poisson_ratio: "
           "0.3" +
           shell + "}, journal: {youngs_modulus: 210 GPa, poisson_ratio: 0.3}";
  };
  const Bearing bearing = read_bearing(
      "grade: iso_vg_46", with_materials(", density: 7300 kg/m^3, conductivity: 55 W/m/K, specific_heat: 230 J/kg/K"));
  const auto& heat = std::get<film::ThermalModel>(bearing.heat);
  CHECK(heat.shell_surface.effusivity() == relative(std::sqrt(55 * 7300 * 230.0)).epsilon(digits));
  CHECK(heat.journal_surface.effusivity() == relative(std::sqrt(50 * 3.6e6)).epsilon(digits));  // steel
  CHECK(reports("grade: iso_vg_46", with_materials(", conductivity: 55 W/m/K, specific_heat: 230 J/kg/K"),
                "a `specific_heat` and no `density`"));
  CHECK(reports("grade: iso_vg_46", with_materials(", density: 7300 kg/m^3, conductivity: 55 W/m/K"), "specific_heat"));
}

TEST_CASE("Mistakes_InOilsAndHeat_AreReported") {
  CHECK(reports("grade: iso_vg_47, temperature: 50 degC", "", "did you mean 'iso_vg_46'"));
  CHECK(reports("density: 850 kg/m^3", "", "a lubricant without a viscosity"));
  CHECK(reports("grade: iso_vg_46", "", "viscosity falls with temperature, and no temperature"));
  CHECK(reports("viscosity: {law: walther, nu40: 6 mm^2/s, nu100: 46 mm^2/s}, temperature: 50 degC", "",
                "are both in the wrong order?"));
  CHECK(
      reports("viscosity: {law: table, temperatures: [40 degC, 60 degC], viscosities: [10 mPa.s, 12 mPa.s]}, "
              "temperature: 50 degC",
              "", "an oil that thickens as it is heated"));
  CHECK(
      reports("viscosity: {law: table, temperatures: [60 degC, 40 degC], viscosities: [10 mPa.s, 9 mPa.s]}, "
              "temperature: 50 degC",
              "", "temperatures that ascend"));
  CHECK(reports("grade: iso_vg_46",
                "model: film, supply_temperature: 50 degC, shell: {wall: ring, outer_diameter: 90 mm, "
                "ambient: 20 degC}",
                "a ring no larger than its bore"));
  CHECK(reports("grade: iso_vg_46", "model: global", "nothing that takes the heat away"));
  const auto tabled = [](const std::string& rows) {
    return "temperature: 50 degC, viscosity: {law: table, temperatures: [40 degC, 80 degC], " + rows + "}";
  };
  CHECK(reports(tabled("pressures: [0 MPa, 100 MPa], viscosities: [[30 mPa.s, 90 mPa.s], [9 mPa.s]]"), "",
                "a list of 2, one for each pressure"));
  CHECK(reports(tabled("viscosities: [[30 mPa.s, 90 mPa.s], [9 mPa.s, 20 mPa.s]]"), "", "'pressures' of the table"));
  CHECK(reports(tabled("pressures: [1 MPa, 100 MPa], viscosities: [[30 mPa.s, 90 mPa.s], [9 mPa.s, 20 mPa.s]]"), "",
                "a first pressure that is not 0"));
  CHECK(reports(tabled("pressures: [0 MPa, 100 MPa], viscosities: [[30 mPa.s, 20 mPa.s], [9 mPa.s, 20 mPa.s]]"), "",
                "an oil that thins under pressure"));
  CHECK(reports(tabled("pressures: [0 MPa, 100 MPa], viscosities: [[30 mPa.s, 90 mPa.s], [9 mPa.s, 95 mPa.s]]"), "",
                "an oil that thickens as it is heated"));
  CHECK(reports(tabled("pressures: [0 MPa, 100 MPa], viscosities: [[30 mPa.s, 90 mPa.s], [9 mPa.s, 20 mPa.s]]") +
                    ", pressure_viscosity: 1e-8 1/Pa",
                "", "a second law of pressure"));
  const auto sheared = [](const std::string& law) { return "viscosity: 10 mPa.s, shear_thinning: {" + law + "}"; };
  CHECK(reports(sheared("law: cross, exponent: 0.8"), "",
                "none of the keys 'critical_shear_rate' and 'critical_stress'"));
  CHECK(
      reports(sheared("law: cross, exponent: 0.8, critical_stress: 1 kPa, limit_ratio: 0.5, limit_viscosity: 5 mPa.s"),
              "", "two limits of the same oil"));
  CHECK(reports(sheared("law: cross, exponent: 0.8, critical_stress: 1 kPa, limit_viscosity: 12 mPa.s"), "",
                "a limit above the viscosity at rest, 10 mPa.s"));
  CHECK(reports(sheared("law: cross, exponent: 2, critical_stress: 1 kPa, limit_ratio: 0.1"), "",
                "an exponent of at most 1, or with this one a limit_ratio above 0.111"));
  // Layers share the film's stress; a film in one layer has its rate from its surfaces.
  const std::string stops = ", specific_heat: 1900 J/kg/K, conductivity: 0.14 W/m/K";
  for (const std::string law : {"law: carreau, exponent: 0.05", "law: cross, exponent: 1"}) {
    const std::string oil = sheared(law + ", critical_stress: 1 kPa") + stops;
    CHECK(reports(oil, "model: film, supply_temperature: 50 degC", "stress all but stops rising"));
    CHECK_NOTHROW(read_bearing(oil, "model: film, supply_temperature: 50 degC, layers: 1"));
    const std::string risen = sheared(law + ", critical_stress: 1 kPa, limit_ratio: 1e-4") + stops;
    CHECK_NOTHROW(read_bearing(risen, "model: film, supply_temperature: 50 degC"));
  }
  CHECK(reports(
      "grade: iso_vg_46, shear_thinning: {law: cross, exponent: 0.8, critical_stress: 1 kPa, limit_viscosity: 5 "
      "mPa.s}",
      "model: isothermal, temperature: 50 degC", "a `temperature` of the lubricant, or a 'limit_ratio'"));
  CHECK(reports(
      "grade: iso_vg_46",
      "model: film, supply_temperature: 50 degC}\n    edge_pressure: closed\n    cavitation: {model: mass_conserving",
      "no heat can leave"));
  CHECK(reports("grade: iso_vg_46", "model: film, supply_temperature: 50 degC}\n    cavitation: {model: reynolds",
                "`carry_over: 0`"));
}

std::string film_with(const std::string& supply, const std::string& more, const std::string& thermal) {
  return "hersey: 1\nlubricants:\n  oil: {grade: iso_vg_46, temperature: 60 degC}\nbearings:\n  main:\n    diameter: "
         "100 mm\n    width: 50 mm\n    radial_clearance: 50 um\n    lubricant: oil\n    grid: {circumferential: 8, "
         "axial: 9}\n    supply: {line: 0 deg, pressure: 1 bar" +
         supply + "}\n    thermal: {" + thermal + "}\n" + more;
}

bool has_fault(const std::string& text, const std::string& what) {
  const std::string faults_after = faults_of(text);
  CAPTURE(faults_after);
  CHECK(faults_after.find(what) != std::string::npos);
  return faults_after.find(what) != std::string::npos;
}

const std::string hot_film = "model: film, supply_temperature: 50 degC";

TEST_CASE("Supplies_HaveTemperaturesOfTheirOwn") {
  const std::string features =
      "    features:\n"
      "      inlet: {shape: axial_groove, angle: 90 deg, arc: 140 deg, length: 30 mm, pressure: 1 bar, temperature: 35 "
      "degC}\n"
      "      other: {shape: axial_groove, on: journal, angle: 270 deg, arc: 140 deg, length: 30 mm, pressure: 1 bar}\n";
  const Model model = read_text(film_with(", temperature: 40 degC", features, hot_film), "m.yaml");
  const auto& heat = std::get<film::ThermalModel>(model.bearings.at(0).heat);
  CHECK(heat.T_line.value() == relative(313.15).epsilon(digits));
  REQUIRE(heat.T_features.size() == 2);
  CHECK(heat.T_features[0] == relative(308.15).epsilon(digits));
  CHECK(heat.T_features[1] == heat.T_supply);
  CHECK(model.warnings.empty());
  // The warning is given for supplies that need no temperature, and for a pocket that contains the film's own oil.
  const Model isothermal = read_text(film_with(", temperature: 40 degC", features, "model: isothermal"), "m.yaml");
  REQUIRE(isothermal.warnings.size() == 2);
  CHECK(isothermal.warnings[0].text().find("does not ask for") != std::string::npos);
  CHECK(has_fault(film_with("",
                            "    features:\n      pocket: {shape: pocket, angle: 90 deg, arc: 140 deg, length: 30 mm, "
                            "depth: 0.1 mm, temperature: 35 degC}\n",
                            hot_film),
                  "a pocket that nothing feeds"));
}

TEST_CASE("ShellsTemperature_OverTheAngle_IsRead") {
  const auto around = [](const std::string& table) {
    const Model model =
        read_text(film_with("", "", hot_film + ", shell: {wall: given, temperature: {" + table + "}}"), "m.yaml");
    return std::get<film::WallAtTemperature>(std::get<film::ThermalModel>(model.bearings.at(0).heat).shell).around;
  };
  // Eight nodes around: 0, 45, ... 315 deg. Straight lines, also from the last row to the first.
  const Eigen::VectorXd T = around("angles: [45 deg, 135 deg, 225 deg], temperatures: [50 degC, 70 degC, 60 degC]");
  const std::vector<double> wanted{52.5, 50, 60, 70, 65, 60, 57.5, 55};
  REQUIRE(T.size() == 8);
  for (int i = 0; i < 8; ++i) CHECK(T[i] - 273.15 == relative(wanted[static_cast<std::size_t>(i)]).epsilon(digits));
  const auto refused = [](const std::string& table, const std::string& what) {
    return has_fault(film_with("", "", hot_film + ", shell: {wall: given, temperature: {" + table + "}}"), what);
  };
  CHECK(refused("angles: [45 deg, 135 deg], temperatures: [50 degC]", "1 temperatures at 2 angles"));
  CHECK(refused("angles: [145 deg, 135 deg], temperatures: [50 degC, 60 degC]", "angles that ascend"));
  CHECK(refused("angles: [0 deg, 360 deg], temperatures: [50 degC, 50 degC]", "360 deg or more"));
}

TEST_CASE("Clearance_GrowsWithItsWalls") {
  const auto bearing = [](const std::string& thermal) {
    return read_text(film_with("", "", thermal), "m.yaml").bearings.at(0);
  };
  // R (alpha_S (T - 20) - alpha_J (T - 20)) with the oil's 60 degC of both walls.
  CHECK(bearing("model: isothermal, expansion: {shell: 23e-6 1/K, journal: 12e-6 1/K}").growth ==
        relative(0.05 * 11e-6 * 40).epsilon(digits));
  CHECK(bearing("model: isothermal, expansion: {shell: 12e-6 1/K, journal: 12e-6 1/K, reference: 30 degC, "
                "journal_temperature: 90 degC}")
            .growth == relative(0.05 * 12e-6 * (30 - 60)).epsilon(digits));
  const Bearing hot = bearing(hot_film + ", expansion: {shell: 23e-6 1/K, journal: 12e-6 1/K}");
  CHECK(hot.growth == 0);
  CHECK(std::get<film::ThermalModel>(hot.heat).expansion->shell == 23e-6);
  CHECK(has_fault(film_with("", "",
                            "model: isothermal, expansion: {shell: 12e-6 1/K, journal: 23e-6 1/K, "
                            "journal_temperature: 120 degC}"),
                  "a seizure: a clearance of 50 um that closes"));
  CHECK(has_fault(film_with("", "", hot_film + ", expansion: {shell: 12e-6 1/K}"), "missing key 'journal'"));
}

const std::string network =
    "thermal:\n  nodes:\n    block: {heat_capacity: 20 kJ/K, temperature: 30 degC}\n    shaft: {heat_capacity: 2 "
    "kJ/K}\n    room: {fixed: 25 degC}\n  paths:\n    housing: {between: [block, room], conductance: 5 W/K}\n    "
    "stub: {between: [shaft, room], conductance: 1 W/K}\n";

TEST_CASE("WallsAreNodesOfANetwork") {
  const std::string walls = ", shell: {wall: node, node: block}, journal: {wall: node, node: shaft}";
  const Model model = read_text(film_with("", network, hot_film + walls), "m.yaml");
  const film::ThermalNetworkModel& read = model.thermal.network;
  REQUIRE(read.nodes.size() == 3);
  CHECK(read.nodes[0].heat_capacity == 20e3);
  CHECK(read.nodes[1].T == relative(293.15).epsilon(digits));
  CHECK(read.nodes[2].is_fixed);
  REQUIRE(read.paths.size() == 2);
  CHECK(read.paths[1].conductance == 1);
  const auto& heat = std::get<film::ThermalModel>(model.bearings.at(0).heat);
  CHECK(std::get<film::NodeWall>(heat.shell).node == 0);
  CHECK(std::get<film::NodeWall>(heat.shell).T == relative(303.15).epsilon(digits));
  CHECK(std::get<film::NodeWall>(heat.journal).node == 1);
  CHECK(model.warnings.empty());
}

TEST_CASE("OilAndSurroundings_AreNodesOfANetwork") {
  const std::string ring = ", shell: {wall: ring, outer_diameter: 160 mm, ambient: {node: block}}, drains_to: shaft";
  const Model model =
      read_text(film_with(", temperature: {node: room}", network,
                          "model: film, supply_temperature: {node: block}, edge_temperature: 40 degC" + ring),
                "m.yaml");
  const auto& heat = std::get<film::ThermalModel>(model.bearings.at(0).heat);
  CHECK(heat.T_supply == relative(303.15).epsilon(digits));
  CHECK(heat.oil.line->node == 2);
  CHECK(!heat.oil.edges);
  CHECK(heat.T_edges == relative(313.15).epsilon(digits));
  CHECK(heat.oil.drain->node == 1);
  CHECK(std::get<film::RingWall>(heat.shell).surroundings->node == 0);
  CHECK(std::get<film::RingWall>(heat.shell).T_ambient == relative(303.15).epsilon(digits));
  CHECK(model.warnings.empty());
  CHECK(has_fault(film_with("", network, "model: film, supply_temperature: {node: sump}"),
                  "unknown thermal node 'sump'"));
  CHECK(has_fault(film_with("", network, hot_film + ", drains_to: rom"), "did you mean 'room'"));
}

TEST_CASE("Mistakes_InTheThermalNetwork_AreReported") {
  const std::string wall = ", shell: {wall: node, node: ";
  CHECK(has_fault(film_with("", network, hot_film + wall + "blok}"), "did you mean 'block'"));
  CHECK(has_fault(film_with("", "", hot_film + wall + "block}"), "the model has no `thermal"));
  CHECK(has_fault(film_with("", network + "    self: {between: [room, room], conductance: 1 W/K}\n", hot_film),
                  "from a node to itself"));
  CHECK(has_fault(film_with("", "thermal:\n  nodes:\n    a: {temperature: 20 degC}\n", hot_film), "none of the keys"));
  CHECK(has_fault(film_with("", "thermal:\n  nodes:\n    a: {fixed: 20 degC, temperature: 30 degC}\n", hot_film),
                  "`fixed` alone"));
  const Model lonely =
      read_text(film_with("", "thermal:\n  nodes:\n    a: {heat_capacity: 20 J/K}\n", hot_film), "m.yaml");
  REQUIRE(lonely.warnings.size() == 1);
  CHECK(lonely.warnings[0].text().find("no path and no bearing leads to") != std::string::npos);
}

}  // namespace thermal_test
}  // namespace hersey::model
