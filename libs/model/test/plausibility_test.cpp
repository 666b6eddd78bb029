#include "hersey/model/plausibility.h"

#include <doctest/doctest.h>

#include <limits>

#include "model_text.h"

namespace hersey::model {
namespace plausibility_test {

const std::string text = R"(hersey: 1
lubricants:
  oil: {viscosity: 15 mPa.s}
bearings:
  main:
    diameter: 45 mm
    width: 15 mm
    radial_clearance: 34 um
    lubricant: oil
    edge_pressure: 1 bar
)";

Bearing bearing_with(const std::string& keys) {
  return read_text(edited(text, "lubricant: oil", "lubricant: oil\n    " + keys), "m.yaml").bearings[0];
}

std::string warnings(const Bearing& bearing, double p_max, double h_min) {
  std::string all;
  for (const std::string& warning : surface_warnings(bearing, p_max, h_min)) all += warning + "\n";
  return all;
}

TEST_CASE("PeakPressure_IsComparedWithThePermissibleOne") {
  const Bearing plain = bearing_with("cavitation: mass_conserving");
  CHECK(warnings(plain, 199e6, 1e-6).empty());
  CHECK(
      warnings(plain, 210e6, 1e-6).starts_with("its peak pressure: 210 MPa is above what layers of bearings usually"));
  const Bearing white_metal = bearing_with("permissible_pressure: 30 MPa");
  CHECK(warnings(white_metal, 30e6, 1e-6).empty());
  CHECK(warnings(white_metal, 31e6, 1e-6) ==
        "its peak pressure: 31 MPa is above its permissible_pressure, 30 MPa; elastic surfaces spread it "
        "(`shell_surface`, or `compliance`)\n");
  const Bearing hard =
      bearing_with("permissible_pressure: 400 MPa\n    compliance: {model: column, composite_modulus: 70 GPa}");
  CHECK(warnings(hard, 390e6, 1e-6).empty());
  CHECK(warnings(hard, 410e6, 1e-6).ends_with("permissible_pressure, 400 MPa; lower the load or give more width\n"));
}

TEST_CASE("FilmThatIsNotLaminar_IsReportedUnlessItIsComputedAsTurbulent") {
  const Bearing plain = bearing_with("cavitation: mass_conserving");
  CHECK(regime_warnings(plain, 890, 1).empty());
  REQUIRE(regime_warnings(plain, 1200, 0.75).size() == 1);
  CHECK(regime_warnings(plain, 1200, 0.75)[0].starts_with(
      "25 % of the film lies above a Reynolds number of 900, where films cease to be laminar (largest: 1200)"));
  CHECK(regime_warnings(bearing_with("turbulence: ng_pan"), 1200, 0.75).empty());
}

TEST_CASE("SmallestFilm_IsComparedWithTheRoughness") {
  const Bearing plain = bearing_with("cavitation: mass_conserving");
  CHECK(warnings(plain, 1e6, 0.11e-6).empty());
  CHECK(warnings(plain, 1e6, 0.09e-6).starts_with("its smallest film: 0.09 um is below the roughness of the finest"));
  const Bearing rough = bearing_with("roughness: {shell: {sigma: 0.4 um}, journal: {sigma: 0.3 um}}");
  CHECK(warnings(rough, 1e6, 0.51e-6).empty());
  CHECK(
      warnings(rough, 1e6, 0.49e-6).starts_with("its smallest film: 0.49 um is below the roughness, 0.5 um: the surf"));
  // A film that never was has no smallest gap.
  CHECK(warnings(plain, 0, std::numeric_limits<double>::infinity()).empty());
}

std::string warnings_of(const std::string& model) {
  std::string all;
  for (const Fault& warning : read_text(model, "m.yaml").warnings) all += warning.text() + "\n";
  return all;
}

TEST_CASE("Viscosities_FarFromTheUsual_AreWarnedOf") {
  for (const char* usual : {"0.3 mPa.s", "15 cP", "9 Pa.s"}) {
    CAPTURE(usual);
    CHECK(warnings_of(edited(text, "15 mPa.s", usual)).empty());
  }
  CHECK(
      warnings_of(edited(text, "15 mPa.s", "15 Pa.s"))
          .starts_with("m.yaml:3:20: lubricants.oil.viscosity: a viscosity of 1.5e+04 mPa.s, far from what is usual"));
  CHECK(warnings_of(edited(text, "15 mPa.s", "0.015 mPa.s")).find("a viscosity of 0.015 mPa.s") != std::string::npos);
  // Quantities that follow from a law are evaluated at the oil's temperature.
  const std::string law = "{law: exponential, viscosity: 40 Pa.s, reference: 40 degC, coefficient: 0.03 1/K}";
  CHECK(warnings_of(edited(text, "15 mPa.s", law + ", temperature: 100 degC")).empty());
  CHECK(warnings_of(edited(text, "15 mPa.s", law + ", temperature: 40 degC")).find("a viscosity of 4e+04 mPa.s") !=
        std::string::npos);
}

TEST_CASE("Clearances_FarFromTheUsual_AreWarnedOf") {
  CHECK(warnings_of(edited(text, "34 um", "200 um")).empty());
  CHECK(warnings_of(edited(text, "34 um", "340 um")).find("a radial clearance of 340 um") != std::string::npos);
  CHECK(warnings_of(edited(text, "34 um", "3.4 um")).find("a radial clearance of 3.4 um") != std::string::npos);
}

}  // namespace plausibility_test
}  // namespace hersey::model
