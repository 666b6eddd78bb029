#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tilting_pad_cases.h"

// Bearings of tilting pads by themselves: numbers of an independent program, and answers that must not depend on how a
// bearing is written down.
namespace hersey::study {
namespace tilting_pad_study_test {

constexpr double degree = std::numbers::pi / 180;

// An independent program (numpy, 128 x 48 nodes a pad, extrapolated) without shear; loads, films and tilts over W and
// c.
TEST_CASE("TiltingPads_MatchAnIndependentProgram") {
  const std::vector<std::string> fine{"around=120", "axial=17", "load=7853.9816 N"};
  const auto at = [&](double nu, const std::string& pivot) {
    std::vector<std::string> overrides = fine;
    overrides.push_back(fmt::format("nu={}", nu));
    overrides.push_back("bearings.main.pivot=" + pivot);
    return solved_pads(overrides);
  };
  const BearingSolution rigid = at(1, "{type: rigid}");
  CHECK(rigid.warnings.empty());
  CHECK(rigid.numbers.eccentricity_ratio == doctest::Approx(0.733208).epsilon(0.003));
  CHECK(figure_of_pads(rigid, "pad_force_1") / 7853.9816 == doctest::Approx(0.95978).epsilon(0.003));
  CHECK(figure_of_pads(rigid, "pad_h_pivot_1") == doctest::Approx(26.68e-6).epsilon(0.005));
  CHECK(figure_of_pads(rigid, "arc_h_min_2") == doctest::Approx(65.66e-6).epsilon(0.005));
  const BearingSolution yielding = at(0, "{type: spring, stiffness: 7.8539816e8 N/m}");
  CHECK(yielding.numbers.eccentricity_ratio == doctest::Approx(0.827477).epsilon(0.003));
  CHECK(figure_of_pads(yielding, "pad_pivot_travel_1") == doctest::Approx(9.5281e-6).epsilon(0.003));
  check_near(yielding.coefficients.K, Eigen::Vector2d(4.15492, 0.583844).asDiagonal(), 0.015);
  check_near(yielding.coefficients.C, Eigen::Vector2d(0.930120, 0.327032).asDiagonal(), 0.02);
}

TEST_CASE("SamePads_HaveTheSameNumbersTurnedAndMirrored") {
  constexpr double solved_for = 1e-6;  // equations are solved to 1e-8 and better
  const BearingSolution one = solved_pads({"a=-80 deg", "offset=0.55"});
  const BearingSolution turned = solved_pads({"a=-80 deg", "offset=0.55", "turn=137 deg"});
  const BearingSolution mirrored = solved_pads({"a=-100 deg", "offset=0.45", "s=-3000 rpm"});
  for (const BearingSolution* other : {&turned, &mirrored}) {
    CHECK(other->numbers.eccentricity_ratio == doctest::Approx(one.numbers.eccentricity_ratio).epsilon(solved_for));
    CHECK(std::abs(other->numbers.attitude) == doctest::Approx(std::abs(one.numbers.attitude)).epsilon(solved_for));
    for (const char* key : {"h_min", "p_max", "side_flow", "power_film", "pad_force_1"})
      CHECK(figure_of_pads(*other, key) == doctest::Approx(figure_of_pads(one, key)).epsilon(solved_for));
    check_near(other->coefficients.K, one.coefficients.K, solved_for);
    check_near(other->coefficients.C, one.coefficients.C, solved_for);
  }
}

// At frequency 0 stiffness is what the force does as the journal is moved and pads follow.
TEST_CASE("SlowStiffness_IsTheDifferenceOfForces") {
  const auto carried = [](double ratio, double angle) {
    return Eigen::Vector2d(
        solved_pads({"load=none", fmt::format("ratio={}", ratio), fmt::format("a={} deg", angle), "nu=0"}).state.load);
  };
  constexpr double e = 0.5, step = 2e-4, c = 1e-4;
  const BearingSolution here = solved_pads({"load=none", fmt::format("ratio={}", e), "a=-60 deg", "nu=0"});
  const Eigen::Vector2d radial(0.5, -std::sqrt(0.75)), tangential(std::sqrt(0.75), 0.5);
  const Eigen::Matrix2d K = here.state.coefficients.stiffness.topLeftCorner<2, 2>();
  const Eigen::Vector2d outwards = (carried(e + step, -60) - carried(e - step, -60)) / (2 * step * c);
  const double turn = step / e / degree;
  const Eigen::Vector2d around = (carried(e, -60 + turn) - carried(e, -60 - turn)) / (2 * step * c);
  constexpr double of_differences = 1e-3;  // coefficients are means over four grids, forces those of one
  CHECK((K * radial - outwards).norm() < of_differences * K.norm());
  CHECK((K * tangential - around).norm() < of_differences * K.norm());
  const BearingSolution by_load = solved_pads(
      {fmt::format("load={} N", here.numbers.load), fmt::format("a={} rad", here.numbers.load_angle), "nu=0"});
  CHECK((by_load.state.e - here.state.e).norm() < 1e-6 * c);  // the position is found again
  check_near(by_load.coefficients.K, here.coefficients.K,
             2e-3);  // means at positions given, and of the load on each grid
}

TEST_CASE("BallOnItsSeat_YieldsAsHertzSays") {
  const BearingSolution found =
      solved_pads({"bearings.main.pivot={type: ball_in_socket, ball_radius: 20 mm, socket_radius: 21 mm}"});
  const double force = figure_of_pads(found, "pad_force_1"), travel = figure_of_pads(found, "pad_pivot_travel_1");
  const double modulus = 210e9 / (2 * (1 - 0.09)), radius = 0.42;  // 1/(1/20 mm - 1/21 mm)
  const double expected = std::pow(0.75 * force / (modulus * std::sqrt(radius)), 2.0 / 3);
  CHECK(travel == doctest::Approx(expected).epsilon(1e-4));  // the film's force leans from the pivot by the pad's tilt
}

// At rest nothing of pads feels their mass, and slow motions neither.
TEST_CASE("PadsWithoutMass_LieWhereHeavyOnesDo") {
  const BearingSolution light = solved_pads({"nu=0", "bearings.main.pads.density=0 kg/m^3"}),
                        heavy = solved_pads({"nu=0"});
  constexpr double solved_for = 1e-6;  // equations are solved to 1e-8 and better
  for (const char* key : {"h_min", "p_max", "eccentricity_ratio", "pad_tilt_1", "pad_force_3"})
    CHECK(figure_of_pads(light, key) == doctest::Approx(figure_of_pads(heavy, key)).epsilon(solved_for));
  check_near(light.coefficients.K, heavy.coefficients.K, solved_for);
}

TEST_CASE("PadThatNothingBalances_StandsAsideAndIsNamed") {
  const BearingSolution found =
      solved_pads({"load=9 kN", "bearings.main.shear_force=full",
                   "bearings.main.pads={count: 4, arc: 80 deg, preload: 0, thickness: 25 mm}"});
  REQUIRE_FALSE(found.warnings.empty());
  CHECK(found.warnings[0].find("(spragging): it stands aside") != std::string::npos);
  double upper = 0;
  for (const PadState& pad : found.pads->pads)
    if (pad.is_aside) upper += pad.force.norm();
  CHECK(upper < 0.01 * found.numbers.load);
}

// Pads that could draw more than reaches them draw all of it, and carry less.
TEST_CASE("StarvedPads_DrawAllTheirOil") {
  const auto with_flow = [](const std::string& flow) { return solved_pads({"bearings.main.pads.edge_flow=" + flow}); };
  const BearingSolution flooded = solved_pads({}), ample = with_flow("20 L/min"), starved = with_flow("2 L/min");
  for (const char* key : {"eccentricity_ratio", "h_min", "p_max", "power_film", "pad_tilt_1"})
    CHECK(figure_of_pads(ample, key) == doctest::Approx(figure_of_pads(flooded, key)).epsilon(2e-3));  // by half a cell
  constexpr double given = 2e-3 / 60;
  CHECK(figure_of_pads(flooded, "arc_flow_in_3") > 1.1 * given);
  CHECK(figure_of_pads(starved, "arc_flow_in_3") == doctest::Approx(given).epsilon(1e-6));  // solved to 1e-8
  CHECK(figure_of_pads(starved, "pad_force_3") < 0.95 * figure_of_pads(flooded, "pad_force_3"));
  const BearingSolution mirrored = solved_pads({"bearings.main.pads.edge_flow=2 L/min", "s=-3000 rpm"});
  for (const char* key : {"eccentricity_ratio", "h_min", "p_max", "power_film", "side_flow"})
    CHECK(figure_of_pads(mirrored, key) == doctest::Approx(figure_of_pads(starved, key)).epsilon(1e-6));  // likewise
}

}  // namespace tilting_pad_study_test
}  // namespace hersey::study
