#include "hersey/study/sensitivity.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "source_dir.h"

namespace hersey::study {
namespace sensitivity_test {

// Solutions to 1e-10 of the load over steps of 1e-4 to both sides; on longer ones fronts pass nodes of the grid.
constexpr double kDifferences = 1e-6;
// Solutions whose temperatures are found to 1e-8, over the same steps.
constexpr double kHotDifferences = 1e-4;

const std::string alone = std::string(hersey::source_dir()) + "/examples/bearing_alone/model.yaml";
const std::string hot = std::string(hersey::source_dir()) + "/examples/hot_bearing/global.yaml";
// At a load under which a rigid rotor whirls.
const std::vector<std::string> coarse{"bearings.main.grid={circumferential: 48, axial: 9}", "load=300 N"};

BearingSolution solved(const std::string& path, std::vector<std::string> overrides, const std::string& further = {}) {
  if (!further.empty()) overrides.push_back(further);
  auto solutions = solve_bearings(path, {{overrides, "", "", {}}}, {.bearing = "", .grid_error = false});
  CAPTURE(solutions.at(0).message);
  REQUIRE(solutions.at(0).solved());
  return solutions.front();
}

double value_of(const BearingSolution& solution, const std::string& key) {
  for (const BearingFigure& figure : figures_of(solution))
    if (figure.key == key) return figure.si * figure.value;
  return std::nan("");
}

void check(const std::string& path, const std::vector<std::string>& overrides, const Sensitivity& found,
           const std::string& below, const std::string& above, double distance, double tolerance) {
  const BearingSolution here = solved(path, overrides), less = solved(path, overrides, below),
                        more = solved(path, overrides, above);
  const std::vector<BearingFigure> figures = figures_of(here);
  for (const char* key : {"h_min", "p_max", "eccentricity_ratio", "attitude", "torque_journal", "power_film",
                          "side_flow", "stiffness_xx", "stiffness_xy", "damping_yy", "critical_mass"}) {
    CAPTURE(std::string(key));
    const auto at = std::find_if(figures.begin(), figures.end(), [&](const auto& f) { return f.key == key; });
    REQUIRE(at != figures.end());
    const double slope = found.slopes[static_cast<std::size_t>(at - figures.begin())];
    const double secant = (value_of(more, key) - value_of(less, key)) / distance;
    CHECK(std::abs(slope - secant) <= tolerance * (std::abs(slope) + std::abs(value_of(here, key) / found.value)));
  }
}

TEST_CASE("Sensitivities_AreThoseOfTwoSolutions") {
  const BearingSolution here = solved(alone, coarse);
  const auto found =
      sensitivities(alone, here, {}, {"bearings.main.radial_clearance", "bearings.main.asperities.roughness"});
  REQUIRE(found.size() == 2);
  CHECK(found[0].exact);
  CHECK(found[0].unit == "m");
  CHECK(found[0].value == doctest::Approx(34e-6).epsilon(1e-12));  // round-off of a unit
  check(alone, coarse, found[0], "bearings.main.radial_clearance=33.9966 um",
        "bearings.main.radial_clearance=34.0034 um", 0.0068e-6, kDifferences);
  CHECK(found[1].exact);
}

TEST_CASE("UsualParameters_AreTheNumbersOfTheFile") {
  const std::vector<std::string> usual = usual_parameters(alone, {}, "");
  for (const char* key : {"bearings.main.operating_point.load", "bearings.main.width", "lubricants.oil.viscosity"})
    CHECK(std::count(usual.begin(), usual.end(), key) == 1);
  CHECK(std::count(usual.begin(), usual.end(), "bearings.main.diametral_clearance") == 0);
}

// Film and heat answer each other: two solutions then, and said so.
TEST_CASE("SensitivitiesWithHeat_AreDifferencesAndSaySo") {
  const std::vector<std::string> small{"bearings.main.grid={circumferential: 36, axial: 7}"};
  const BearingSolution here = solved(hot, small);
  const auto found = sensitivities(hot, here, {}, {"bearings.main.width"});
  REQUIRE(found.size() == 1);
  CAPTURE(found[0].message);
  CHECK_FALSE(found[0].exact);
  check(hot, small, found[0], "bearings.main.width=59.994 mm", "bearings.main.width=60.006 mm", 0.012e-3,
        kHotDifferences);
}

TEST_CASE("SensitivityToAWord_IsRefused") {
  const BearingSolution here = solved(alone, coarse);
  CHECK_THROWS_AS((void)sensitivities(alone, here, {}, {"bearings.main.lubricant"}), InputError);
  CHECK_THROWS_AS((void)sensitivities(alone, here, {}, {"bearings.main.widht"}), InputError);
}

}  // namespace sensitivity_test
}  // namespace hersey::study
