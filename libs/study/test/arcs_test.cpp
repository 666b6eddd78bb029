#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/study/bearing_study.h"

// Bores of arcs: numbers of an independent program, and answers that must not depend on how a bore is written down.
namespace hersey::study {
namespace arcs_test {

constexpr double degree = std::numbers::pi / 180;

const std::string model_of_arcs = R"(hersey: 1
parameters: {width: 50 mm, arcs: {}, load: none, ratio: none, a: 0 deg, s: 3000 rpm, around: 180, axial: 25}
lubricants:
  oil: {viscosity: 20 mPa.s}
bearings:
  main:
    diameter: 100 mm
    width: "${width}"
    radial_clearance: 100 um
    lubricant: oil
    grid: {circumferential: "${around}", axial: "${axial}"}
    shear_force: torque_only
    @bore@
    operating_point: {journal_speed: "${s}", load: "${load}", eccentricity_ratio: "${ratio}",
                      load_angle: "${a}", eccentricity_angle: "${a}"}
)";

/// Solves the model with a bore of its own: lines of the bearing's mapping.
BearingSolution solved(std::string bore, std::vector<std::string> overrides, bool grid_error = false) {
  std::string text = model_of_arcs;
  text.erase(text.find("arcs: {}, "), 10);
  text.replace(text.find("@bore@"), 6, bore);
  const std::string path = "arcs_test.yaml";
  std::ofstream(path) << text;
  auto solutions = solve_bearings(path, {{std::move(overrides), "", "", {}}}, {.grid_error = grid_error});
  std::filesystem::remove(path);
  INFO(bore);
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
  for (const char* key : {"load", "h_min", "p_max", "eccentricity_ratio", "attitude", "torque_journal", "side_flow",
                          "flow_leading", "oil_volume", "cavitated_share"}) {
    CAPTURE(key);
    CHECK(std::abs(figure(other, key)) == doctest::Approx(std::abs(figure(one, key))).epsilon(tolerance));
  }
}

/// A bearing of an independent program (numpy, finite differences on up to 120 x 48 nodes a pad, extrapolated), at
/// So = W (c/R)^2/(L D mu omega).
struct Reference {
  std::string bore;
  double width, So;        // [mm], [-]
  double ratio, attitude;  // [-], [deg]
  double side_flow;        // over omega R c L
  Eigen::Matrix2d K, B;    // k c/W, b c omega/W, x along the load
};

Eigen::Matrix2d matrix(double xx, double xy, double yx, double yy) {
  return (Eigen::Matrix2d() << xx, xy, yx, yy).finished();
}

TEST_CASE("ArcsAndLobes_MatchAnIndependentProgram") {
  const std::vector<Reference> references{
      {"arcs: {below: {middle: 0 deg, arc: 180 deg}}", 50, 0.49564, 0.6, 44.984, 0.4169,
       matrix(3.5115, 3.6283, -0.3327, 1.7411), matrix(6.5990, 1.8826, 1.8826, 1.8815)},
      {"arcs: {below: {middle: 10 deg, arc: 120 deg}}", 75, 1.12913, 0.7, 29.389, 0.1261,
       matrix(5.1827, 4.0044, -0.1081, 1.1487), matrix(8.5258, 1.5227, 1.5227, 0.8576)},
      {"bore: {type: three_lobe, preload: 0.5, angle: 0 deg}", 50, 1, 0.91391, 43.760, 0.4474,
       matrix(6.5648, 2.6866, 0.2672, 0.7260), matrix(5.2903, 0.8423, 0.8423, 0.4829)},
  };
  for (const Reference& reference : references) {
    INFO(reference.bore);
    const double omega = 100 * std::numbers::pi, L = 1e-3 * reference.width, c = 1e-4, R = 0.05;
    const double W = reference.So * L * 2 * R * 0.02 * omega * (R / c) * (R / c);
    const BearingSolution found =
        solved(reference.bore, {fmt::format("load={} N", W), fmt::format("width={} mm", reference.width)});
    CHECK(figure(found, "eccentricity_ratio") == doctest::Approx(reference.ratio).epsilon(0.0005));
    CHECK(std::abs(figure(found, "attitude") - reference.attitude) < 0.02);  // of 0.001 deg in the reference
    CHECK(1e-9 * figure(found, "side_flow") == doctest::Approx(reference.side_flow * omega * R * c * L).epsilon(0.005));
    const Eigen::Matrix2d K = found.coefficients.K, C = found.coefficients.C;
    CHECK((K - reference.K).cwiseAbs().maxCoeff() < 0.002 * reference.K.cwiseAbs().maxCoeff());
    CHECK((C - reference.B).cwiseAbs().maxCoeff() < 0.003 * reference.B.cwiseAbs().maxCoeff());
  }
}

const std::string skewed = R"(arcs:
      a: {middle: 20 deg, arc: 110 deg, preload: 0.3, offset: 0.6, edge_pressure: {leading: 1 bar, trailing: 0 bar}}
      b: {middle: 150 deg, arc: 90 deg, machined_clearance: 150 um}
      c: {middle: 260 deg, arc: 80 deg, radial_clearance: 120 um, ambient_fill: {leading: 0.6, trailing: 1}})";

