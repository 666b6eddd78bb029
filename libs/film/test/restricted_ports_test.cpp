#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "balance/flow_balance.h"
#include "film_cases.h"
#include "hersey/film/film_solver.h"
#include "hersey/film/observables.h"
#include "hersey/film/reynolds.h"
#include "rough_states.h"
#include "seeded_random.h"

// Features behind restrictors: their pressures are unknowns of the film, with exact derivatives.
namespace hersey::film {
namespace restricted_ports_test {

using namespace rough_states;

const RestrictorOil kOil{.mu = 0.03, .density = 870};

/// Each state with two kinds of restrictors before its features.
std::vector<State> restricted_states() {
  std::vector<State> states;
  std::size_t kind = 0;
  const std::vector<RestrictorLaw> laws{Capillary{.length = 0.02, .diameter = 0.8e-3},
                                        Orifice{.diameter = 0.7e-3, .discharge_coefficient = 0.62},
                                        ConstantFlow{.rate = 3e-6, .relief_band = 2e5},  // 2 bar
                                        ConstantFlow{.rate = 2e-6}};
  for (State s : all_states()) {
    if (s.motion.feature_pressure.size() == 0) continue;
    for (SurfaceFeature& feature : s.model.features) {
      feature.restrictor = Restrictor{laws[kind % laws.size()], kOil};
      ++kind;
    }
    s.name += ", restricted";
    states.push_back(s);
    // Recesses that lack oil.
    FlowBalance balance(s.model);
    REQUIRE(balance.evaluate(s.motion, s.history, s.u).is_inside());
    for (const FlowBalance::RestrictedPort& port : balance.restricted_ports())
      s.u[port.node] = -0.1 * fill_scale(s.model);
    s.name += " and starved";
    states.push_back(s);
  }
  return states;
}

TEST_CASE("JacobianWithRestrictors_MatchesFiniteDifference") {
  for (const State& s : restricted_states()) {
    CAPTURE(s.name);
    Reynolds film(s.model);
    const auto residual = [&](const SurfaceMotion& motion, const Eigen::VectorXd& u) -> Eigen::VectorXd {
      REQUIRE(film.linearise(motion, s.history, u).is_inside());
      return film.residual().value;
    };
    const Eigen::VectorXd du = 1e-2 * s.u.cwiseAbs().cwiseProduct(seeded_random(s.u.size(), 1, 5).col(0));
    const Eigen::VectorXd numeric = (residual(s.motion, s.u + d * du) - residual(s.motion, s.u - d * du)) / (2 * d);
    const double scale = residual(s.motion, s.u).norm();
    const Eigen::VectorXd exact = film.jacobian_product(du);
    // du is a hundredth of u, so round-off weighs a hundred times more.
    CHECK((exact - numeric).norm() < 100 * tolerance * exact.norm());
    for (const auto& [name, direction] : directions(s)) {
      const std::string what = name;  // clang 14 captures no structured binding
      CAPTURE(what);
      const Eigen::VectorXd difference =
          (residual(moved(s.motion, direction, d), s.u) - residual(moved(s.motion, direction, -d), s.u)) / (2 * d);
      (void)residual(s.motion, s.u);
      Eigen::MatrixXd along;
      Eigen::Matrix<double, 6, Eigen::Dynamic> wrench;
      film.partials(std::vector<MotionDirection>{direction}, along, wrench);
      const double round_off = 4 * std::numeric_limits<double>::epsilon() * scale / d;
      CHECK((along.col(0) - difference).norm() < tolerance * along.norm() + round_off);
    }
  }
}

TEST_CASE("SolutionsWithRestrictors_AreInversesOfTheJacobian") {
  int solved = 0;
  for (const State& s : restricted_states()) {
    CAPTURE(s.name);
    Reynolds film(s.model);
    REQUIRE(film.linearise(s.motion, s.history, s.u).is_inside());
    const Eigen::VectorXd b = film.residual().value.norm() * seeded_random(s.u.size(), 1, 11).col(0),
                          f = seeded_random(s.u.size(), 1, 13).col(0);
    Eigen::MatrixXd x = b, y = f;
    film.solve(x);
    film.solve(y, SystemMatrix::transposed);
    const double round_off = 1e-9;  // of matrices with conductances of eight decades
    // An open end that holds more oil than lies outside has a row with next to nothing of its own unknown: no state to
    // solve from, as answers beyond any pressure show.
    State given = s;
    for (SurfaceFeature& feature : given.model.features) feature.restrictor.reset();
    Reynolds regular(given.model);
    REQUIRE(regular.linearise(given.motion, given.history, given.u).is_inside());
    Eigen::MatrixXd answer = b;
    regular.solve(answer);
    if (answer.cwiseAbs().maxCoeff() > 1e15) continue;  // Pa
    ++solved;
    CHECK((film.jacobian_product(x.col(0)) - b).norm() < round_off * b.norm());
    CHECK(y.col(0).dot(b) == doctest::Approx(f.dot(x.col(0))).epsilon(round_off));
  }
  CHECK(solved > 30);
}

/// A bearing with four recesses at rest or turning, all of one law.
State four_recesses(const RestrictorLaw& law, double omega, double supply = 3e6) {  // 30 bar
  State s;
  s.model = {.R = 0.05, .L = 0.08, .c = 50e-6, .grid = {48, 17}, .p_cav = 0};
  s.model.lubricant.mu0 = kOil.mu;
  for (int k = 0; k < 4; ++k)
    s.model.features.push_back({.name = "recess_" + std::to_string(k),
                                .phi = k * std::numbers::pi / 2,
                                .arc = std::numbers::pi / 4,
                                .length = 0.05,
                                .pressure = supply,
                                .restrictor = Restrictor{law, kOil}});
  s.motion = surfaces(s.model, Journal{.e = {12e-6, 9e-6}, .omega_journal = omega}, 0);
  s.u.setZero(s.model.grid.size());
  return s;
}

TEST_CASE("FlowThroughARestrictor_IsThatOfTheFilm") {
  for (const RestrictorLaw& law : std::vector<RestrictorLaw>{
           Capillary{.length = 0.03, .diameter = 0.7e-3}, Orifice{.diameter = 0.5e-3, .discharge_coefficient = 0.6},
           FlowResistance{3e11}, ConstantFlow{.rate = 4e-6}, ConstantFlow{.rate = 4e-5, .relief_band = 2e5}}) {
    for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
      for (const double omega : {0.0, 150.0}) {
        State s = four_recesses(law, omega);
        s.model.cavitation = cavitation;
        s.model.p_cav = -6e4;  // Pa: pressures of supplies and recesses are on the same scale
        CAPTURE(std::string(s.model.features[0].restrictor->name()));
        CAPTURE(static_cast<int>(cavitation));
        CAPTURE(omega);
        for (const LinearSolver linear : {LinearSolver::direct, LinearSolver::multigrid}) {
          s.u.setZero();
          Reynolds film(s.model, linear);
          REQUIRE(solve_film(film, s.motion, s.history, {.rtol = 1e-11}, s.u).solved());
          const FilmObservables o = observe_film(s.model, s.motion, s.history, {12e-6, 9e-6}, s.u);
          const double largest = o.flow_features.cwiseAbs().maxCoeff();
          CHECK(largest > 0);
          for (Eigen::Index f = 0; f < 4; ++f) {
            if (o.pressure_features[f] == s.model.p_cav) continue;  // a recess that lacks oil takes what it gets
            const double throttled =
                s.model.features[static_cast<std::size_t>(f)].restrictor->flow(3e6 - o.pressure_features[f]).value;
            CHECK(std::abs(o.flow_features[f] - throttled) < 1e-9 * largest);  // a hundred times the solver's
          }
          if (cavitation == Cavitation::mass_conserving) CHECK(o.mass_balance_error < 1e-9);  // likewise
        }
      }
    }
  }
}

TEST_CASE("WeakRestrictor_IsAGivenPressure") {
  const double weak = 1e6;  // Pa s/m^3, of lands with 1e11
  State s = four_recesses(FlowResistance{weak}, 100), given = s;
  for (SurfaceFeature& feature : given.model.features) feature.restrictor.reset();
  for (State* state : {&s, &given}) {
    Reynolds film(state->model);
    REQUIRE(solve_film(film, state->motion, state->history, {.rtol = 1e-10}, state->u).solved());
  }
  CHECK((s.u - given.u).cwiseAbs().maxCoeff() < 1e-4 * given.u.maxCoeff());  // ten times weak over the lands'
}

// The root of an orifice's law has no slope where there is no drop: Newton's method jumps over it from a film of
// nothing.
TEST_CASE("OrificesWithHardlyAnyDrop_AreFoundFromNothing") {
  for (const double diameter : {0.3e-3, 1e-3, 3e-3}) {
    CAPTURE(diameter);
    State s = four_recesses(Orifice{.diameter = diameter, .discharge_coefficient = 0.6}, 100, 12e6);  // 120 bar
    Reynolds film(s.model);
    REQUIRE(solve_film(film, s.motion, s.history, {.rtol = 1e-10}, s.u).solved());
    const FilmObservables o = observe_film(s.model, s.motion, s.history, {12e-6, 9e-6}, s.u);
    CHECK(o.mass_balance_error < 1e-8);  // a hundred times the solver's
    if (diameter > 2e-3) CHECK(o.pressure_features.minCoeff() > 0.98 * 12e6);
  }
}

// With less than the surfaces carry away, a recess is filled in part, and the film conserves what it gets.
TEST_CASE("RecessThatLacksOil_PassesOnWhatItGets") {
  State s = four_recesses(ConstantFlow{.rate = 4e-7}, 300);
  s.model.edge_left.ambient_fill = s.model.edge_right.ambient_fill = 0;
  Reynolds film(s.model);
  REQUIRE(solve_film(film, s.motion, s.history, {.rtol = 1e-11}, s.u).solved());
  const FilmObservables o = observe_film(s.model, s.motion, s.history, {12e-6, 9e-6}, s.u);
  int starved = 0;
  for (Eigen::Index f = 0; f < 4; ++f) {
    CHECK(o.flow_features[f] == doctest::Approx(4e-7).epsilon(1e-9));  // a hundred times the solver's
    starved += o.pressure_features[f] == 0 ? 1 : 0;
  }
  CHECK(starved > 0);
  CHECK(o.flow_out() == doctest::Approx(4 * 4e-7).epsilon(1e-9));  // likewise
}

}  // namespace restricted_ports_test
}  // namespace hersey::film
