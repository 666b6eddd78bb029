#include <doctest/doctest.h>

#include <vector>

#include "hot_film.h"
#include "relative.h"

// Heat that asperities make, shared by the walls.
namespace hersey::film {
namespace asperity_heat_test {

const SurfaceMaterial steel{}, lining{.conductivity = 150, .heat_capacity = 2.4e6};

/// Flux into the first of two half-spaces, cut into layers of `dx`, over that made between them, after `steps` of dt.
double fraction_of_first(const SurfaceMaterial& first, const SurfaceMaterial& second, double dx, double dt, int steps) {
  constexpr int n = 300;
  Eigen::VectorXd T = Eigen::VectorXd::Zero(2 * n);  // of the first from within to its surface, then of the second
  double into_first = 0;
  constexpr double q = 1e6;
  for (int step = 0; step < steps; ++step) {
    Eigen::VectorXd flow(2 * n - 1);
    for (int i = 0; i + 1 < 2 * n; ++i) flow[i] = (i < n ? first : second).conductivity / dx * (T[i] - T[i + 1]);
    // Both surfaces have one temperature, which follows from the two half layers beside it and the heat generated
    // there.
    const double a = 2 * first.conductivity / dx, b = 2 * second.conductivity / dx;
    const double surface = (q + a * T[n - 1] + b * T[n]) / (a + b);
    into_first = a * (surface - T[n - 1]);
    flow[n - 1] = -into_first;
    for (int i = 0; i < 2 * n; ++i) {
      double in = (i > 0 ? flow[i - 1] : 0) - (i + 1 < 2 * n ? flow[i] : 0);
      if (i == n) in = q - into_first - flow[n];
      T[i] += dt * in / (dx * (i < n ? first : second).heat_capacity);
    }
  }
  return into_first / q;
}

TEST_CASE("HeatOfFriction_IsSharedAsBetweenHalfSpaces") {
  const double fraction = heat_partition(lining, steel);
  CHECK(fraction ==
        relative(std::sqrt(150 * 2.4) / (std::sqrt(150 * 2.4) + std::sqrt(50 * 3.6))).epsilon(1e-14));  // round-off
  CHECK(heat_partition(steel, steel) == 0.5);
  CHECK(heat_partition(steel, lining) == relative(1 - fraction).epsilon(1e-14));  // likewise
  // Depths of heat of 26 and 49 layers after 400 steps: their second differences err by less than a fraction of 1e-3.
  const double dx = 0.1e-6, dt = 0.4 * dx * dx * lining.heat_capacity / lining.conductivity;
  CHECK(fraction_of_first(lining, steel, dx, dt, 400) == relative(fraction).epsilon(2e-3));
}

FilmModel rubbing() {
  FilmModel model{.R = 0.025, .L = 0.02, .c = 30e-6, .grid = {.n_phi = 36, .n_z = 9}};
  model.lubricant = {.mu0 = 0.0277, .density = 860};
  model.lubricant.specific_heat = 2000, model.lubricant.conductivity = 0.13;
  model.edge_left = model.edge_right = {EdgeKind::pressure, 1e5, 0};
  model.asperities = {.model = AsperityModel::greenwood_tripp_fit,
                      .sigma = 3e-6,
                      .elastic_factor = 3e-3,
                      .composite_modulus = 1e11,
                      .mu_friction = 0.02};
  return model;
}

// Walls whose temperatures are given and a viscosity that none changes: films that differ in nothing but the fraction,
// so that what is moved from wall to wall is the asperities' heat.
TEST_CASE("AsperitiesHeatWallsByTheirEffusivities") {
  const FilmModel model = rubbing();
  const Journal journal{.e = {-27e-6, 0}, .omega_journal = 120};
  const SurfaceMotion motion = surfaces(model, journal);
  ThermalModel thermal{.layers = 3, .T_supply = 313.15, .T_edges = 313.15};
  thermal.shell = WallAtTemperature{.T = 350}, thermal.journal = WallAtTemperature{.T = 330};
  const auto solved = [&](const SurfaceMaterial& shell, const SurfaceMaterial& at_journal) {
    thermal.shell_surface = shell, thermal.journal_surface = at_journal;
    return solve_hot(model, thermal, motion, journal.e);
  };
  const HotFilm even = solved(steel, steel), lined = solved(lining, steel);
  const double friction = even.film.power_asperity, moved = (heat_partition(lining, steel) - 0.5) * friction;
  REQUIRE(friction > 0.05 * even.heat.balance.power);
  // The residual that GMRES leaves of a steady film's equations, 1e-4, is the same in both.
  CHECK(lined.heat.balance.to_shell - even.heat.balance.to_shell == relative(moved).epsilon(1e-8));
  CHECK(lined.heat.balance.to_journal - even.heat.balance.to_journal == relative(-moved).epsilon(1e-8));  // likewise
  CHECK(lined.heat.balance.power == even.heat.balance.power);
  // A wall without heat leaves its part to the oil.
  thermal.shell = InsulatedWall{};
  const HotFilm insulated = solved(lining, steel);
  CHECK(insulated.heat.balance.to_shell == 0);
  for (const HotFilm* hot : {&even, &lined, &insulated})
    CHECK(hot->heat.balance.error() < 1e-8);  // the film's residual
}

// In a ring and a free journal the balance closes with all fractions.
TEST_CASE("BalanceOfHeat_ClosesWithAnyFractions") {
  FilmModel model = rubbing();
  model.features.push_back({.name = "hole", .phi = 1, .z = 2e-3, .arc = 0.5, .length = 8e-3, .pressure = 3e5});
  const Journal journal{.e = {-27e-6, 0}, .omega_journal = 120};
  ThermalModel thermal{.layers = 3, .T_supply = 313.15, .T_edges = 313.15};
  thermal.shell = RingWall{.outer_radius = 0.04, .T_ambient = 300};
  thermal.journal = FreeJournal{.heat_capacity = 500};
  thermal.shell_surface = lining;
  const HotFilm hot = solve_hot(model, thermal, surfaces(model, journal), journal.e);
  CHECK(hot.heat.balance.error() < 1e-8);  // the film's residual
  CHECK(std::abs(hot.heat.balance.to_journal) <
        1e-6 * hot.heat.balance.power);  // free: no net heat, asperities' included
}

}  // namespace asperity_heat_test
}  // namespace hersey::film