// The first film is extended beyond those of its neighbours: lines lie where they lay, turned or mirrored.
TEST_CASE("SameArcs_HaveTheSameNumbersTurnedMirroredAndRenamed") {
  constexpr double solved_for = 1e-6;  // loads are met to 1e-8
  const std::vector<std::string> coarse{"load=4 kN", "around=72", "axial=9"};
  const auto also = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = coarse;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const BearingSolution one = solved(skewed, coarse);
  check_same(one,
             solved(R"(arcs:
      a: {middle: 97 deg, arc: 110 deg, preload: 0.3, offset: 0.6, edge_pressure: {leading: 1 bar, trailing: 0 bar}}
      b: {middle: 227 deg, arc: 90 deg, machined_clearance: 150 um}
      c: {middle: 337 deg, arc: 80 deg, radial_clearance: 120 um, ambient_fill: {leading: 0.6, trailing: 1}})",
                    also({"a=77 deg"})),
             solved_for);
  check_same(one,
             solved(R"(arcs:
      z: {middle: 260 deg, arc: 80 deg, radial_clearance: 120 um, ambient_fill: {leading: 0.6, trailing: 1}}
      y: {middle: 20 deg, arc: 110 deg, preload: 0.3, offset: 0.6, edge_pressure: {leading: 1 bar, trailing: 0 bar}}
      x: {middle: -210 deg, arc: 90 deg, preload: 0.33333333333333333})",
                    coarse),
             solved_for);
  const BearingSolution mirrored = solved(R"(arcs:
      a: {middle: -20 deg, arc: 110 deg, preload: 0.3, offset: 0.4, edge_pressure: {leading: 0 bar, trailing: 1 bar}}
      b: {middle: -150 deg, arc: 90 deg, machined_clearance: 150 um}
      c: {middle: -260 deg, arc: 80 deg, radial_clearance: 120 um, ambient_fill: {leading: 1, trailing: 0.6}})",
                                          also({"s=-3000 rpm"}));
  for (const char* key : {"h_min", "p_max", "eccentricity_ratio", "side_flow", "oil_volume", "arc_load_share_a",
                          "arc_load_share_b", "arc_p_max_c", "arc_flow_in_a", "arc_flow_in_c"}) {
    CAPTURE(key);
    CHECK(figure(mirrored, key) == doctest::Approx(figure(one, key)).epsilon(solved_for));
  }
  CHECK(figure(mirrored, "flow_leading") == doctest::Approx(figure(one, "flow_trailing")).epsilon(solved_for));
}

TEST_CASE("FiguresOfArcs_AddUpToThoseOfTheBearing") {
  const BearingSolution s = solved(skewed, {"load=4 kN", "around=72", "axial=9"});
  const auto sum = [&](const std::string& key) {
    return figure(s, key + "a") + figure(s, key + "b") + figure(s, key + "c");
  };
  CHECK(sum("arc_load_share_") == doctest::Approx(1).epsilon(1e-7));  // the load is met to 1e-8
  CHECK(figure(s, "p_max") ==
        doctest::Approx(std::max({figure(s, "arc_p_max_a"), figure(s, "arc_p_max_b"), figure(s, "arc_p_max_c")}))
            .epsilon(0.02));
  // What comes in over the ends leaves over the sides, or over other ends.
  CHECK(figure(s, "side_flow") ==
        doctest::Approx(-figure(s, "flow_leading") - figure(s, "flow_trailing")).epsilon(1e-6));
  CHECK(figure(s, "mass_balance_error") < 1e-9);  // the film is solved to 1e-10
}

