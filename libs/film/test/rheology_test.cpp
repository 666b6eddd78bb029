#include <doctest/doctest.h>

#include <vector>

#include "film_cases.h"
#include "relative.h"

// Laws of viscosity and density against their own values and against closed forms of the film.
namespace hersey::film {
namespace rheology_test {

constexpr double kRoundOff = 1e-12;  // of powers and exponentials

/// Table of an oil that follows Barus' law, with another coefficient at each of three temperatures.
TabledPressure barus_table() {
  TabledPressure table{.p = {0, 5e7, 4e8}, .log_mu = {}};
  for (const auto& [mu, alpha] : {std::pair(0.1, 2.4e-8), {0.02, 2e-8}, {0.005, 1.6e-8}})
    for (const double p : table.p) table.log_mu.push_back(std::log(mu) + alpha * p);
  return table;
}

TEST_CASE("TableOverPressure_IsBilinear") {
  const TabledPressure table = barus_table();
  // A row has its own law, also beyond its last pressure; in the middle of ln mu, which is that of 1/T, the mean
  // applies.
  for (const double p : {0.0, 2e7, 1e8, 1e9})
    CHECK(table.log_ratio(p, 0.02).value == doctest::Approx(2e-8 * p).epsilon(kRoundOff));
  CHECK(table.log_ratio(1e8, std::sqrt(0.1 * 0.02)).value == relative(2.2).epsilon(kRoundOff));
  CHECK(table.log_ratio(1e8, std::sqrt(0.005 * 0.02)).slope == relative(1.8e-8).epsilon(kRoundOff));
  // Colder or hotter than the table pressure does what it does at its ends.
  CHECK(table.log_ratio(1e8, 0.3).value == relative(2.4).epsilon(kRoundOff));
  CHECK(table.log_ratio(1e8, 0.001).value == relative(1.6).epsilon(kRoundOff));
}

TEST_CASE("DensityOverTemperature_IsThatOfTheVolume") {
  Lubricant oil{.density = 860, .rho15 = 870, .expansion = 7e-4};
  CHECK(at_temperature(oil, 388.15).density == relative(870 * 0.93).epsilon(kRoundOff));
  oil.expansion = 0;
  CHECK(at_temperature(oil, 388.15).density == 860);
}

TEST_CASE("LawSlopes_MatchFiniteDifference") {
  const std::vector<Lubricant> oils = {{.mu0 = 0.02, .viscosity_law = Barus{2e-8}},
                                       {.mu0 = 0.02, .viscosity_law = Roelands{0.6}, .density_law = DowsonHigginson{}},
                                       {.mu0 = 0.02, .density_law = ConstantBulkModulus{2e9}},
                                       {.mu0 = 0.03, .viscosity_law = barus_table()}};
  for (const Lubricant& oil : oils) {
    for (const double p : {1e5, 2e7, 5e8}) {
      CAPTURE(p);
      const double d = 1e-4 * p;
      const double viscosity = log_viscosity_ratio(oil, p + d).value - log_viscosity_ratio(oil, p - d).value;
      // Differences of step 1e-4 p.
      CHECK(log_viscosity_ratio(oil, p).slope == doctest::Approx(viscosity / (2 * d)).epsilon(1e-6).scale(1e-8));
      const double density = density_ratio(oil, p + d).value - density_ratio(oil, p - d).value;
      // Round-off of ratios near 1 over the smallest difference, 10 Pa.
      // Differences of step 1e-4 p, of a rise of 0.6e-9 1/Pa.
      CHECK(std::abs(density_ratio(oil, p).slope - density / (2 * d)) < 1e-6 * 0.6e-9 + 1e-16 / d);
    }
  }
}

TEST_CASE("Laws_HaveTheirPublishedValues") {
  // Dowson and Higginson: 22 % at 1 GPa, a third at most. Roelands: tends to Barus at low pressure.
  const Lubricant oil{.mu0 = 0.04, .viscosity_law = Roelands{0.68}, .density_law = DowsonHigginson{}};
  CHECK(density_ratio(oil, 1e9).value == doctest::Approx(1 + 0.6 / 2.7).epsilon(kRoundOff));
  CHECK(density_ratio(oil, 0).value == 1);
  // exp(-9.67) is kept in five digits.
  CHECK(log_viscosity_ratio(oil, 196.2e6).value ==
        doctest::Approx((std::log(0.04) + 9.67) * (std::pow(2, 0.68) - 1)).epsilon(1e-4));
  // The difference is of second order at 1e3 Pa.
  CHECK(log_viscosity_ratio(oil, 1e3).value == relative(1e3 * log_viscosity_ratio(oil, 0).slope).epsilon(1e-5));
  CHECK(log_viscosity_ratio(oil, -1e3).value == 0);  // nor does tension thin the oil
}

TEST_CASE("ConstantBulkModulus_IsThatAtEveryPressure_AndWorkIsItsIntegral") {
  const Lubricant oil{.density_law = ConstantBulkModulus{1.5e9}};
  double work = 0;
  constexpr int n = 1000;
  for (const double p : {1e6, 1e8, 2e9}) {
    const ValueAndSlope density = density_ratio(oil, p);
    CHECK(density.value / density.slope == doctest::Approx(1.5e9).epsilon(kRoundOff));
    work = 0;
    for (int k = 0; k < n; ++k) work += p / n / density_ratio(oil, p * (k + 0.5) / n).value;
    CHECK(oil_work(oil, p) == doctest::Approx(work).epsilon(1e-6));  // midpoint rule of 1000 intervals
  }
}

TEST_CASE("BubblyOil_CompressesItsGasAlone_AndWorkIsItsIntegral") {
  const BubblyOil law{.gas_fraction = 0.2, .pressure = 1e5};
  const Lubricant oil{.density_law = law};
  CHECK(density_ratio(oil, 0).value == doctest::Approx(1).epsilon(kRoundOff));
  // At ten times the pressure a tenth of the gas's volume is left: 0.8 + 0.02 of the volume.
  CHECK(density_ratio(oil, 9e5).value == doctest::Approx(1 / 0.82).epsilon(kRoundOff));
  const double slope = (density_ratio(oil, 9e5 + 10).value - density_ratio(oil, 9e5 - 10).value) / 20;
  CHECK(density_ratio(oil, 9e5).slope == relative(slope).epsilon(1e-6));  // a difference over 1e-5 of the pressure
  double work = 0;
  constexpr int n = 1000;
  for (int k = 0; k < n; ++k) work += 4e5 / n / density_ratio(oil, 4e5 * (k + 0.5) / n).value;
  CHECK(oil_work(oil, 4e5) == doctest::Approx(work).epsilon(1e-6));    // midpoint rule of 1000 intervals
  CHECK(density_ratio({.density_law = BubblyOil{}}, 1e8).value == 1);  // without gas
}

TEST_CASE("SummitsAboveTheMeanPlane_TouchSoMuchSooner") {
  FilmModel plain{.c = 30e-6, .grid = {12, 3}};
  plain.asperities = {AsperityModel::greenwood_tripp_exact, 1e-6, 3e-3, 57e9, 0.1};
  FilmModel raised = plain;
  raised.asperities.mean_summit_height = 1.7e-6;
  SurfaceMotion near = surfaces(plain, {}), far = near;
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(near.g.size());
  for (const double h : {0.2e-6, 1e-6, 2.5e-6}) {
    near.g.setConstant(h), far.g.setConstant(h + 1.7e-6);
    const double p = film_fields(plain, near, u).p_asperity[0];
    CHECK(p > 0);
    CHECK(film_fields(raised, far, u).p_asperity[0] == doctest::Approx(p).epsilon(kRoundOff));
  }
}

// Barus' fluid has the closed form p = -ln(1 - alpha q)/alpha with the isoviscous pressure q (Weibull's
// transformation).
TEST_CASE("BarusFilm_MatchesWeibullsTransformation") {
  FilmModel m{.R = 0.03, .L = 0.01, .c = 30e-6, .grid = {240, 3}};
  m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
  m.supply = {SupplyKind::fixed_angle, 0, 0};
  m.cavitation = Cavitation::reynolds;
  const SolvedFilm isoviscous = solve_cold(m, turning(m, 0.6, 200));
  const double alpha = 0.5 / isoviscous.observed.p_max;
  m.lubricant.viscosity_law = Barus{alpha};
  const SolvedFilm film = solve_cold(m, turning(m, 0.6, 200));
  REQUIRE(film.summary.solved());
  double worst = 0;
  for (Eigen::Index i = 0; i < film.u.size(); ++i) {
    const double exact = -std::log(1 - alpha * isoviscous.fields.p[i]) / alpha;
    worst = std::max(worst, std::abs(film.fields.p[i] - exact));
  }
  CHECK(film.observed.p_max > 1.3 * isoviscous.observed.p_max);
  CHECK(worst < 1e-3 * film.observed.p_max);  // (alpha dp)^2/12 per face, 0.05 per face at most
}

// Nothing leaves a closed bearing: its oil is as dense as the gap is narrow.
TEST_CASE("ClosedGap_CompressesItsOil") {
  FilmModel m{.R = 0.03, .L = 0.01, .c = 30e-6, .grid = {12, 3}};
  m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
  m.lubricant.density_law = DowsonHigginson{};
  SurfaceMotion motion = surfaces(m, {});
  const double dt = 1e-4, closing = 0.002;  // by 0.2 % in one step
  motion.g_rate.setConstant(-closing * m.c / dt);
  FilmHistory history{.dt = dt,
                      .theta = Eigen::VectorXd::Ones(m.grid.size()),
                      .w = Eigen::VectorXd::Zero(m.grid.size()),
                      .density = {}};
  Reynolds reynolds(m);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  const FilmSolveSummary summary = solve_film(reynolds, motion, history, {}, u);
  CAPTURE(summary.message);
  REQUIRE(summary.solved());
  // rho/rho0 = 1 + 0.6e-9 p/(1 + 1.7e-9 p) = 1.002.
  const double p = closing / (0.6e-9 - 1.7e-9 * closing);
  CHECK((u.array() - p).abs().maxCoeff() < 1e-8 * p);  // the solver's tolerance is 1e-10 of the largest throughput
  CHECK(film_fields(m, motion, u).density.isConstant(1 + closing, 1e-12));  // round-off
}

TEST_CASE("CompressibleSteps_ConserveOil") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {40, 9}};
  m.lubricant.viscosity_law = Roelands{0.6};
  m.lubricant.density_law = DowsonHigginson{6e-9, 1.7e-9};
  m.edge_left.pressure = m.edge_right.pressure = 2e5;
  Journal journal{.e = {15e-6, 0}, .e_rate = {0.01, 0.005}, .omega_journal = 300};
  const double dt = 2e-4;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(m.grid.size());
  FilmHistory history{.dt = dt, .theta = none.array() + 1, .w = none, .density = none.array() + 1};
  Reynolds reynolds(m);
  Eigen::VectorXd u = none;
  double volume = 0;
  for (int step = 0; step < 3; ++step) {
    journal.e += dt * journal.e_rate;
    const SurfaceMotion motion = surfaces(m, journal);
    const FilmSolveSummary summary = solve_film(reynolds, motion, history, {}, u);
    CAPTURE(summary.message);
    REQUIRE(summary.solved());
    const FilmObservables o = observe_film(m, motion, history, journal.e, u);
    CHECK(o.mass_balance_error < 1e-9);  // the solver's tolerance is 1e-10 per node
    CHECK(o.cavitated_share > 0.02);
    // A difference of volumes: round-off over the step's change.
    if (step > 0) CHECK(o.oil_volume - volume == relative(dt * o.storage_rate).epsilon(1e-6));
    volume = o.oil_volume;
    const FilmFields fields = film_fields(m, motion, u);
    CHECK(fields.density.maxCoeff() > 1.005);
    history.theta = fields.theta;
    history.density = fields.density;
  }
}

}  // namespace rheology_test
}  // namespace hersey::film
