#include "hersey/bearing/journal_bearing.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "rough_film.h"

namespace hersey::bearing {
namespace journal_bearing_test {

film::FilmModel rough_elastic_film() {
  film::FilmModel model = rough_film();
  model.compliance = 0.0225 / 57e9;
  model.profiles = {
      {film::Ovality{3e-6, 0.4}}, {film::Barrel{2e-6}}, {film::Lobes{3, 4e-6, 0.1}, film::Surface::journal}};
  model.features = {{.name = "hole",
                     .shape = film::Ellipse{},
                     .surface = film::Surface::journal,
                     .phi = 2,
                     .arc = 0.9,
                     .length = 8e-3,
                     .pressure = 3e5},
                    {.name = "pocket",
                     .surface = film::Surface::journal,
                     .phi = 4,
                     .arc = 0.7,
                     .length = 7e-3,
                     .is_fed = false,
                     .depth = 8e-6}};
  return model;
}

mbd::RelativeMotion some_motion() {
  mbd::RelativeMotion motion;
  motion.dt = 1e-4;
  motion.X_AB = {rotation_exp({3e-4, -2e-4, 0.4}).toRotationMatrix(), {18e-6, -19e-6, 0}};
  motion.V_AB_A << 0.3, -0.2, 370, 4e-3, -9e-3, 0.05;
  return motion;
}

// The wrench with the film solved to the end at `motion`, from the filled state at `start`.
Vector6 converged_wrench(const mbd::RelativeMotion& start, const mbd::RelativeMotion& motion) {
  JournalBearing bearing("b", rough_elastic_film());
  mbd::ForceResponse response;
  mbd::RelativeMotion at_start = start;
  at_start.dt = 0;
  bearing.evaluate(at_start, false, response);
  REQUIRE(bearing.domain_error().empty());
  bearing.accept_step(at_start);
  bearing.begin_step(start, motion.dt);
  for (int k = 0; k < 30; ++k) bearing.evaluate(motion, true, response);
  REQUIRE(bearing.internal_residual() < 1e-11);  // thirty iterations: as far as round-off lets it
  return response.W_B_A;
}

TEST_CASE("CondensedTangent_MatchesFiniteDifferencesOfConvergedFilm") {
  const mbd::RelativeMotion motion = some_motion();
  JournalBearing bearing("b", rough_elastic_film());
  mbd::ForceResponse response;
  mbd::RelativeMotion at_start = motion;
  at_start.dt = 0;
  bearing.evaluate(at_start, false, response);
  bearing.accept_step(at_start);
  bearing.begin_step(motion, motion.dt);
  for (int k = 0; k < 30; ++k) bearing.evaluate(motion, true, response);
  // Both solved to 1e-11.
  CHECK((response.W_B_A - converged_wrench(motion, motion)).norm() <= 1e-9 * response.W_B_A.norm());

  // Steps of 1e-4 of the clearance (1e-6 of the radius for turns): small against the gap, so that no node changes
  // between full and cavitated, large against round-off.
  for (int j = 0; j < 6; ++j) {
    CAPTURE(j);
    const double step = j < 3 ? 1e-7 : 2e-9;  // as said above
    mbd::RelativeMotion plus = motion, minus = motion;
    plus.X_AB = pose_exp(step * Vector6::Unit(j)) * motion.X_AB;
    minus.X_AB = pose_exp(-step * Vector6::Unit(j)) * motion.X_AB;
    const Vector6 by_pose = (converged_wrench(motion, plus) - converged_wrench(motion, minus)) / (2 * step);
    const double pose_scale = std::max(response.dW_dX.col(j).norm(), 1e-3 * response.dW_dX.norm());
    // As said above: a step's square of the gap, and round-off of films solved to 1e-11 over it.
    CHECK((response.dW_dX.col(j) - by_pose).norm() <= 1e-4 * pose_scale);

    const double speed = j < 3 ? 1e-5 : 1e-7;  // as said above
    plus = minus = motion;
    plus.V_AB_A[j] += speed;
    minus.V_AB_A[j] -= speed;
    const Vector6 by_speed = (converged_wrench(motion, plus) - converged_wrench(motion, minus)) / (2 * speed);
    const double speed_scale = std::max(response.dW_dV.col(j).norm(), 1e-6 * response.dW_dV.norm());
    // As said above: a step's square of the gap, and round-off of films solved to 1e-11 over it.
    CHECK((response.dW_dV.col(j) - by_speed).norm() <= 1e-4 * speed_scale);
  }
}

TEST_CASE("RejectedStep_LeavesTheFilmAsItWas") {
  const mbd::RelativeMotion motion = some_motion();
  JournalBearing bearing("b", rough_elastic_film());
  mbd::ForceResponse response;
  mbd::RelativeMotion at_start = motion;
  at_start.dt = 0;
  bearing.evaluate(at_start, false, response);
  bearing.accept_step(at_start);
  const Eigen::VectorXd before = bearing.fields().p;
  bearing.begin_step(motion, 1e-4);
  mbd::RelativeMotion away = motion;
  away.X_AB.r.x() += 4e-6;
  for (int k = 0; k < 5; ++k) bearing.evaluate(away, true, response);
  bearing.begin_step(motion, 0.5e-4);
  CHECK((bearing.fields().p - before).norm() == 0);
}

// Beside the centre a step holds its supply line where it was; the widest gap of its end may be half a turn away. What
// bodies put into the film that is shown is what this film takes.
TEST_CASE("LineFixedOverAStep_IsShownWhereItWasFixed") {
  film::FilmModel model;
  model.c = 34e-6;
  model.grid = {.n_phi = 48, .n_z = 9};
  model.edge_left = model.edge_right = {.pressure = 1e5};
  model.supply = {.kind = film::SupplyKind::widest_gap, .phi = 0, .pressure = 4e5};
  JournalBearing bearing("b", model);
  mbd::ForceResponse response;
  mbd::RelativeMotion motion;
  motion.X_AB.r = {1e-9, 2e-10, 0};
  motion.V_AB_A[2] = 20;
  bearing.evaluate(motion, false, response);
  REQUIRE(bearing.domain_error().empty());
  bearing.accept_step(motion);
  motion.dt = 1e-5;
  for (int step = 0; step < 4; ++step) {
    bearing.begin_step(motion, motion.dt);
    motion.X_AB.r = {-motion.X_AB.r.y(), motion.X_AB.r.x(), 0};  // a quarter of a turn, for a nanometre
    for (int k = 0; k < 20; ++k) bearing.evaluate(motion, true, response);
    mbd::RelativeMotion end = motion;
    end.dt = 0;
    bearing.accept_step(end);
    const BearingObservation observed = bearing.observe(end);
    CAPTURE(step);
    // Both are integrals over a kink of the pressure within a cell, 2 % apart on this grid; of a line elsewhere, 150 %.
    CHECK(std::abs(observed.power_into_bodies + observed.film.power_taken()) <= 0.04 * observed.film.power_film);
  }
}

// The oil in the bearing changes by what comes and goes, step by step, although the pocket's borders pass a cell or
// more in each. The journal stays where it is: the rate of a moving one is exact at the end of a step, not its mean.
TEST_CASE("RotatingPocket_ConservesOil") {
  film::FilmModel model;
  model.c = 34e-6;
  model.grid = {.n_phi = 40, .n_z = 7};
  model.supply = {.kind = film::SupplyKind::widest_gap, .phi = 0, .pressure = 1e5};
  model.features = {{.name = "pocket",
                     .surface = film::Surface::journal,
                     .arc = 0.8,
                     .length = 8e-3,
                     .is_fed = false,
                     .depth = 30e-6}};
  JournalBearing bearing("b", model);
  mbd::ForceResponse response;
  mbd::RelativeMotion motion;
  motion.X_AB.r = {15e-6, -10e-6, 0};
  const double omega = 370, dt = 5e-4;  // 10.6 degrees a step, cells of 9
  // The velocity of the journal as a body at the bearing's origin: its own centre rests.
  motion.V_AB_A << 0, 0, omega, omega * motion.X_AB.r.y(), -omega * motion.X_AB.r.x(), 0;
  bearing.evaluate(motion, false, response);
  REQUIRE(bearing.domain_error().empty());
  bearing.accept_step(motion);
  double before = bearing.observe(motion).film.oil_volume;
  for (int step = 1; step <= 20; ++step) {
    bearing.begin_step(motion, dt);
    motion.t = step * dt, motion.dt = dt;
    motion.X_AB.R = rotation_exp({0, 0, omega * motion.t}).toRotationMatrix();
    for (int k = 0; k < 15; ++k) bearing.evaluate(motion, true, response);
    REQUIRE(bearing.internal_residual() < 1e-10);  // the tolerance of a film
    bearing.accept_step(motion);
    const film::FilmObservables observed = bearing.observe(motion).film;
    const double came = dt * (observed.flow_supply - observed.flow_left - observed.flow_right);
    // Of what is there: a film solved to 1e-10 of its throughput.
    CHECK(std::abs(observed.oil_volume - before - came) < 1e-9 * observed.oil_volume);
    before = observed.oil_volume;
  }
}

}  // namespace journal_bearing_test
}  // namespace hersey::bearing
