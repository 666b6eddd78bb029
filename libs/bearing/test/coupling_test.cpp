#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "hersey/bearing/journal_bearing.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/mbd/mechanism_builder.h"
#include "hersey/solver/generalized_alpha.h"
#include "hersey/solver/initialise.h"

namespace hersey::bearing {
namespace coupling_test {

constexpr double kSpeed = 3570 * 2 * std::numbers::pi / 60;

film::FilmModel small_film() {
  film::FilmModel model;
  model.c = 34e-6;
  model.grid = {.n_phi = 36, .n_z = 7};
  model.supply = {.kind = film::SupplyKind::widest_gap, .phi = 0, .pressure = 0};
  return model;
}

// A rod floating on a turning pin, pushed by a constant load: the paper's rig.
struct Rig {
  std::unique_ptr<mbd::Mechanism> mechanism;
  std::shared_ptr<JournalBearing> bearing;
  mbd::ForceId force;
  solver::State state;

  Rig(const film::FilmModel& film, double load, const BearingOptions& options) {
    mbd::MechanismBuilder builder;
    const auto ground = builder.frame_of(mbd::MechanismBuilder::ground());
    const mbd::BodyId pin = builder.add_body({.name = "pin", .mass = 1, .inertia = 1e-3 * Matrix3::Identity()});
    const mbd::BodyId rod = builder.add_body({.name = "rod", .mass = 0.5, .inertia = 1e-3 * Matrix3::Identity()});
    const mbd::JointId main = builder.add_joint({.name = "main",
                                                 .type = mbd::JointType::revolute,
                                                 .inboard = ground,
                                                 .outboard = builder.frame_of(pin),
                                                 .initial = {0},
                                                 .initial_rate = {kSpeed}});
    const mbd::JointId guide = builder.add_joint({.name = "guide",
                                                  .type = mbd::JointType::planar,
                                                  .inboard = ground,
                                                  .outboard = builder.frame_of(rod),
                                                  .initial = {5e-6, -8e-6, 0}});
    builder.add_drive({.name = "motor",
                       .coordinate = {main, 0},
                       .kind = mbd::DriveSpec::Kind::speed,
                       .function = std::make_shared<ConstantFunction>(kSpeed)});
    builder.add_drive({.name = "small_end",
                       .coordinate = {guide, 2},
                       .kind = mbd::DriveSpec::Kind::position,
                       .function = std::make_shared<ConstantFunction>(0.0)});
    mbd::LoadSpec push{.name = "push", .frame = builder.frame_of(rod), .terms = {}};
    push.terms.push_back(
        {.direction = -Vector6::Unit(4), .magnitude = std::make_shared<ConstantFunction>(load), .variables = {}});
    builder.add_load(push);
    bearing = std::make_shared<JournalBearing>("big_end", film, options);
    force = builder.add_force("big_end", builder.frame_of(rod), builder.frame_of(pin), bearing);
    mechanism = builder.finalise();
    state = mechanism->initial_state();
    const solver::InitialiseSummary summary = solver::initialise(
        *mechanism, state, {.fixed = mechanism->given_coordinates(), .fixed_rates = mechanism->given_rates()});
    REQUIRE_MESSAGE(summary.solved(), summary.message);
  }

  // Newton iterations of all steps.
  int advance(double dt, int steps, double rtol = 1e-8, int max_iterations = 60) {
    solver::GeneralizedAlpha integrator({.spectral_radius = 0.6, .rtol = rtol, .max_iterations = max_iterations});
    int iterations = 0;
    for (int k = 0; k < steps; ++k) {
      const solver::StepSummary step = integrator.step(*mechanism, state, dt);
      REQUIRE_MESSAGE(step.solved(), step.message);
      iterations += step.iterations;
    }
    return iterations;
  }

