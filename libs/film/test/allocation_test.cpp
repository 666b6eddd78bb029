#include <doctest/doctest.h>

#include <vector>

#include "count_allocations.h"
#include "film_cases.h"
#include "seeded_random.h"

namespace hersey::film {
namespace allocation_test {

FilmModel big_end() {
  FilmModel m{.R = 0.0225, .L = 0.0156, .c = 34e-6, .grid = {60, 13}};
  m.supply = {SupplyKind::widest_gap, 0, 1e5};
  m.compliance = m.R / 57e9;
  m.asperities = {AsperityModel::greenwood_tripp_fit, 1e-6, 3e-3, 57e9, 0.1};
  m.features = {{.name = "hole", .surface = Surface::journal, .arc = 0.5, .length = 5e-3, .pressure = 3e5}};
  return m;
}

constexpr double omega = 374;

struct Step {
  SurfaceMotion motion;
  FilmHistory history;
  Eigen::VectorXd u;
};

Step some_step(const FilmModel& m) {
  Step step;
  Journal journal = turning(m, 0.8, omega);
  journal.e_rate = {2e-3, 1e-3};
  step.motion = surfaces(m, journal, 0.3);
  step.history = {1e-4, Eigen::VectorXd::Ones(m.grid.size()), Eigen::VectorXd::Zero(m.grid.size())};
  step.u.setZero(m.grid.size());
  Reynolds reynolds(m);
  REQUIRE(solve_film(reynolds, step.motion, step.history, {}, step.u).solved());
  return step;
}

std::vector<MotionDirection> some_directions(const FilmModel& m) {
  std::vector<MotionDirection> directions(3);
  directions[0].g = Eigen::VectorXd::Ones(m.grid.size());
  directions[1].g_rate = Eigen::VectorXd::Ones(m.grid.size());
  directions[2].u_journal = 1;
  return directions;
}

TEST_CASE("AllocationsAreCounted") {
  if (!test::counts_allocations) return;
  const long before = test::allocations;
  const Eigen::VectorXd field = Eigen::VectorXd::Ones(1000);
  const std::vector<double> values(1000, field[0]);
  CHECK(test::allocations - before == 2);
  CHECK(values.back() == 1);
}

TEST_CASE("WarmLinearisation_DoesNotAllocate") {
  // The operations are those of one iteration of a time step: linearise, Newton increment, responses to several
  // changes, wrench and its gradient.
  const FilmModel m = big_end();
  Step step = some_step(m);
  const std::vector<MotionDirection> directions = some_directions(m);
  for (const auto linear : {LinearSolver::direct, LinearSolver::multigrid}) {
    CAPTURE(static_cast<int>(linear));
    Reynolds reynolds(m, linear);
    Eigen::VectorXd du;
    Eigen::MatrixXd answers;
    Eigen::Matrix<double, 6, Eigen::Dynamic> wrench;
    SurfaceShapes shapes = SurfaceShapes::none(m.grid.size());
    shapes.openings = seeded_random(m.grid.size(), 2, 3);
    shapes.surfaces.push_back({shapes.openings.sparseView(), {}, Eigen::MatrixXd::Identity(2, 2), false});
    CondensedFilm condensed;
    const Eigen::VectorXd still = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(directions.size()) + 4);
    Vector6 sum = Vector6::Zero();
    const auto iterate = [&] {
      reynolds.linearise(step.motion, step.history, step.u);
      reynolds.newton_increment(du);
      respond(reynolds, directions, answers, wrench);
      reynolds.condense(directions, shapes, condensed);
      reynolds.follow(still, shapes, du);
      sum = reynolds.forces().wrench_on_shell + reynolds.forces().wrench_by_u * du;
    };
    step.motion.phi_journal = 0;
    iterate();
    const long before = test::allocations;
    for (int k = 1; k <= 5; ++k) {
      step.motion.phi_journal = 1e-3 * k;
      iterate();
    }
    CHECK(test::allocations - before == 0);
    CHECK(sum.norm() > 0);
  }
}

}  // namespace allocation_test
}  // namespace hersey::film
