#include "hersey/study/bearing_study.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/read.h"
#include "source_dir.h"

namespace hersey::study {
namespace bearing_study_test {

constexpr double kRoundOff = 1e-14;  // of a unit

const std::string example = std::string(hersey::source_dir()) + "/examples/bearing_alone/model.yaml";

double value_of(const BearingSolution& solution, const std::string& key) {
  for (const BearingFigure& figure : figures_of(solution)) {
    if (figure.key == key) return figure.value;
  }
  FAIL("no figure " << key);
  return 0;
}

BearingFigure figure_of(const BearingSolution& solution, const std::string& key) {
  const std::vector<BearingFigure> all = figures_of(solution);
  const auto found = std::find_if(all.begin(), all.end(), [&](const BearingFigure& f) { return f.key == key; });
  REQUIRE(found != all.end());
  return *found;
}

BearingSolution solved_with(std::vector<std::string> overrides) {
  overrides.emplace_back("bearings.main.grid={circumferential: 60, axial: 13}");
  auto solutions = solve_bearings(example, {{overrides, "", "", {}}}, {.bearing = "", .grid_error = false});
  REQUIRE(solutions.at(0).solved());
  return solutions.front();
}

// By Reynolds' condition oil vanishes and appears: a balance of it is no error of the solution.
TEST_CASE("MassBalance_OfReynoldsIsNoNumberButWords") {
  const BearingFigure reynolds = figure_of(solved_with({"bearings.main.cavitation=reynolds"}), "mass_balance_error");
  CHECK(std::isnan(reynolds.value));
  CHECK(reynolds.words == "oil is not conserved by reynolds");
  const BearingFigure conserving = figure_of(solved_with({}), "mass_balance_error");
  CHECK(conserving.value < 1e-8);  // the solver leaves 1e-10 of the largest throughput
  CHECK(conserving.words.empty());
}

TEST_CASE("Speeds_AreReportedInRevolutionsPerMinute") {
  const BearingSolution turning = solved_with(
      {"bearings.main.operating_point.journal_speed=1500 rpm", "bearings.main.operating_point.shell_speed=-10 rad/s",
       "bearings.main.operating_point.load=none", "bearings.main.operating_point.eccentricity_ratio=0.3"});
  // A revolution is 2 pi, a minute 60 s.
  CHECK(figure_of(turning, "journal_speed").value == doctest::Approx(1500).epsilon(kRoundOff));
  CHECK(figure_of(turning, "shell_speed").value == doctest::Approx(-300 / std::numbers::pi).epsilon(kRoundOff));
  REQUIRE_FALSE(turning.whirl.always_stable);
  CHECK(figure_of(turning, "threshold_speed").value ==
        doctest::Approx(turning.whirl.threshold_speed * 60 / (2 * std::numbers::pi)).epsilon(kRoundOff));
  for (const char* key : {"journal_speed", "shell_speed", "threshold_speed"}) {
    const BearingFigure figure = figure_of(turning, key);
    CHECK(figure.unit == std::string("rpm"));
    CHECK(figure.si_unit == std::string("rad/s"));
  }
}

TEST_CASE("CriticalMass_ThatIsInfiniteIsWords") {
  const BearingSolution stable =
      solved_with({"bearings.main.operating_point.load=none", "bearings.main.operating_point.eccentricity_ratio=0.97"});
  REQUIRE(stable.whirl.always_stable);
  CHECK(figure_of(stable, "critical_mass").words == "none: stable at every mass");
  for (const char* key : {"whirl_ratio", "stability_number", "threshold_speed"})
    CHECK_FALSE(figure_of(stable, key).words.empty());
  const BearingSolution whirls =
      solved_with({"bearings.main.operating_point.load=none", "bearings.main.operating_point.eccentricity_ratio=0.3"});
  REQUIRE_FALSE(whirls.whirl.always_stable);
  CHECK(figure_of(whirls, "critical_mass").words.empty());
}

TEST_CASE("Figures_KnowTheirUnitInSi") {
  const BearingSolution solution = solved_with({});
  const BearingFigure thickness = figure_of(solution, "h_min"), flow = figure_of(solution, "side_flow");
  CHECK(thickness.si * thickness.value == doctest::Approx(solution.state.film.h_min).epsilon(kRoundOff));
  CHECK(thickness.si_unit == "m");
  CHECK(flow.si * flow.value ==
        doctest::Approx(solution.state.film.flow_left + solution.state.film.flow_right).epsilon(kRoundOff));
  CHECK(flow.si_unit == "m^3/s");
}

TEST_CASE("Sweeps_AreListsAndRanges") {
  using Values = std::vector<std::string>;
  CHECK(parse_sweep("load=100N,2 kN").values == Values{"100N", "2 kN"});
  CHECK(parse_sweep("load=100N:2.5kN:4").values == Values{"100 N", "900 N", "1700 N", "2500 N"});
  CHECK(parse_sweep("speed=1rpm:100rpm:3:log").values == Values{"1 rpm", "10 rpm", "100 rpm"});
  CHECK(parse_sweep("x.y=0.1:0.2:2").name == "x.y");
  for (const char* wrong : {"load", "load=", "=3", "load=1N:2N", "load=1N:2m:3", "load=1N:2N:1", "load=1N:2N:3:lin",
                            "load=0N:2N:3:log", "load=1N,,2N", "load=a:b:3"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS((void)parse_sweep(wrong), InputError);
  }
}

// Flow factors matter in between: at boundary lubrication the asperities decide, in a thick film roughness is lost.
TEST_CASE("StribeckWithFlowFactors_DiffersWhereFilmAndAsperitiesMeet") {
  const auto sweep = [](const std::string& roughness) {
    const auto runs = model::expand_parameters(
        example, {"bearings.main.grid={circumferential: 60, axial: 13}", "bearings.main.roughness=" + roughness},
        {parse_sweep("speed=10rpm:30000rpm:10:log")});
    auto curve = solve_bearings(example, runs, {.bearing = "", .grid_error = false, .threads = 2});
    for (const BearingSolution& solution : curve) {
      CAPTURE(solution.run.label);
      CAPTURE(solution.message);
      REQUIRE(solution.solved());
      CHECK(value_of(solution, "mass_balance_error") < 1e-9);  // the solver leaves 1e-10 of the largest throughput
    }
    return curve;
  };
  const auto contact_only = sweep("{shell: {sigma: 0.4 um}, journal: {sigma: 0.3 um}, flow_factors: none}");
  const auto with_flow = sweep("{shell: {sigma: 0.4 um, gamma: 0.2}, journal: {sigma: 0.3 um, gamma: 0.2}}");
  double largest = 0;
  std::size_t where = 0;
  for (std::size_t k = 0; k < with_flow.size(); ++k) {
    const double change = std::abs(value_of(with_flow[k], "h_min") / value_of(contact_only[k], "h_min") - 1);
    if (change > largest) largest = change, where = k;
  }
  CHECK(largest > 0.03);
  CHECK(value_of(with_flow[where], "film_ratio") < 6);
  const auto friction = [](const BearingSolution& s) { return value_of(s, "friction_journal"); };
  CHECK(friction(with_flow.front()) == doctest::Approx(friction(contact_only.front())).epsilon(0.1));
  CHECK(friction(with_flow.back()) == doctest::Approx(friction(contact_only.back())).epsilon(2e-3));
  CHECK(value_of(with_flow.front(), "asperity_share") > 0.8);
  CHECK(value_of(with_flow.back(), "asperity_share") < 1e-6);  // a film of many sigma: the asperities' law has died out
}

TEST_CASE("Stribeck_FallsFromBoundaryFrictionAndRisesWithTheFilm") {
  const auto runs = model::expand_parameters(example, {"bearings.main.grid={circumferential: 60, axial: 13}"},
                                             {parse_sweep("speed=10rpm:30000rpm:10:log")});
  const auto curve = solve_bearings(example, runs, {.bearing = "", .grid_error = false, .threads = 2});
  REQUIRE(curve.size() == 10);
  std::vector<double> friction;
  for (const BearingSolution& solution : curve) {
    CAPTURE(solution.run.label);
    CAPTURE(solution.message);
    REQUIRE(solution.solved());
    CHECK(value_of(solution, "load") == doctest::Approx(2500).epsilon(1e-8));  // the search ends at 1e-10 of the load
    friction.push_back(value_of(solution, "friction_journal"));
  }
  // Asperities bear nine tenths of the load, with a friction coefficient of 0.12.
  CHECK(friction.front() > 0.1);
  CHECK(friction.front() < 0.12);
  CHECK(value_of(curve.front(), "asperity_share") > 0.85);
  CHECK(value_of(curve.back(), "asperity_share") < 1e-6);  // a film of many sigma: the asperities' law has died out
  const auto least = std::min_element(friction.begin(), friction.end());
  CHECK(least != friction.begin());
  CHECK(least != friction.end() - 1);
  CHECK(*least < 0.02);
  CHECK(std::is_sorted(least, friction.end()));
  CHECK(std::is_sorted(friction.begin(), least + 1, std::greater<>()));
}

TEST_CASE("Threads_DoNotChangeNumbers") {
  const auto runs = model::expand_parameters(example, {}, {parse_sweep("load=100N,1000N,2500N")});
  const auto one = solve_bearings(example, runs, {.bearing = "main", .grid_error = true, .threads = 1});
  const auto three = solve_bearings(example, runs, {.bearing = "main", .grid_error = true, .threads = 3});
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto a = figures_of(one[i]), b = figures_of(three[i]);
    REQUIRE(a.size() == b.size());
    for (std::size_t k = 0; k < a.size(); ++k) CHECK(a[k].value == b[k].value);
    CHECK(one[i].grid_error.known);
  }
}

TEST_CASE("WrongBearing_IsNamed") {
  const model::StudyRun run{};
  CHECK_THROWS_WITH_AS((void)solve_bearings(example, {run}, {.bearing = "mian"}),
                       doctest::Contains("did you mean 'main'?"), InputError);
}

TEST_CASE("SolutionThatFails_LeavesTheOthers") {
  const auto runs = model::expand_parameters(example, {"bearings.main.asperities=none"},
                                             {parse_sweep("bearings.main.supply.line=90deg,widest_gap")});
  std::vector<model::StudyRun> both = runs;
  both[0].overrides.push_back("bearings.main.radial_clearance=-1um");
  std::reverse(both.begin(), both.end());
  const auto solutions = solve_bearings(example, both, {});
  CHECK(solutions[0].solved());
  CHECK_FALSE(solutions[1].solved());
}

TEST_CASE("LemonBoreMadeRound_HasTheCoefficientsOfLundAndThomsen") {
  // Two axial grooves of 20 degrees over the whole width, L/D = 0.5: epsilon, attitude, K and C as tabulated (1978).
  struct Case {
    const char* load;
    double epsilon, attitude;
    std::vector<double> K, C;
  };
  const std::vector<Case> cases{
      {"1341.9 N", 0.244, 65.85, {1.69, 5.06, -2.20, 1.95}, {9.93, 2.15, 2.15, 4.80}},
      {"5878.9 N", 0.570, 45.43, {3.33, 3.64, -0.43, 1.68}, {6.76, 1.87, 1.87, 1.89}},
  };
  const std::string file = std::string(hersey::source_dir()) + "/examples/lemon_bore/model.yaml";
  for (const Case& c : cases) {
    CAPTURE(c.load);
    const std::vector<std::string> overrides{"offset=0 um",
                                             "feed=0 bar",
                                             "speed=3000 rpm",
                                             std::string("load=") + c.load,
                                             "bearings.main.features.left.length=50 mm",
                                             "bearings.main.features.right.length=50 mm",
                                             "bearings.main.shear_force=torque_only",
                                             "bearings.main.cavitation=reynolds"};
    const BearingSolution solution =
        solve_bearings(file, {{overrides, "", "", {}}}, {.bearing = "", .grid_error = false}).front();
    REQUIRE(solution.solved());
    CHECK(std::abs(value_of(solution, "eccentricity_ratio") - c.epsilon) < 1e-3);  // the last digit of the table
    CHECK(std::abs(value_of(solution, "attitude") - c.attitude) < 0.1);
    const char* pairs[] = {"xx", "xy", "yx", "yy"};
    for (std::size_t k = 0; k < 4; ++k) {
      CAPTURE(pairs[k]);
      // The table's figures have three digits; relative to the largest of each matrix.
      CHECK(std::abs(value_of(solution, std::string("K_") + pairs[k]) - c.K[k]) < 0.01 * 5.06);
      CHECK(std::abs(value_of(solution, std::string("C_") + pairs[k]) - c.C[k]) < 0.01 * 9.93);
    }
  }
}

TEST_CASE("SolvingOneByOne_GivesTheBitsOfAStudy") {
  const std::vector<std::string> overrides{"load=800 N"};
  const BearingSolution one =
      BearingSolver().solve(model::read(example, overrides), {.bearing = "main", .grid_error = false});
  const auto all = solve_bearings(example, {{overrides, "", "", {}}}, {.bearing = "main", .grid_error = false});
  REQUIRE(one.solved());
  CHECK(value_of(one, "h_min") == value_of(all.front(), "h_min"));
}

}  // namespace bearing_study_test
}  // namespace hersey::study
