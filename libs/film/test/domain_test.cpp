#include <doctest/doctest.h>

#include <limits>

#include "film_cases.h"
#include "hersey/core/contract.h"

// Trials outside the domain of the film's equations are outcomes, not exceptions; results of a trial inside are finite.
namespace hersey::film {
namespace domain_test {

using Violation = FilmDomain::Violation;

FilmModel big_end() {
  FilmModel m{.R = 0.0225, .L = 0.0156, .c = 34e-6, .grid = {60, 13}};
  m.supply = {SupplyKind::widest_gap, 0, 1e5};
  return m;
}

constexpr double omega = 374;

TEST_CASE("TrialsOutsideTheDomain_AreOutcomes") {
  FilmModel m = big_end();
  m.lubricant.viscosity_law = Barus{2e-8};
  Reynolds reynolds(m);
  const SurfaceMotion open = surfaces(m, turning(m, 0.5, omega)), overlapping = surfaces(m, turning(m, 1.2, omega));
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(m.grid.size());
  Eigen::VectorXd u = none;
  REQUIRE(reynolds.linearise(open, {}, u).is_inside());

  const FilmDomain closed = reynolds.linearise(overlapping, {}, u);
  CHECK(closed.violation == Violation::closed);
  CHECK(overlapping.g[closed.node] <= 0);
  CHECK(text(m, closed).find("the film closes at ") == 0);
  CHECK_THROWS_AS(reynolds.newton_increment(u), ContractError);  // there is nothing to go on from

  u[100] = 1.1e9;  // alpha p = 22
  const FilmDomain stiff = reynolds.linearise(open, {}, u);
  CHECK(stiff.violation == Violation::pressure);
  CHECK(stiff.node == 100);
  CHECK(text(m, stiff).find("viscosity") != std::string::npos);

  u[100] = std::numeric_limits<double>::quiet_NaN();
  CHECK(reynolds.linearise(open, {}, u).violation == Violation::not_finite);
  CHECK(reynolds.linearise(open, {}, none).is_inside());
}

// u contains the outflow over an edge at p_cav, however large it is.
TEST_CASE("OutflowOverAnOpenEdge_IsNoPressure") {
  FilmModel m = big_end();
  m.lubricant.viscosity_law = Barus{2e-8};
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  u[m.grid.index(7, 0)] = 1e12;
  CHECK(check_unknowns(m, u).is_inside());
  u[m.grid.index(7, 3)] = 1e12;
  CHECK(check_unknowns(m, u).node == m.grid.index(7, 3));
}

// Pressures of 1e10 Pa on a soft liner lift its surfaces by centimetres: conductances 1e9 times the model's.
TEST_CASE("AbsurdPressures_LeaveAFiniteNewtonStep") {
  for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
    for (const double size : {1e8, 1e9, 1e10, 9e10}) {
      CAPTURE(static_cast<int>(cavitation));
      CAPTURE(size);
      FilmModel m = big_end();
      m.cavitation = cavitation;
      m.compliance = 2e-3 / 5e9;
      m.features.push_back({.name = "hole", .phi = 1, .arc = 0.5, .length = 5e-3, .pressure = 1e5});
      Reynolds reynolds(m);
      Eigen::VectorXd u(m.grid.size()), du;
      for (int k = 0; k < u.size(); ++k) u[k] = size * std::sin(12.9898 * k) * std::cos(0.37 * k);
      if (!reynolds.linearise(surfaces(m, turning(m, 0.5, omega)), {}, u).is_inside()) continue;
      CHECK_NOTHROW(reynolds.newton_increment(du));
      CHECK(du.allFinite());
      CHECK(reynolds.forces().wrench_on_shell.allFinite());
    }
  }
}

TEST_CASE("SaturatedViscosity_IsSmoothAndBounded") {
  const Lubricant barus{.mu0 = 0.02, .viscosity_law = Barus{2e-8}};
  const Lubricant roelands{.mu0 = 0.02, .viscosity_law = Roelands{0.7}};
  CHECK(log_viscosity_ratio(barus, 0.999e9).value == 2e-8 * 0.999e9);  // to the bit where oil is meant
  for (const Lubricant& oil : {barus, roelands}) {
    for (const double sign : {-1.0, 1.0}) {
      double last = 0;
      for (double p = 1e7; p < 1e300; p *= 1.07) {
        const ValueAndSlope law = log_viscosity_ratio(oil, sign * p);
        REQUIRE(std::isfinite(law.value));
        REQUIRE(std::abs(law.value) <= 1.5 * largest_log_viscosity);
        REQUIRE(sign * law.value >= last);
        last = sign * law.value;
        if (p > 1e13) continue;
        const double d = 1e-5 * p;
        const double difference =
            log_viscosity_ratio(oil, sign * p + d).value - log_viscosity_ratio(oil, sign * p - d).value;
        // Differences of step 1e-5 p, and round-off.
        CHECK(std::abs(law.slope * 2 * d - difference) < 1e-7 * (1e-5 + std::abs(difference)) + 1e-13);
      }
    }
  }
}

// The film thickness under contact is the root of (film.10), wherever Newton's iteration for it begins.
TEST_CASE("Contact_SeparatesSurfacesHoweverFarTheyOverlap") {
  FilmModel m = big_end();
  m.compliance = 2e-3 / 60e9;
  m.asperities = {AsperityModel::greenwood_tripp_exact, 1e-6, 3e-3, 115e9, 0.1};
  SurfaceMotion motion = surfaces(m, turning(m, 0, omega));
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  for (const double g : {1e-5, 1e-6, -1e-6, -4e-6, -1e-3, -1.0, -1e6}) {
    CAPTURE(g);
    motion.g.setConstant(g);
    const FilmFields fields = film_fields(m, motion, u);
    const double h = fields.h[0];
    if (h > 0) CHECK(std::abs(h - g - fields.w[0]) <= 1e-12 * std::abs(g));  // round-off of the terms
    CHECK((h > 0) == (g > -7e-6));                                           // C p_a(0) = 7.08 um
    CHECK((h > 0) == Reynolds(m).linearise(motion, {}, u).is_inside());
  }
  motion.g.setConstant(-1e-6);
  CHECK(film_fields(m, motion, u).h[0] > 0);
}

// A pressure that a liner rests on falls by more than the film is thick: the step is shortened, not the run.
TEST_CASE("LinerThatSinksInOneStep_KeepsItsFilm") {
  FilmModel m = big_end();
  m.compliance = 2e-3 / 1e9;
  Reynolds reynolds(m);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  FilmSolveOptions options;
  for (const double epsilon : {0.5, 1.1, 1.6, 0.3}) {
    CAPTURE(epsilon);
    FilmSolveSummary summary;
    CHECK_NOTHROW(summary = solve_film(reynolds, surfaces(m, turning(m, epsilon, omega)), {}, options, u));
    if (epsilon < 1) CHECK(summary.solved());
    if (!summary.solved()) CHECK(summary.message.find("closes") != std::string::npos);
  }
}

TEST_CASE("FilmWithoutSupply_IsReported") {
  FilmModel m = big_end();
  m.supply = {};
  Reynolds reynolds(m);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  const FilmSolveSummary steady = solve_film(reynolds, surfaces(m, turning(m, 0.35, omega)), {}, {}, u);
  CHECK(steady.message.find("nothing supplies") != std::string::npos);
  CHECK(steady.message.find("shorter step") == std::string::npos);
}

}  // namespace domain_test
}  // namespace hersey::film
