#include <doctest/doctest.h>

#include <cmath>

#include "film_cases.h"

// Rupture and reformation of the film, against integrals of Reynolds' equation in a bearing without end leakage.
namespace hersey::film {
namespace cavity_test {

constexpr double kRoundOff = 1e-9;  // of angles that follow from pressures solved to 1e-10

constexpr double omega = 200, epsilon = 0.6;

FilmModel long_bearing(int n_phi, Cavitation cavitation, double pressure) {
  FilmModel m{.R = 0.03, .L = 0.01, .c = 30e-6, .grid = {n_phi, 3}, .cavitation = cavitation};
  m.supply = {SupplyKind::fixed_angle, 0, pressure};
  m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
  return m;
}

double gap(double phi) { return 1 + epsilon * std::cos(phi); }

// The pressure that builds up from one angle to another where the flow is that of a gap h0 without pressure, over
// 6 mu omega (R/c)^2.
double rise(double from, double to, double h0) {
  constexpr int n = 2000;
  double sum = 0;
  for (int k = 0; k < n; ++k) {
    const double h = gap(from + (to - from) * (k + 0.5) / n);
    sum += (h - h0) / (h * h * h);
  }
  return sum * (to - from) / n;
}

// Returns the angle between two others at which f changes its sign.
template <class Function>
double zero(Function&& f, double low, double high) {
  const bool falls = f(low) > 0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0) == falls ? low : high) = middle;
  }
  return low;
}

TEST_CASE("Cavity_MatchesTheIntegralsOfReynoldsEquation") {
  const FilmModel unit = long_bearing(4, Cavitation::mass_conserving, 0);
  const double p_unit = 6 * unit.lubricant.mu0 * omega * std::pow(unit.R / unit.c, 2), p = 0.2;
  const double rupture = zero([&](double phi) { return p + rise(0, phi, gap(phi)); }, pi, 1.8 * pi);
  const double reformation =
      zero([&](double phi) { return rise(phi, 2 * pi, gap(rupture)) - p; }, rupture + 0.05, 2 * pi - 1e-9);
  REQUIRE(rupture < reformation);
  double error[2][2]{};
  for (int k = 0; k < 2; ++k) {
    const FilmModel m = long_bearing(k == 0 ? 72 : 288, Cavitation::mass_conserving, p * p_unit);
    const SolvedFilm film = solve_cold(m, turning(m, epsilon, omega));
    REQUIRE(film.summary.solved());
    error[k][0] = std::abs(film.observed.rupture_angle - rupture);
    error[k][1] = std::abs(film.observed.reformation_angle - reformation);
  }
  const double cell = 2 * pi / 72;
  CHECK(error[0][0] < 0.1 * cell);
  CHECK(error[1][0] < 0.1 * cell / 4);
  CHECK(error[0][1] < 0.5 * cell);  // the front of a conserved film moves by whole cells between its nodes
  CHECK(error[1][1] < 0.5 * cell / 4);
}

TEST_CASE("Cavity_OfReynoldsAndGuembelEndsAtTheSupply") {
  for (const Cavitation cavitation : {Cavitation::reynolds, Cavitation::guembel}) {
    const FilmModel m = long_bearing(120, cavitation, 0);
    const SolvedFilm film = solve_cold(m, turning(m, epsilon, omega));
    REQUIRE(film.summary.solved());
    // Half the bearing of Sommerfeld's film is under tension.
    const double rupture =
        cavitation == Cavitation::guembel ? pi : zero([](double phi) { return rise(0, phi, gap(phi)); }, pi, 1.8 * pi);
    CHECK(std::abs(film.observed.rupture_angle - rupture) < 0.1 * 2 * pi / 120);
    CHECK(std::abs(std::remainder(film.observed.reformation_angle, 2 * pi)) < kRoundOff);
  }
}

TEST_CASE("Cavity_IsMirroredByTheSenseOfRotation") {
  FilmModel m = long_bearing(90, Cavitation::mass_conserving, 0);
  m.supply.pressure = 1e5;
  const FilmObservables forwards = solve_cold(m, turning(m, epsilon, omega)).observed;
  const FilmObservables backwards = solve_cold(m, turning(m, epsilon, -omega)).observed;
  CHECK(std::abs(std::remainder(forwards.rupture_angle + backwards.rupture_angle, 2 * pi)) < kRoundOff);
  CHECK(std::abs(std::remainder(forwards.reformation_angle + backwards.reformation_angle, 2 * pi)) < kRoundOff);
}

TEST_CASE("FullFilm_HasNoCavity") {
  const FilmModel m = long_bearing(60, Cavitation::mass_conserving, 1e9);
  const FilmObservables whole = solve_cold(m, turning(m, epsilon, omega)).observed;
  CHECK(std::isnan(whole.rupture_angle));
  CHECK(std::isnan(whole.reformation_angle));
  CHECK(whole.cavitated_share == 0);
}

}  // namespace cavity_test
}  // namespace hersey::film
