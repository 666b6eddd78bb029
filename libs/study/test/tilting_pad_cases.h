#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "hersey/study/bearing_study.h"

// A bearing of tilting pads by itself, for tests of its answers.
namespace hersey::study {

inline const std::string model_of_pads = R"(hersey: 1
parameters: {load: 4 kN, ratio: none, a: -90 deg, s: 3000 rpm, nu: 1, around: 84, axial: 9, turn: 0 deg, offset: 0.5}
lubricants:
  oil: {viscosity: 20 mPa.s}
bearings:
  main:
    kind: tilting_pad
    diameter: 100 mm
    width: 50 mm
    radial_clearance: 100 um
    lubricant: oil
    grid: {circumferential: "${around}", axial: "${axial}"}
    shear_force: none
    pads: {count: 5, arc: 60 deg, preload: 0.5, offset: "${offset}", load: on_pad, load_angle: "-90 deg + ${turn}"}
    operating_point: {journal_speed: "${s}", load: "${load}", eccentricity_ratio: "${ratio}",
                      load_angle: "${a} + ${turn}", eccentricity_angle: "${a} + ${turn}", whirl_ratio: "${nu}"}
)";

inline BearingSolution attempted_pads(std::vector<std::string> overrides) {
  const std::string path = "tilting_pad_cases.yaml";
  std::ofstream(path) << model_of_pads;
  auto solutions = solve_bearings(path, {{std::move(overrides), "", "", {}}}, {});
  std::filesystem::remove(path);
  return solutions.at(0);
}

inline BearingSolution solved_pads(std::vector<std::string> overrides) {
  BearingSolution solution = attempted_pads(std::move(overrides));
  INFO(solution.message);
  REQUIRE(solution.solved());
  return solution;
}

inline double figure_of_pads(const BearingSolution& solution, const std::string& key) {
  const std::vector<BearingFigure> all = figures_of(solution);
  const auto found = std::find_if(all.begin(), all.end(), [&](const BearingFigure& f) { return f.key == key; });
  REQUIRE_MESSAGE(found != all.end(), key);
  return found->si * found->value;
}

inline void check_near(const Eigen::Matrix2d& found, const Eigen::Matrix2d& expected, double tolerance) {
  CAPTURE(found);
  CHECK((found - expected).cwiseAbs().maxCoeff() < tolerance * expected.cwiseAbs().maxCoeff());
}

}  // namespace hersey::study
