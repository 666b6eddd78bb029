#include "hersey/solver/second_order_history.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "hersey/solver/generalized_alpha.h"
#include "one_coordinate.h"

// Condensed unknowns are integrated like the coordinates of the system, with the same steps and results.
namespace hersey::solver {
namespace second_order_history_test {

using Eigen::VectorXd;

constexpr double omega = 20;
const std::vector<double> steps{0.01, 0.01, 0.004, 0.007, 0.02};

/// x'' + omega^2 x = sin(5 t), from rest, where nothing is out of balance.
double force(double x, double t) { return omega * omega * x - std::sin(5 * t); }

/// Its steps are performed by hand, as in a program that uses the library: a linear equation needs one increment.
struct Condensed {
  SecondOrderHistory x;
  double t = 0;
  bool fresh = true;

  static Stage stage_of(double dt, bool fresh) {
    const AlphaParameters parameters(0.8);
    const auto& [alpha_m, alpha_f, gamma, beta] = parameters;
    return {.dt = dt,
            .k = 1,
            .c = gamma / (beta * dt),
            .m = (1 - alpha_m) / ((1 - alpha_f) * beta * dt * dt),
            .dq = {},
            .parameters = parameters,
            .fresh = fresh};
  }
  void solve(double dt) {
    const Stage stage = stage_of(dt, fresh);
    x.begin_step();
    x.predict(stage);
    const double residual = x.acceleration()[0] + force(x.position()[0], t + dt);
    x.move(stage, VectorXd::Constant(1, -residual / (stage.m + omega * omega * stage.k)));
    x.predict(stage);  // a second call within the step has no effect
  }
  void step(double dt) {
    solve(dt);
    x.accept();
    t += dt, fresh = false;
  }
};

TEST_CASE("CondensedUnknown_MovesLikeACoordinateOfTheSystem") {
  test::OneCoordinate e;
  e.force = [](double q, double, double t) { return force(q, t); };
  e.force_by_q = [](double, double, double) { return omega * omega; };
  State state = e.at(0, 0);
  GeneralizedAlpha integrator({.spectral_radius = 0.8, .rtol = 1e-13});
  Condensed condensed;
  condensed.x.start(VectorXd::Zero(1));
  for (const double dt : steps) {
    REQUIRE(integrator.step(e, state, dt).solved());
    condensed.step(dt);
    CHECK(std::abs(condensed.x.position()[0] - state.q[0]) < 1e-14);         // of 2e-3: both are solved to round-off
    CHECK(std::abs(condensed.x.rate()[0] - state.v[0]) < 1e-12);             // over the step
    CHECK(std::abs(condensed.x.acceleration()[0] - state.vdot[0]) < 1e-11);  // over its square
  }
}

TEST_CASE("StepThatIsBegunAgain_HasLeftNothing") {
  Condensed once, again;
  for (Condensed* one : {&once, &again}) one->x.start(VectorXd::Constant(1, 0.01));
  for (const double dt : steps) {
    once.step(dt);
    again.solve(3 * dt);  // given up
    again.step(dt);
    CHECK(once.x.position() == again.x.position());
    CHECK(once.x.rate() == again.x.rate());
  }
}

TEST_CASE("AcceptingWithoutAStep_KeepsTheState") {
  Condensed plain, settled;
  plain.x.start(VectorXd::Constant(1, 0.01));
  settled.x.start(VectorXd::Zero(1));
  settled.x.move({}, VectorXd::Constant(1, 0.01));  // as a static solution does
  settled.x.accept();
  settled.fresh = false;  // what begins in the middle of a run has nothing to go on from either
  plain.step(0.01), settled.step(0.01);
  CHECK(plain.x.position() == settled.x.position());
  CHECK(plain.x.acceleration() == settled.x.acceleration());
}

// A fresh step forgets the algorithmic acceleration, and no more.
TEST_CASE("FreshStep_StartsFromTheAccelerationThereIs") {
  Condensed fresh, going_on;
  for (Condensed* one : {&fresh, &going_on}) one->x.start(VectorXd::Zero(1)), one->step(0.01), one->step(0.01);
  fresh.fresh = true;
  fresh.x.begin_step();
  fresh.x.predict(Condensed::stage_of(0.01, true));
  const VectorXd expected = going_on.x.position() + 0.01 * going_on.x.rate() + 5e-5 * going_on.x.acceleration();
  CHECK((fresh.x.position() - expected).norm() <= 1e-16);  // round-off of 1e-3
  going_on.x.begin_step();
  going_on.x.predict(Condensed::stage_of(0.01, false));
  CHECK((going_on.x.position() - expected).norm() > 1e-10);
}

TEST_CASE("RestoredHistory_ContinuesToTheSameBits") {
  Condensed saved, restored;
  saved.x.start(VectorXd::Constant(1, 0.01));
  saved.step(0.01), saved.step(0.004);
  Archive out;
  saved.x.persist(out);
  Archive in(out.content());
  restored.x.start(VectorXd::Zero(1));
  restored.solve(0.02);  // what was being solved begins again
  restored.x.persist(in);
  restored.t = saved.t, restored.fresh = false;
  CHECK(restored.x.position() == saved.x.position());
  saved.step(0.01), restored.step(0.01);
  CHECK(restored.x.position() == saved.x.position());
  CHECK(restored.x.rate() == saved.x.rate());
}

}  // namespace second_order_history_test
}  // namespace hersey::solver
