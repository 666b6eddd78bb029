#include "hersey/bearing/steady_derivative.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/bearing/bearing_numbers.h"

namespace hersey::bearing {
namespace steady_derivative_test {

// Differences of two solutions to 1e-13 of the load over steps of 1e-4, and the square of these steps times the
// curvature of powers up to the sixth.
constexpr double kDifferences = 1e-6;

struct Parameter {
  std::string name;
  std::function<void(BearingBeside&, double)> scale;  ///< by 1 + the number
};

std::vector<Parameter> parameters() {
  return {{"clearance", [](BearingBeside& b, double x) { b.model.c *= 1 + x; }},
          {"width", [](BearingBeside& b, double x) { b.model.L *= 1 + x; }},
          {"viscosity", [](BearingBeside& b, double x) { b.model.lubricant.mu0 *= 1 + x; }},
          {"load", [](BearingBeside& b, double x) { *b.point.load *= 1 + x; }},
          {"speed", [](BearingBeside& b, double x) { b.point.journal_speed *= 1 + x; }},
          {"supply", [](BearingBeside& b, double x) { b.model.supply.pressure *= 1 + x; }},
          {"load angle", [](BearingBeside& b, double x) { *b.point.load = Eigen::Rotation2Dd(x) * *b.point.load; }},
          {"tilt", [](BearingBeside& b, double x) { b.point.tilt.x() += 1e-4 * x; }}};
}

// Fed from a line, smooth, its film cavitated over a third of the bearing.
BearingBeside smooth_bearing() {
  BearingBeside bearing{.model = {.R = 0.025, .L = 0.03, .c = 30e-6, .grid = {36, 9}}, .point = {}};
  bearing.model.lubricant.mu0 = 0.02;
  bearing.model.supply = {.kind = film::SupplyKind::fixed_angle, .phi = 1.5, .pressure = 2e5};
  bearing.point.journal_speed = 300;
  bearing.point.load = Eigen::Vector2d(800, -2500);
  return bearing;
}

// Barus' oil between rough surfaces that touch, tilted, fed where the gap is widest.
BearingBeside rough_bearing() {
  BearingBeside bearing = smooth_bearing();
  bearing.model.lubricant.viscosity_law = film::Barus{1.5e-8};
  bearing.model.supply.kind = film::SupplyKind::widest_gap;
  bearing.model.asperities = {.model = film::AsperityModel::greenwood_tripp_exact,
                              .sigma = 1e-6,
                              .elastic_factor = 3e-3,
                              .composite_modulus = 57e9,
                              .mu_friction = 0.1};
  bearing.point.load = Eigen::Vector2d(0, -15000);
  bearing.point.tilt = {1e-4, -5e-5};
  return bearing;
}

SteadyState solved(const BearingBeside& bearing, const SteadyState* from = nullptr) {
  SteadyOptions options{.rtol = 1e-13};
  if (from != nullptr) options.start = from->e, options.start_film = from->u;
  SteadyState state;
  const SteadySummary summary = solve_steady(bearing.model, bearing.point, options, state);
  CAPTURE(summary.message);
  REQUIRE(summary.solved());
  return state;
}

std::vector<double> figures(const BearingBeside& bearing, const SteadyState& state) {
  const BearingNumbers n = bearing_numbers(bearing.model, state);
  std::vector<double> all{state.film.h_min,
                          state.film.p_max,
                          state.film.torque_journal,
                          state.film.power_film + state.film.power_asperity,
                          state.film.flow_left + state.film.flow_right,
                          n.eccentricity_ratio,
                          n.attitude,
                          n.load};
  for (const DynamicCoefficients::Matrix& M : {state.coefficients.stiffness, state.coefficients.damping})
    for (const auto& [i, j] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}}) all.push_back(M(i, j));
  return all;
}