// The same film in other words: the end of an arc at p_cav, flooded, is the border of a fed groove.
TEST_CASE("ArcsWithoutPreload_AreABoreWithGrooves") {
  const std::vector<std::string> at{"ratio=0.6", "a=-130 deg", "around=144", "axial=17"};
  const BearingSolution arcs = solved("bore: {type: elliptical, preload: 0, groove: 20 deg, angle: 90 deg}", at);
  const BearingSolution grooves = solved(R"(features:
      left: {shape: axial_groove, angle: 180 deg, arc: 20 deg, length: 50 mm, pressure: 0 Pa}
      right: {shape: axial_groove, angle: 0 deg, arc: 20 deg, length: 50 mm, pressure: 0 Pa})",
                                         at);
  for (const char* key : {"load", "h_min", "p_max", "stiffness_xx", "damping_yy"}) {
    CAPTURE(key);
    CHECK(figure(arcs, key) ==
          doctest::Approx(figure(grooves, key)).epsilon(0.01));  // grids of 8 and 10 lines a groove
  }
  CHECK(std::abs(figure(arcs, "attitude") - figure(grooves, "attitude")) < 0.1);
}

TEST_CASE("FiguresOfArcs_ConvergeWithOrderTwo") {
  const auto on = [&](int around, int axial) {
    return solved("arcs: {below: {middle: 0 deg, arc: 120 deg, preload: 0.1}}",
                  {"ratio=0.3", "a=50 deg", fmt::format("around={}", around), fmt::format("axial={}", axial)});
  };
  const BearingSolution coarse = on(48, 7), middle = on(96, 13), fine = on(192, 25);
  for (const char* key : {"load", "p_max", "torque_journal", "power_film", "side_flow", "flow_leading", "oil_volume",
                          "arc_flow_in_below", "stiffness_xx", "damping_xx"}) {
    CAPTURE(key);
    const double first = figure(middle, key) - figure(coarse, key), second = figure(fine, key) - figure(middle, key);
    // A quarter by order two. The front of a small cavity moves from line to line, which coefficients feel most.
    const double of_fronts = std::string(key).find("_xx") == std::string::npos ? 3e-4 : 3e-3;
    CHECK(std::abs(second) < 0.4 * std::abs(first) + of_fronts * std::abs(figure(fine, key)));
  }
}

TEST_CASE("JournalBetweenLobes_GoesBeyondTheClearance") {
  const std::string bore = "bore: {type: elliptical, preload: 0.6, angle: 90 deg}";
  const BearingSolution s = solved(bore, {"ratio=1.3", "a=0 deg", "around=96", "axial=9"});
  CHECK(figure(s, "eccentricity_ratio") == doctest::Approx(1.3));
  CHECK(figure(s, "h_min") > 5);
  // The load found is carried there.
  const BearingSolution found =
      solved(bore, {fmt::format("load={:.17g} N", figure(s, "load")),
                    fmt::format("a={:.17g} deg", figure(s, "load_angle")), "around=96", "axial=9"});
  CHECK(figure(found, "eccentricity_ratio") == doctest::Approx(1.3).epsilon(1e-6));  // the load is met to 1e-8
}

TEST_CASE("CoefficientsOfArcs_AreDifferencesOfTheForces") {
  const std::vector<std::string> at{"ratio=0.5", "a=30 deg", "around=96", "axial=9"};
  const BearingSolution s = solved(skewed, at);
  const auto force = [&](double x, double y) {
    const double r = std::hypot(x, y), angle = std::atan2(y, x) / degree;
    return solved(skewed,
                  {fmt::format("ratio={:.17g}", r), fmt::format("a={:.17g} deg", angle), "around=96", "axial=9"})
        .state.load;
  };
  const double x = 0.5 * std::cos(30 * degree), y = 0.5 * std::sin(30 * degree), d = 1e-5;
  const Eigen::Vector2d dx = (force(x + d, y) - force(x - d, y)) / (2 * d * 1e-4);
  const Eigen::Vector2d dy = (force(x, y + d) - force(x, y - d)) / (2 * d * 1e-4);
  const Eigen::Matrix2d k = s.tangent.stiffness.topLeftCorner<2, 2>();
  const double scale = k.cwiseAbs().maxCoeff();
  CHECK((k.col(0) - dx).norm() < 1e-4 * scale);  // of differences over d
  CHECK((k.col(1) - dy).norm() < 1e-4 * scale);  // of differences over d
}

TEST_CASE("GridErrorOfArcs_IsKnownAndHonest") {
  const BearingSolution coarse = solved(skewed, {"load=4 kN", "around=72", "axial=9"}, true);
  const BearingSolution fine = solved(skewed, {"load=4 kN", "around=288", "axial=33"});
  for (const char* key : {"h_min", "p_max", "eccentricity_ratio", "torque_journal", "side_flow"}) {
    CAPTURE(key);
    const BearingFigure figure_with_error = figure_of(coarse, key);
    REQUIRE(figure_with_error.grid_error > 0);
    CHECK(std::abs(figure_with_error.value - figure(fine, key)) < 3 * figure_with_error.grid_error);
  }
}

}  // namespace arcs_test
}  // namespace hersey::study