  [[nodiscard]] BearingObservation observe() { return bearing->observe(mechanism->relative_motion(state, force)); }
};

TEST_CASE("PartitionedAndMonolithic_Agree") {
  // Small steps: the partitioned exchange is stable only where the bodies' inertia outweighs the film's damping.
  const double dt = 2e-5;
  Rig monolithic(small_film(), 500, {.coupling = Coupling::monolithic, .initial_dt = dt});
  Rig partitioned(small_film(), 500, {.coupling = Coupling::partitioned, .initial_dt = dt});
  const int fewer = monolithic.advance(dt, 40), more = partitioned.advance(dt, 40);
  MESSAGE("Newton iterations ", fewer, ", exchanges ", more);
  const Eigen::Vector2d e = monolithic.observe().position.e, difference = partitioned.observe().position.e - e;
  // Each step is solved to rtol = 1e-8 of its forces; 40 steps leave at most a few 1e-7 of the motion.
  CHECK(difference.norm() <= 1e-6 * e.norm());
  CHECK(fewer < more);
}

// Corrections taken whole diverge here: the first trial fails; the shorter step is solved as one system, as are the
// next.
TEST_CASE("ExchangeWithoutEnd_IsSolvedAsOneSystem") {
  const double dt = 2e-5;
  Rig monolithic(small_film(), 500, {.coupling = Coupling::monolithic, .initial_dt = dt});
  Rig partitioned(small_film(), 500,
                  {.coupling = Coupling::partitioned,
                   .acceleration = solver::Acceleration::constant,
                   .relaxation = 1,
                   .initial_dt = dt});
  monolithic.advance(dt, 10);
  solver::GeneralizedAlpha integrator({.spectral_radius = 0.6, .rtol = 1e-8, .max_iterations = 10});
  REQUIRE_FALSE(integrator.step(*partitioned.mechanism, partitioned.state, 2 * dt).solved());
  for (int k = 0; k < 10; ++k) {
    REQUIRE(integrator.step(*partitioned.mechanism, partitioned.state, dt).solved());
    CHECK(partitioned.observe().exchanges == 0);
  }
  const Eigen::Vector2d e = monolithic.observe().position.e, difference = partitioned.observe().position.e - e;
  CHECK(difference.norm() <= 1e-6 * e.norm());  // as above: 20 steps, each solved to 1e-8 of its forces
}

TEST_CASE("ExchangeThatEnded_GoesOnInAShorterStep") {
  const double dt = 2e-5;
  Rig rig(small_film(), 500, {.coupling = Coupling::partitioned, .initial_dt = dt});
  solver::GeneralizedAlpha integrator({.spectral_radius = 0.6, .rtol = 1e-8, .max_iterations = 60});
  const auto refuse = [](const solver::State&, const Eigen::VectorXd&) { return false; };
  CHECK(integrator.step(*rig.mechanism, rig.state, dt, refuse).status == solver::StepStatus::inaccurate);
  REQUIRE(integrator.step(*rig.mechanism, rig.state, dt / 2).solved());
  CHECK(rig.observe().exchanges > 0);
}

TEST_CASE("MultigridAndDirect_StepAlike") {
  const double dt = 2e-4;
  film::FilmModel film = small_film();
  film.grid = {.n_phi = 48, .n_z = 9};
  Rig direct(film, 500, {.initial_dt = dt});
  Rig multigrid(film, 500, {.film = {.solver = film::FilmSolver::multigrid}, .initial_dt = dt});
  const int iterations = direct.advance(dt, 30);
  CHECK(multigrid.advance(dt, 30) == iterations);
  const Eigen::Vector2d e = direct.observe().position.e, difference = multigrid.observe().position.e - e;
  // Linear systems to 1e-10, steps to 1e-8, 30 of them.
  CHECK(difference.norm() <= 1e-6 * e.norm());
}

TEST_CASE("FloatingRod_SettlesWhereTheFilmCarriesTheLoad") {
  const double load = 1000;
  Rig rig(small_film(), load, {.initial_dt = 2e-4});
  rig.advance(2e-4, 500);
  const BearingObservation observed = rig.observe();
  const Vector3 force = observed.wrench_on_shell.tail<3>();
  // What is left of the motion after six turns: the force balance holds to the rod's acceleration, 1e-3 of the load.
  CHECK(force.y() == doctest::Approx(load).epsilon(1e-3));
  CHECK(std::abs(force.x()) < 1e-3 * load);
  CHECK(observed.film.mass_balance_error < 1e-6);  // steps are solved to 1e-8
}

TEST_CASE("LinerIsAtRest_InTheFilmOfTheStart") {
  film::FilmModel film = small_film();
  film.supply.pressure = 3e5;
  film.lubricant.mu0 = 9e-3;
  film.compliance = 0.0225 / 115e9;
  Rig rig(film, 500, {.initial_dt = 2e-5});  // requires that the start is found
  const film::FilmFields fields = rig.bearing->fields();
  for (int i = 0; i < film.grid.size(); ++i) CHECK(fields.w[i] == doctest::Approx(film.compliance * fields.p[i]));
  // The same bearing yet to yield to its supply would squeeze its oil out at once: the film shows none of it.
  film::FilmModel rigid = film;
  rigid.compliance = 0;
  const double p_rigid = Rig(rigid, 500, {.initial_dt = 2e-5}).observe().film.p_max;
  // The liner yields by p_max compliance = 0.2 % of the clearance at most; pressure goes with its third power.
  CHECK(rig.observe().film.p_max == doctest::Approx(p_rigid).epsilon(0.01));
  rig.advance(2e-5, 20);
}

TEST_CASE("StepIsSecondOrderInTime_FullFilm") {
  // A film that stays full (half the supply pressure everywhere keeps it from cavitating): no transported fill, so
  // the order is the integrator's.
  film::FilmModel film = small_film();
  film.edge_left.pressure = film.edge_right.pressure = 40e5;
  film.supply.kind = film::SupplyKind::none;
  const auto position = [&](int n, double rtol = 1e-10) {
    Rig rig(film, 300, {.initial_dt = 1e-4});
    rig.advance(4e-3 / n, n, rtol);
    CHECK(rig.observe().film.cavitated_share == 0);
    return rig.observe().position.e;
  };
  const Eigen::Vector2d coarse = position(40), middle = position(80), fine = position(160);
  const double order = std::log2((coarse - middle).norm() / (middle - fine).norm());
  MESSAGE("observed order ", order);
  CHECK(order == doctest::Approx(2.0).epsilon(0.05));
  // Of that nothing is the tolerance of the steps: ten times as much of it leaves a thousandth.
  CHECK((position(160, 1e-9) - fine).norm() < 1e-3 * (middle - fine).norm());
}

TEST_CASE("ClosedGap_IsADomainError") {
  JournalBearing bearing("big_end", small_film());
  mbd::RelativeMotion motion;
  motion.X_AB.r = {40e-6, 0, 0};
  mbd::ForceResponse response;
  bearing.evaluate(motion, false, response);
  CHECK(bearing.domain_error().find("the journal touches the shell") != std::string::npos);
}

// A trial of Newton's method may throw the bodies anywhere: the step is then shortened, the run goes on.
TEST_CASE("JournalTurnedAway_IsADomainError") {
  JournalBearing bearing("big_end", small_film());
  mbd::RelativeMotion motion;
  mbd::ForceResponse response;
  bearing.evaluate(motion, false, response);
  CHECK(bearing.domain_error().empty());
  motion.X_AB.R = Eigen::AngleAxisd(1.5, Vector3::UnitX()).toRotationMatrix();
  bearing.evaluate(motion, false, response);
  CHECK(bearing.domain_error() ==
        "the surfaces do not face each other: the journal's z-axis stands at 86 deg to the shell's");
}

}  // namespace coupling_test
}  // namespace hersey::bearing
