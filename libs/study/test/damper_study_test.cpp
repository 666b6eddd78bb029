#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/read.h"
#include "hersey/study/bearing_study.h"
#include "relative.h"

// A squeeze-film damper from the model file to its figures.
namespace hersey::study {
namespace damper_study_test {

const std::string damper = R"(hersey: 1
lubricants:
  oil: {viscosity: 10 mPa.s, density: 850 kg/m^3}
bearings:
  damper:
    kind: squeeze_film_damper
    diameter: 100 mm
    width: 50 mm
    radial_clearance: 100 um
    lubricant: oil
    cavitation: full_film
    grid: {circumferential: 120, axial: 25}
    operating_point: {whirl_speed: 100 rad/s, orbit_ratio: 0.5}
)";

const std::string path = "bearings.damper.", point = path + "operating_point.";

std::map<std::string, double> figures(const std::vector<std::string>& overrides, std::string* warning = nullptr) {
  const model::Model model = model::read_text(damper, "m.yaml", overrides);
  const BearingSolution solution = BearingSolver().solve(model, {.grid_error = false});
  REQUIRE_MESSAGE(solution.solved(), solution.message);
  if (warning != nullptr) *warning = solution.warnings.empty() ? "" : solution.warnings.front();
  std::map<std::string, double> all;
  for (const BearingFigure& f : figures_of(solution)) all[f.key] = f.value;
  return all;
}

std::string fault_of(const std::vector<std::string>& overrides) {
  try {
    (void)model::read_text(damper, "m.yaml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// An independent program's C and K of the full, the pi and the Reynolds film, dimensionless, and its peak pressure over
// mu Omega (R/c)^2; its grids differ by 2e-4.
TEST_CASE("Orbits_AreThoseOfAnIndependentSolution") {
  struct Case {
    std::string width, ratio, edge;
    double twopi_C, pi_C, pi_K, p_max, reynolds_C, reynolds_K;
  };
  const std::vector<Case> cases{
      {"50 mm", "0.2", "0 Pa", 3.0016206, 1.5008103, 0.3336077, 0.3097073, 1.5141826, 0.4020296},
      {"50 mm", "0.8", "0 Pa", 9.1541584, 4.5770792, 6.1581500, 11.7651425, 4.7169968, 7.2828134},
      {"25 mm", "0.5", "{leakage: 1}", 12.9432726, 6.4716363, 1.7965895, 0.7045903, 0, 0},
  };
  for (const Case& c : cases) {
    CAPTURE(c.ratio);
    const auto with = [&](const std::string& cavitation) {
      std::vector<std::string> set{path + "width=" + c.width, point + "orbit_ratio=" + c.ratio,
                                   path + "edge_pressure=" + c.edge, path + "cavitation=" + cavitation};
      if (cavitation == "reynolds") set.push_back(path + "supply={line: widest_gap}");
      return figures(set);
    };
    // Of 120 x 25 nodes, of second order.
    constexpr double kGrid = 5e-3;
    const auto full = with("full_film"), half = with("guembel");
    CHECK(full.at("C_orbit") == relative(c.twopi_C).epsilon(kGrid));
    CHECK(full.at("p_max") * 1e6 / (0.01 * 100 * 250000) == relative(c.p_max).epsilon(kGrid));
    CHECK(half.at("C_orbit") == relative(c.pi_C).epsilon(kGrid));
    CHECK(half.at("K_orbit") == relative(c.pi_K).epsilon(kGrid));
    CHECK(half.at("force_radial") < 0);
    CHECK(std::abs(half.at("power_error_share")) < kGrid);
    if (c.reynolds_C == 0) continue;
    const auto ruptured = with("reynolds");
    CHECK(ruptured.at("C_orbit") == relative(c.reynolds_C).epsilon(kGrid));
    CHECK(ruptured.at("K_orbit") == relative(c.reynolds_K).epsilon(kGrid));
  }
}

// Exact small motions across the gap at a squeeze Reynolds number of 0.2: C and M of the same reference.
TEST_CASE("AddedMassOfADamper_IsThatOfTheExactSmallMotion") {
  const std::vector<std::string> set{path + "diameter=129.54 mm",      path + "width=30 mm",
                                     path + "radial_clearance=120 um", "lubricants.oil.viscosity=6 mPa.s",
                                     path + "oil_inertia=added_mass",  point + "orbit_ratio=0"};
  const auto f = figures(set);
  CHECK(f.at("squeeze_reynolds") == relative(0.204).epsilon(1e-12));  // of the products that make it
  CHECK(f.at("damping_xx") == relative(18675.8765).epsilon(5e-3));    // of the grid, second order
  CHECK(f.at("added_mass_yy") == relative(3.8098578).epsilon(5e-3));  // the same
  CHECK(f.count("orbit_damping") == 0);
}

TEST_CASE("TensionBelowAVacuum_IsReported") {
  std::string warning;
  (void)figures({}, &warning);
  CHECK(mentions(warning, "the oil bears tension, down to -3.76 bar"));
  (void)figures({point + "orbit_ratio=0.1"}, &warning);
  CHECK(warning.empty());
}

TEST_CASE("DampersThatHaveNoAnswer_AreRefusedByName") {
  CHECK(mentions(fault_of({point + "whirl_speed=0 rpm"}), "whirl_speed: a journal that neither orbits nor vibrates"));
  CHECK(mentions(fault_of({point + "eccentricity_ratio=0.2"}), "eccentricity_ratio: an orbit about another point"));
  CHECK(mentions(fault_of({path + "supply={line: 90 deg}"}), "orbit_ratio: an orbit in a bore with a supply line"));
  CHECK(mentions(fault_of({path + "features={h: {shape: hole, angle: 0 deg, diameter: 3 mm, pressure: 1 bar}}"}),
                 "a bore with 'h', which does not go all around"));
  CHECK(mentions(fault_of({path + "cavitation=guembel", point + "orbit_ratio=0"}), "small motions of a film without"));
  CHECK(mentions(fault_of({path + "edge_pressure={leakage: 0}"}), "edge_pressure.leakage: '0'"));
  CHECK(mentions(fault_of({path + "edge_pressure={left: {leakage: 1}, right: closed}", path + "ambient_fill=1"}),
                 "oil outside edges that are closed or sealed"));
  CHECK(mentions(fault_of({path + "edge_pressure={leakage: 1, outside: -1 bar}"}), "below the cavitation pressure"));
  CHECK(fault_of({path + "features={g: {shape: circumferential_groove, length: 8 mm, pressure: 1 bar}}"}) ==
        "no fault");
}

}  // namespace damper_study_test
}  // namespace hersey::study
