#include <doctest/doctest.h>

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

bool tells(const std::string& oil, const std::string& thermal, const std::string& what) {
  const std::string told = faults_of(with(oil, thermal));
  CAPTURE(told);
  CHECK(told.find(what) != std::string::npos);
  return told.find(what) != std::string::npos;
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
  // A grade's numbers give way to those of the file, key by key.
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

TEST_CASE("TemperaturesBeyondWhatIsKnown_AreWarnedOf") {
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  CHECK(warned("grade: iso_vg_46", "model: film, supply_temperature: 50 degC").empty());
  CHECK(has(warned("grade: iso_vg_46", "model: film, supply_temperature: -30 degC"),
            "-30 degC is below -21 degC, the pour point typical of iso_vg_46"));
  CHECK(has(warned("grade: iso_vg_46, temperature: 230 degC", ""), "220 degC, the flash point typical of iso_vg_46"));
  const std::string table =
      "viscosity: {law: table, temperatures: [40 degC, 80 degC], viscosities: [30 mPa.s, 9 mPa.s]}";
  CHECK(
      has(warned(table, "model: isothermal, temperature: 90 degC"), "90 degC is above 80 degC, the end of its table"));
  // What only the film tells.
  const OilValidity validity = read_bearing("grade: iso_vg_46", "model: film, supply_temperature: 50 degC").validity;
  CHECK(doubts_of_film(validity, 273.15 + 150, 1e7).empty());
  REQUIRE(doubts_of_film(validity, 273.15 + 230, 1e7).size() == 1);
  CHECK(has(doubts_of_film(validity, 273.15 + 230, 1e7).front(), "flash point"));
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
  const film::Lubricant hot = of("grade: sae_5w_30, temperature: 150 degC");
  CHECK(hot.mu0 * hot.shear_thinning.ratio(1e6, hot.mu0).value == relative(3.1e-3).epsilon(1e-9));  // of 150 degC in K
  CHECK(of("grade: sae_5w_30, temperature: 150 degC, shear_thinning: none").shear_thinning.is_newtonian());
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

TEST_CASE("Mistakes_InOilsAndHeat_AreTold") {
  CHECK(tells("grade: iso_vg_47, temperature: 50 degC", "", "did you mean 'iso_vg_46'"));
  CHECK(tells("density: 850 kg/m^3", "", "a lubricant without a viscosity"));
  CHECK(tells("grade: iso_vg_46", "", "viscosity falls with temperature, and no temperature"));
  CHECK(tells("viscosity: {law: walther, nu40: 6 mm^2/s, nu100: 46 mm^2/s}, temperature: 50 degC", "",
              "are both in the wrong order?"));
  CHECK(
      tells("viscosity: {law: table, temperatures: [40 degC, 60 degC], viscosities: [10 mPa.s, 12 mPa.s]}, "
            "temperature: 50 degC",
            "", "an oil that thickens as it is heated"));
  CHECK(
      tells("viscosity: {law: table, temperatures: [60 degC, 40 degC], viscosities: [10 mPa.s, 9 mPa.s]}, "
            "temperature: 50 degC",
            "", "temperatures that ascend"));
  CHECK(tells("grade: iso_vg_46",
              "model: film, supply_temperature: 50 degC, shell: {wall: ring, outer_diameter: 90 mm, "
              "ambient: 20 degC}",
              "a ring no larger than its bore"));
  CHECK(tells("grade: iso_vg_46", "model: global", "nothing that takes the heat away"));
  const auto tabled = [](const std::string& rows) {
    return "temperature: 50 degC, viscosity: {law: table, temperatures: [40 degC, 80 degC], " + rows + "}";
  };
  CHECK(tells(tabled("pressures: [0 MPa, 100 MPa], viscosities: [[30 mPa.s, 90 mPa.s], [9 mPa.s]]"), "",
              "a list of 2, one for each pressure"));
  CHECK(tells(tabled("viscosities: [[30 mPa.s, 90 mPa.s], [9 mPa.s, 20 mPa.s]]"), "", "'pressures' of the table"));
  CHECK(tells(tabled("pressures: [1 MPa, 100 MPa], viscosities: [[30 mPa.s, 90 mPa.s], [9 mPa.s, 20 mPa.s]]"), "",
              "a first pressure that is not 0"));
  CHECK(tells(tabled("pressures: [0 MPa, 100 MPa], viscosities: [[30 mPa.s, 20 mPa.s], [9 mPa.s, 20 mPa.s]]"), "",
              "an oil that thins under pressure"));
  CHECK(tells(tabled("pressures: [0 MPa, 100 MPa], viscosities: [[30 mPa.s, 90 mPa.s], [9 mPa.s, 95 mPa.s]]"), "",
              "an oil that thickens as it is heated"));
  CHECK(tells(tabled("pressures: [0 MPa, 100 MPa], viscosities: [[30 mPa.s, 90 mPa.s], [9 mPa.s, 20 mPa.s]]") +
                  ", pressure_viscosity: 1e-8 1/Pa",
              "", "a second law of pressure"));
  const auto sheared = [](const std::string& law) { return "viscosity: 10 mPa.s, shear_thinning: {" + law + "}"; };
  CHECK(
      tells(sheared("law: cross, exponent: 0.8"), "", "none of the keys 'critical_shear_rate' and 'critical_stress'"));
  CHECK(tells(sheared("law: cross, exponent: 0.8, critical_stress: 1 kPa, limit_ratio: 0.5, limit_viscosity: 5 mPa.s"),
              "", "two limits of the same oil"));
  CHECK(tells(sheared("law: cross, exponent: 0.8, critical_stress: 1 kPa, limit_viscosity: 12 mPa.s"), "",
              "a limit above the viscosity at rest, 10 mPa.s"));
  CHECK(tells(sheared("law: cross, exponent: 2, critical_stress: 1 kPa, limit_ratio: 0.1"), "",
              "an exponent of at most 1, or with this one a limit_ratio above 0.111"));
  CHECK(
      tells("grade: iso_vg_46, shear_thinning: {law: cross, exponent: 0.8, critical_stress: 1 kPa, limit_viscosity: 5 "
            "mPa.s}",
            "model: isothermal, temperature: 50 degC", "a `temperature` of the lubricant, or a 'limit_ratio'"));
  CHECK(tells(
      "grade: iso_vg_46",
      "model: film, supply_temperature: 50 degC}\n    edge_pressure: closed\n    cavitation: {model: mass_conserving",
      "it has nowhere to go"));
  CHECK(tells("grade: iso_vg_46", "model: film, supply_temperature: 50 degC}\n    cavitation: {model: reynolds",
              "`carry_over: 0`"));
}

}  // namespace thermal_test
}  // namespace hersey::model
