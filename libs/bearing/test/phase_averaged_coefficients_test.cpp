#include "hersey/bearing/phase_averaged_coefficients.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "hersey/bearing/bearing_numbers.h"

namespace hersey::bearing {
namespace phase_averaged_coefficients_test {

constexpr double pi = std::numbers::pi;
constexpr int kPlaces = 8;  // of the bearing against the lines, within a cell

film::FilmModel film_on(int n_phi) {
  film::FilmModel model{.R = 0.0225, .L = 0.02, .c = 34e-6, .grid = {.n_phi = n_phi, .n_z = n_phi / 4 + 1}};
  model.lubricant.mu0 = 0.015;
  model.edge_left.pressure = model.edge_right.pressure = 20e3;  // bears oil into the cavity
  return model;
}

struct Coefficients {
  Eigen::Matrix2d K, C;
};

Coefficients mean_of(const film::FilmModel& model, SteadyState state) {
  state.coefficients = phase_averaged_coefficients(state, turned_films(model, state, {}));
  const LoadAxesCoefficients along_load = in_load_axes(model, state);
  return {along_load.K, along_load.C};
}

/// By how much of the largest entry coefficients differ as the bearing turns against the lines of its grid.
struct Spread {
  double of_one_grid, of_mean;
};

Spread spread_on(int n_phi) {
  const film::FilmModel model = film_on(n_phi);
  Coefficients low, high, low_mean, high_mean;
  for (int k = 0; k < kPlaces; ++k) {
    const double angle = -1.0 + k * 2 * pi / n_phi / kPlaces;
    const OperatingPoint point{.journal_speed = 374,
                               .e = 0.8 * model.c * Eigen::Vector2d(std::cos(angle), std::sin(angle))};
    SteadyState state;
    REQUIRE(solve_steady(model, point, {}, state).solved());
    const LoadAxesCoefficients own = in_load_axes(model, state);
    const Coefficients one{own.K, own.C}, mean = mean_of(model, state);
    const auto widen = [k](Coefficients& lowest, Coefficients& highest, const Coefficients& c) {
      lowest = k == 0 ? c : Coefficients{lowest.K.cwiseMin(c.K), lowest.C.cwiseMin(c.C)};
      highest = k == 0 ? c : Coefficients{highest.K.cwiseMax(c.K), highest.C.cwiseMax(c.C)};
    };
    widen(low, high, one), widen(low_mean, high_mean, mean);
  }
  const auto fraction = [](const Coefficients& lowest, const Coefficients& highest) {
    return std::max((highest.K - lowest.K).maxCoeff() / highest.K.cwiseAbs().maxCoeff(),
                    (highest.C - lowest.C).maxCoeff() / highest.C.cwiseAbs().maxCoeff());
  };
  return {fraction(low, high), fraction(low_mean, high_mean)};
}

TEST_CASE("CoefficientsOfACavitatedFilm_HardlySeeWhereTheLinesLie") {
  const Spread coarse = spread_on(48), fine = spread_on(96);
  MESSAGE("spread within a cell: of one grid ", coarse.of_one_grid, " and ", fine.of_one_grid, ", of the mean ",
          coarse.of_mean, " and ", fine.of_mean);
  CHECK(coarse.of_mean < 0.3 * coarse.of_one_grid);
  CHECK(fine.of_mean < 0.3 * fine.of_one_grid);
  CHECK(fine.of_mean < 0.3 * fine.of_one_grid);
}

/// Nothing jumps there, and the mean differs from one grid by the errors of both, of second order and alike.
TEST_CASE("CoefficientsOfAFullFilm_AreThoseOfItsGrid") {
  film::FilmModel model = film_on(48);
  model.edge_left.pressure = model.edge_right.pressure = 1e9;  // no cavity
  SteadyState state;
  REQUIRE(solve_steady(model, {.journal_speed = 374, .e = Eigen::Vector2d(0.3 * model.c, -0.5 * model.c)}, {}, state)
              .solved());
  const DynamicCoefficients mean = phase_averaged_coefficients(state, turned_films(model, state, {}));
  constexpr double between_grids = 1e-5;  // of both, whose errors of second order are nearly the same
  CHECK((mean.stiffness - state.coefficients.stiffness).norm() < between_grids * mean.stiffness.norm());
  CHECK((mean.damping - state.coefficients.damping).norm() < between_grids * mean.damping.norm());
}

TEST_CASE("TurnedGrid_HasItsLinesFurtherOn") {
  const film::Grid even{.n_phi = 8, .n_z = 3}, quarter = film::turned(even, 0.25);
  for (int i = 0; i < 8; ++i) CHECK(quarter.phi(i) == doctest::Approx((i + 0.25) * pi / 4));
  const film::Grid graded = film::graded_grid(12, 3, {{.position = 1, .reach = 0.5, .factor = 3}}, {});
  CHECK(film::turned(graded, 0.5).phi(11) == doctest::Approx((graded.phi(11) + 2 * pi) / 2));
}

}  // namespace phase_averaged_coefficients_test
}  // namespace hersey::bearing
