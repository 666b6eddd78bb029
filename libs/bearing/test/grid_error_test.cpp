#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "hersey/bearing/bearing_numbers.h"
#include "hersey/bearing/steady_bearing.h"

namespace hersey::bearing {
namespace grid_error_test {

using film::zero_celsius;

OperatingPoint point() { return {.journal_speed = 100 * std::numbers::pi, .load = Eigen::Vector2d(0, -10e3)}; }

/// A bearing of D 100, B 50, psi 0.001 with ISO VG 46 at 50 degC.
film::FilmModel bearing_on(int n_phi, int n_z) {
  film::Lubricant oil{.mu0 = 1, .density = 869};
  oil.temperature_law = film::WaltherViscosity::through(46e-6, 6.8e-6, 869);
  film::FilmModel model{.R = 0.05,
                        .L = 0.05,
                        .c = 50e-6,
                        .grid = {.n_phi = n_phi, .n_z = n_z},
                        .lubricant = film::at_temperature(oil, 50 + zero_celsius)};
  model.shear_force = film::ShearForce::torque_only;
  return model;
}

// Temperatures, torques and power of a bearing with a groove and a free journal lie within twice the
// estimated error of the grid: an estimate is one standard figure.
TEST_CASE("GridErrorOfHeat_CoversAFinerGrid") {
  const auto solved_on = [](int n_phi, int n_z, SteadyState& state) {
    film::FilmModel model = bearing_on(n_phi, n_z);
    film::SurfaceFeature groove;
    groove.name = "groove";
    groove.phi = 0.5 * std::numbers::pi;
    groove.arc = 2 * std::numbers::pi / 15;
    groove.length = 0.04;
    groove.pressure = 1e5;
    model.features.push_back(groove);
    model = scaled_for(model, point());
    SteadyOptions options{.thermal = film::ThermalModel{.T_supply = 50 + zero_celsius, .T_edges = 50 + zero_celsius}};
    options.thermal->journal = film::FreeJournal{};
    REQUIRE(solve_steady(model, point(), options, state).solved());
    return estimate_grid_error(model, state, options);
  };
  SteadyState coarse, fine;
  const GridError estimate = solved_on(60, 13, coarse);
  solved_on(120, 25, fine);
  REQUIRE(estimate.known);
  const film::HeatObservables &a = coarse.heat->observed, &b = fine.heat->observed;
  CHECK(std::abs(a.T_journal - b.T_journal) < 2 * estimate.T_journal);
  CHECK(std::abs(a.T_max - b.T_max) < 2 * estimate.T_max);
  CHECK(std::abs(a.T_shell_mean - b.T_shell_mean) < 2 * estimate.T_shell_mean);
  CHECK(std::abs(a.T_film_mean - b.T_film_mean) < 2 * estimate.T_film);
  CHECK(std::abs(a.T_side - b.T_side) < 2 * estimate.T_side);
  CHECK(std::abs(coarse.film.torque_journal - fine.film.torque_journal) < 2 * estimate.torque_journal);
  CHECK(std::abs(coarse.film.power_film - fine.film.power_film) < 2 * estimate.power_film);
  CHECK(estimate.T_journal < 2);  // a useful estimate: some tenth of the rise
}

}  // namespace grid_error_test
}  // namespace hersey::bearing
