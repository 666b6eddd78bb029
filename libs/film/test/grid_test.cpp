#include <doctest/doctest.h>

#include "film_cases.h"
#include "gap/grid_geometry.h"
#include "relative.h"

// Graded grids: their spacing, their integrals, and what they gain.
namespace hersey::film {
namespace grid_test {

constexpr double kRoundOff = 1e-14;  // of sums over a row of nodes
constexpr double kWeights = 1e-13;   // round-off of weights, sums of a few products

const Grid graded =
    graded_grid(48, 11, {{.position = 3, .reach = 0.4, .factor = 4}},
                {{.position = -0.5, .reach = 0.1, .factor = 3}, {.position = 0.5, .reach = 0.1, .factor = 3}});

FilmModel on(const Grid& grid) { return {.R = 0.025, .L = 0.02, .c = 25e-6, .grid = grid}; }

TEST_CASE("GradedGrid_IsFineAtItsRefinements") {
  const GridGeometry g(on(graded));
  CHECK(g.dx.sum() == doctest::Approx(2 * pi * 0.025).epsilon(kRoundOff));
  CHECK(g.dz.sum() == relative(0.02).epsilon(kRoundOff));
  int finest = 0;
  g.dx.minCoeff(&finest);
  CHECK(std::abs(graded.phi(finest) - 3) < 0.1);
  CHECK(g.dx.maxCoeff() / g.dx.minCoeff() == doctest::Approx(4).epsilon(0.15));
  CHECK(g.dz[0] == doctest::Approx(g.dz[9]).epsilon(1e-3));  // the midpoint rule that lays the nodes
  CHECK(g.dz[4] / g.dz[0] > 2);
}

TEST_CASE("ResampledGrid_KeepsItsPattern") {
  const Grid half = resampled(graded, 24, 6);
  for (int i = 0; i < 24; ++i) CHECK(half.phi(i) == doctest::Approx(graded.phi(2 * i)).epsilon(kRoundOff));
  for (int j = 0; j < 6; ++j) CHECK(half.z_over_L(j) == doctest::Approx(graded.z_over_L(2 * j)).epsilon(kRoundOff));
  CHECK(resampled({60, 13}, 30, 7).is_uniform());
  const Grid odd = resampled(graded, 25, 8);
  CHECK(odd.z_over_L(7) == 0.5);
  for (int i = 1; i < 25; ++i) CHECK(odd.phi(i) > odd.phi(i - 1));
}

TEST_CASE("Integrals_AreExactForParabolas") {
  const GridGeometry g(on(graded));
  double sum = 0;
  for (int j = 0; j < 11; ++j) sum += g.weight_z[j] * (1 + g.z[j] / 0.01 + std::pow(g.z[j] / 0.01, 2));
  CHECK(sum == relative(0.02 * 4 / 3).epsilon(kWeights));
  // Around the bearing of the fourth order; equal weights where the spacing is equal.
  const auto error = [](int n) {
    const GridGeometry around(on(resampled(graded, n, 5)));
    return std::abs(around.weight_phi.dot((2 * around.phi.array()).sin().square().matrix()) / (pi * 0.025) - 1);
  };
  CHECK(error(48) < 1e-3);  // 48 nodes, fourth order
  const GridGeometry even(on({48, 11}));
  CHECK((even.weight_phi.array() / even.mean_dx - 1).abs().maxCoeff() < kRoundOff);
  CHECK(even.weight_z[0] / even.mean_dz == doctest::Approx(9.0 / 24).epsilon(kWeights));
  CHECK(even.weight_z[1] / even.mean_dz == doctest::Approx(28.0 / 24).epsilon(kWeights));
  CHECK(even.weight_z[2] / even.mean_dz == doctest::Approx(23.0 / 24).epsilon(kWeights));
  CHECK(even.weight_z[5] / even.mean_dz == doctest::Approx(1).epsilon(kWeights));
}

TEST_CASE("AnAngle_LiesBetweenItsNodes") {
  const GridGeometry g(on(graded));
  for (const double angle : {0.0, 0.01, 3.0, 6.28, -0.01, 7.0, graded.phi(17), graded.phi(17) - 1e-14}) {
    const GridGeometry::Location position = g.locate(angle);
    CAPTURE(angle);
    CHECK(position.fraction >= 0);
    CHECK(position.fraction < 1);
    const double found = g.phi[position.node] + position.fraction * g.dx[position.node] / 0.025;
    // Just below a node counts as on it, within 1e-9 of a cell.
    CHECK(std::abs(std::remainder(found - angle, 2 * pi)) < 1e-8);
  }
  CHECK(g.locate(graded.phi(17) - 1e-14).node == 17);
}

double load_of(const Grid& grid, double e) {
  FilmModel m = on(grid);
  m.supply = {SupplyKind::widest_gap, 0, 0};
  m.shear_force = ShearForce::torque_only;
  const SolvedFilm film = solve_cold(m, turning(m, e, 100));
  REQUIRE(film.summary.solved());
  CHECK(film.observed.mass_balance_error < 1e-9);  // the solver's tolerance is 1e-10 per node
  return film.wrench.segment<2>(3).norm();
}

// At eccentricity 0.97 the pressure is a short, steep hill before the narrowest gap. The exact load is extrapolated
// from two equally spaced grids of second order.
TEST_CASE("GradedGrid_GivesTheLoadWithFewerNodes") {
  const double e = 0.97, fine = load_of({480, 25}, e), finer = load_of({960, 25}, e);
  const double exact = finer + (finer - fine) / 3;
  const Refinement minimum{.position = pi, .reach = 0.3, .factor = 6};
  const auto error = [&](const Grid& grid) { return std::abs(load_of(grid, e) / exact - 1); };
  const double even_120 = error({120, 25});
  const double graded_60 = error(graded_grid(60, 25, {minimum}, {})),
               graded_120 = error(graded_grid(120, 25, {minimum}, {})),
               graded_240 = error(graded_grid(240, 25, {minimum}, {}));
  CAPTURE(even_120);
  CAPTURE(graded_60);
  CAPTURE(graded_120);
  CAPTURE(graded_240);
  CHECK(graded_60 < even_120);
  CHECK(graded_120 < 0.15 * even_120);
  CHECK(graded_120 / graded_240 > 3);  // second order, at least nearly; on 60 nodes the error changes its sign
}

}  // namespace grid_test
}  // namespace hersey::film
