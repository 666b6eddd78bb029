#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/bearing/phase_averaged_coefficients.h"
#include "hersey/bearing/steady_bearing.h"

// A steady bearing by multigrid, whose position is found on coarser grids first (bearing.39, bearing.40).
namespace hersey::bearing {
namespace fine_grid_test {

constexpr double pi = std::numbers::pi;
constexpr double kSamePosition = 1e-8;  // of the clearance: searches to 1e-10 of the load, on films of some stiffness
constexpr double kSameCoefficients = 1e-5;  // right-hand sides to 1e-7, times a condition of some ten

struct Case {
  std::string name;
  film::FilmModel model;
  OperatingPoint point;
};

OperatingPoint under_load(double newtons, double angle, double omega) {
  OperatingPoint point{.journal_speed = omega};
  point.load = newtons * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  return point;
}

film::FilmModel big_end(const film::Grid& grid) {
  film::FilmModel model{.R = 0.0225, .L = 0.0156, .c = 34e-6, .grid = grid};
  model.lubricant.mu0 = 0.015;
  model.supply = {.kind = film::SupplyKind::widest_gap, .phi = 0, .pressure = 0};
  return model;
}

std::vector<Case> cases(const film::Grid& grid) {
  std::vector<Case> all;
  all.push_back({"plain", big_end(grid), under_load(2500, -pi / 2, 374)});
  Case grooved{"grooved", big_end(grid), under_load(1500, 0.4, 374)};
  grooved.model.supply = {};
  grooved.model.features = {{.name = "groove", .phi = 1, .arc = 0.4, .length = 0.6 * grooved.model.L, .pressure = 2e5}};
  all.push_back(grooved);
  Case tilted{"misaligned", big_end(grid), under_load(2000, 2, 374)};
  tilted.point.tilt = {2e-4, 3e-4};
  all.push_back(tilted);
  Case pressed{"pressed from one side", big_end(grid), under_load(1000, -1, 374)};
  pressed.model.supply = {};
  pressed.model.edge_left.pressure = 2e5;
  pressed.model.edge_right.pressure = 1e4;
  all.push_back(pressed);
  Case lemon{"lemon", big_end(grid), under_load(1500, -pi / 2, 374)};
  lemon.model.supply = {.kind = film::SupplyKind::fixed_angle, .phi = 0, .pressure = 1e5};
  lemon.model.profiles = {{film::Lobes{.count = 2, .offset = 15e-6, .angle = pi / 2}, film::Surface::shell}};
  all.push_back(lemon);
  return all;
}

struct Solution {
  SteadySummary summary;
  SteadyState state;
};

Solution solved(const Case& c, const SteadyOptions& options) {
  Solution solution;
  solution.summary = solve_steady(c.model, c.point, options, solution.state);
  CAPTURE(solution.summary.message);
  REQUIRE(solution.summary.solved());
  return solution;
}

double distance(const DynamicCoefficients::Matrix& a, const DynamicCoefficients::Matrix& b) {
  return (a.topLeftCorner<2, 2>() - b.topLeftCorner<2, 2>()).norm() / b.topLeftCorner<2, 2>().norm();
}

/// A start of nothing: the search then begins on the grid itself.
SteadyOptions on_the_grid_alone(const Case& c, film::FilmSolver solver) {
  SteadyOptions options{.solver = solver};
  options.start_film = Eigen::VectorXd::Zero(c.model.grid.size());
  return options;
}

TEST_CASE("MultigridAndFactor_FindTheSameBearing") {
  for (const film::Grid& grid : {film::Grid{60, 13}, film::Grid{121, 26}, film::Grid{160, 35}}) {
    for (const Case& c : cases(grid)) {
      CAPTURE(c.name);
      CAPTURE(grid.n_phi);
      const Solution direct = solved(c, on_the_grid_alone(c, film::FilmSolver::newton));
      const Solution fine = solved(c, {.solver = film::FilmSolver::multigrid});
      CHECK((fine.state.e - direct.state.e).norm() < kSamePosition * c.model.c);
      CHECK((fine.state.load - *c.point.load).norm() < kSamePosition * c.point.load->norm());
      CHECK(std::abs(fine.state.film.torque_journal / direct.state.film.torque_journal - 1) < kSamePosition);
      CHECK(std::abs(fine.state.film.flow_sides() - direct.state.film.flow_sides()) <
            kSamePosition * std::abs(direct.state.film.flow_left) +
                kSamePosition * std::abs(direct.state.film.flow_right));
      CHECK(distance(fine.state.coefficients.stiffness, direct.state.coefficients.stiffness) < kSameCoefficients);
      CHECK(distance(fine.state.coefficients.damping, direct.state.coefficients.damping) < kSameCoefficients);
    }
  }
}

// The same search but for where it begins: fewer linearisations lead to the same position.
TEST_CASE("CoarseGrids_ShortenTheSearchAndLeaveItsAnswer") {
  for (const auto solver : {film::FilmSolver::newton, film::FilmSolver::multigrid}) {
    int with = 0, without = 0;
    for (const Case& c : cases({160, 35})) {
      CAPTURE(c.name);
      const Solution alone = solved(c, on_the_grid_alone(c, solver)), led = solved(c, {.solver = solver});
      with += led.summary.iterations;
      without += alone.summary.iterations;
      CHECK((led.state.e - alone.state.e).norm() < kSamePosition * c.model.c);
    }
    CHECK(with < 0.7 * without);
  }
}

// A bearing in a mirror: the load's angle, the speed and the terms across change their signs.
TEST_CASE("MirroredBearing_HasMirroredCoefficients") {
  Case here{"", big_end({120, 26}), under_load(2000, 0.7, 374)};
  Case there = here;
  there.point = under_load(2000, -0.7, -374);
  const SteadyOptions options{.solver = film::FilmSolver::multigrid};
  const Solution a = solved(here, options), b = solved(there, options);
  const auto mean = [&](const Case& c, const SteadyState& state) {
    return phase_averaged_coefficients(c.model, state, options).stiffness.topLeftCorner<2, 2>().eval();
  };
  const Eigen::Matrix2d K = mean(here, a.state), mirrored = mean(there, b.state);
  const Eigen::Matrix2d flip = Eigen::Vector2d(1, -1).asDiagonal();
  CHECK((a.state.e - flip * b.state.e).norm() < kSamePosition * here.model.c);
  CHECK((K - flip * mirrored * flip).norm() < kSameCoefficients * K.norm());
}

// The mean over the places of the lines, with and without the films on the other grids.
TEST_CASE("MeanCoefficients_AreThoseOfTheFilmsOnAllGrids") {
  for (const auto solver : {film::FilmSolver::newton, film::FilmSolver::multigrid}) {
    for (const Case& c : cases({80, 17})) {
      CAPTURE(c.name);
      const SteadyOptions options{.solver = solver};
      const SteadyState state = solved(c, options).state;
      const DynamicCoefficients brief = phase_averaged_coefficients(c.model, state, options);
      const DynamicCoefficients whole = phase_averaged_coefficients(state, turned_films(c.model, state, options));
      CHECK(distance(brief.stiffness, whole.stiffness) < kSameCoefficients);
      CHECK(distance(brief.damping, whole.damping) < kSameCoefficients);
    }
  }
}

}  // namespace fine_grid_test
}  // namespace hersey::bearing