void check_against_solutions(const BearingBeside& bearing) {
  constexpr double step = 1e-4;
  const SteadyState state = solved(bearing);
  const std::vector<double> here = figures(bearing, state);
  SteadyDerivative derivative(bearing.model, state);
  for (const Parameter& parameter : parameters()) {
    CAPTURE(parameter.name);
    std::array sides{bearing, bearing};
    parameter.scale(sides[0], -step);
    parameter.scale(sides[1], step);
    const auto less = derivative.beside(sides[0]), more = derivative.beside(sides[1]);
    REQUIRE((less && more));
    const std::vector<double> below = figures(sides[0], *less), above = figures(sides[1], *more);
    const std::vector<double> solved_below = figures(sides[0], solved(sides[0], &state));
    const std::vector<double> solved_above = figures(sides[1], solved(sides[1], &state));
    for (std::size_t k = 0; k < here.size(); ++k) {
      CAPTURE(k);
      const double tangent = (above[k] - below[k]) / (2 * step),
                   secant = (solved_above[k] - solved_below[k]) / (2 * step);
      CHECK(std::abs(tangent - secant) <= kDifferences * std::max(std::abs(tangent), std::abs(here[k])));
    }
  }
}

TEST_CASE("SteadyDerivatives_AreThoseOfSolutionsNearby") { check_against_solutions(smooth_bearing()); }

TEST_CASE("SteadyDerivativesOfARoughTiltedFilm_AreThoseOfSolutionsNearby") { check_against_solutions(rough_bearing()); }

// A step as short as that of sensitivities to one side, against two sides of a longer one.
TEST_CASE("OneSideOfATangent_TellsTheDerivative") {
  const BearingBeside bearing = rough_bearing();
  const SteadyState state = solved(bearing);
  SteadyDerivative derivative(bearing.model, state);
  const std::vector<double> here = figures(bearing, derivative.here());
  for (const Parameter& parameter : parameters()) {
    CAPTURE(parameter.name);
    const auto figures_at = [&](double step) {
      BearingBeside side = bearing;
      parameter.scale(side, step);
      const auto beside = derivative.beside(side);
      REQUIRE(beside.has_value());
      return figures(side, *beside);
    };
    const std::vector<double> near = figures_at(1e-8), below = figures_at(-1e-5), above = figures_at(1e-5);
    for (std::size_t k = 0; k < here.size(); ++k) {
      CAPTURE(k);
      const double one = (near[k] - here[k]) / 1e-8, two = (above[k] - below[k]) / 2e-5;
      // The step times the curvature, up to fifty, and round-off of some 1e-15 over it.
      CHECK(std::abs(one - two) <= kDifferences * std::max(std::abs(two), std::abs(here[k])));
    }
  }
}

// The position given, its force follows: twice the viscosity, twice the force, where nothing else has a pressure.
TEST_CASE("ForceAtAGivenPosition_IsProportionalToTheViscosity") {
  BearingBeside bearing = smooth_bearing();
  bearing.model.supply.pressure = 0;
  bearing.point.load.reset();
  bearing.point.e = Eigen::Vector2d(10e-6, -12e-6);
  const SteadyState state = solved(bearing);
  SteadyDerivative derivative(bearing.model, state);
  std::array sides{bearing, bearing};
  constexpr double step = 1e-4;
  sides[0].model.lubricant.mu0 *= 1 - step, sides[1].model.lubricant.mu0 *= 1 + step;
  const auto less = derivative.beside(sides[0]), more = derivative.beside(sides[1]);
  REQUIRE((less && more));
  const double slope = (more->load.norm() - less->load.norm()) / (2 * step);
  CHECK(slope == doctest::Approx(state.load.norm()).epsilon(1e-7));  // the square of the step, times ten
  CHECK(more->e == state.e);
}

// Nothing fixes how much oil is in it: it has many answers, and none of them a derivative.
TEST_CASE("FilmWithoutSupply_HasNoDerivative") {
  BearingBeside bearing = smooth_bearing();
  bearing.model.supply = {};
  bearing.point.load.reset();
  bearing.point.e = Eigen::Vector2d(10e-6, -12e-6);
  SteadyDerivative derivative(bearing.model, solved(bearing));
  bearing.model.c *= 1 + 1e-4;
  CHECK_FALSE(derivative.beside(bearing).has_value());
}

}  // namespace steady_derivative_test
}  // namespace hersey::bearing
