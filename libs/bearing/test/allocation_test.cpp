#include <doctest/doctest.h>

#include "count_allocations.h"
#include "hersey/bearing/journal_bearing.h"

namespace hersey::bearing {
namespace allocation_test {

TEST_CASE("IterationOfATimeStep_DoesNotAllocate") {
  film::FilmModel model;
  model.supply = {.kind = film::SupplyKind::widest_gap, .phi = 0, .pressure = 2e5};
  model.features = {{.name = "hole", .surface = film::Surface::journal, .phi = 2, .arc = 0.5, .length = 5e-3}};
  model.compliance = 0.0225 / 57e9;
  for (const auto solver : {film::FilmSolver::newton, film::FilmSolver::multigrid}) {
    CAPTURE(static_cast<int>(solver));
    JournalBearing bearing("b", model, {.film = {.solver = solver}});
    mbd::RelativeMotion motion;
    motion.X_AB = {rotation_exp({1e-4, -1e-4, 0.4}).toRotationMatrix(), {18e-6, -19e-6, 0}};
    motion.V_AB_A << 0.3, -0.2, 370, 4e-3, -9e-3, 0.05;
    mbd::ForceResponse response;
    bearing.evaluate(motion, false, response);
    bearing.accept_step(motion);
    motion.dt = 1e-4;
    bearing.begin_step(motion, motion.dt);
    for (int k = 0; k < 3; ++k) bearing.evaluate(motion, true, response);
    REQUIRE(bearing.domain_error().empty());

    bearing.begin_step(motion, motion.dt);
    const long before = test::allocations;
    for (int k = 0; k < 3; ++k) {
      motion.X_AB.r.x() += 1e-8;
      bearing.evaluate(motion, true, response);
    }
    CHECK(test::allocations - before == 0);
    CHECK(response.W_B_A.norm() > 0);
  }
}

}  // namespace allocation_test
}  // namespace hersey::bearing
