// Chains of many bodies, which are cut so that the work of a step grows in proportion to their length.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "benchmark_mechanisms.h"
#include "hersey/solver/generalized_alpha.h"
#include "hersey/solver/initialise.h"

namespace hersey::mbd {
namespace long_chain_test {

constexpr int uncut = std::numeric_limits<int>::max();

void step_to(Mechanism& mechanism, solver::State& state, double end, int steps) {
  REQUIRE(solver::initialise(mechanism, state,
                             {.fixed = mechanism.given_coordinates(), .fixed_rates = mechanism.given_rates()})
              .solved());
  solver::GeneralizedAlpha integrator({.spectral_radius = 0.9});
  for (int i = 1; i <= steps; ++i) REQUIRE(integrator.step(mechanism, state, end * i / steps - state.t).solved());
}

TEST_CASE("LongChain_CutOrNot_MovesTheSameWay") {
  for (const bool reversed : {false, true}) {
    const auto whole = test::chain(30, uncut, reversed), parts = test::chain(30, 12, reversed);
    CHECK(whole->nlambda() == 0);
    CHECK(parts->nlambda() == 6 * 3);
    CHECK(parts->nv() - parts->nlambda() == 30);
    CHECK(parts->redundancies().empty());
    solver::State a = whole->initial_state(), b = parts->initial_state();
    step_to(*whole, a, 0.2, 400);
    step_to(*parts, b, 0.2, 400);
    const Observation observation = parts->observe(b), expected = whole->observe(a);
    CHECK(observation.constraint_drift < 1e-10);  // Newton's tolerance of constraints
    for (std::size_t i = 0; i < observation.bodies.size(); ++i) {
      // The same motion by other equations: a chain amplifies what Newton's 1e-8 leaves, from angles to forces.
      CHECK((observation.bodies[i].X_WF.r - expected.bodies[i].X_WF.r).norm() < 1e-6);
      CHECK((observation.bodies[i].v - expected.bodies[i].v).norm() < 1e-4);
    }
    for (std::size_t j = 0; j < observation.joints.size(); ++j) {
      // The same motion by other equations: a chain amplifies what Newton's 1e-8 leaves, from angles to forces.
      CHECK(observation.joints[j].position[0] == doctest::Approx(expected.joints[j].position[0]).epsilon(1e-4));
      CHECK((observation.joints[j].force - expected.joints[j].force).norm() <
            1e-2 * (1 + expected.joints[j].force.norm()));
    }
  }
}

TEST_CASE("LongChain_StartsAtItsJointCoordinates") {
  const auto parts = test::chain(30, 12, false);
  const solver::State start = parts->initial_state();
  const Observation observation = parts->observe(start);
  CHECK(observation.constraint_drift < 1e-12);  // round-off of 30 joints
  solver::State state = start;
  REQUIRE(solver::initialise(*parts, state, {.fixed = parts->given_coordinates(), .fixed_rates = parts->given_rates()})
              .solved());
  CHECK((state.q - start.q).norm() < 1e-12);  // round-off of 30 joints
  CHECK((state.v - start.v).norm() < 1e-10);  // round-off of rates over 30 joints
  for (std::size_t j = 0; j < observation.joints.size(); ++j)
    CHECK(observation.joints[j].position[0] == doctest::Approx(test::chain_angle(static_cast<int>(j))));
}

TEST_CASE("LongChain_TheMatrixGrowsInProportionToItsLength") {
  const auto entries = [](int links) {
    const auto mechanism = test::chain(links, 24, false);
    const solver::State state = mechanism->initial_state();
    Eigen::VectorXd residual, scale;
    solver::Equations::SparseMatrix tangent;
    solver::Stage stage;
    stage.dq.setZero(mechanism->nv());
    mechanism->assemble(state, stage, residual, scale, &tangent);
    return static_cast<double>(tangent.nonZeros());
  };
  const double few = entries(240), many = entries(960);
  CHECK(many / few == doctest::Approx(4).epsilon(0.05));
  CHECK(many < 100 * 960);
}

/// Every number of a motion, bit for bit.
bool are_same(const Observation& a, const Observation& b) {
  const auto is_same = [](const FrameMotion& one, const FrameMotion& other) {
    return one.X_WF.R == other.X_WF.R && one.X_WF.r == other.X_WF.r && one.omega == other.omega && one.v == other.v &&
           one.alpha == other.alpha && one.a == other.a;
  };
  return std::equal(a.bodies.begin(), a.bodies.end(), b.bodies.begin(), b.bodies.end(), is_same);
}

TEST_CASE("Observation_IsOfItsOwnState_AfterAnyOtherEvaluation") {
  const auto used = test::chain(30, 12);
  solver::State start = used->initial_state();
  start.vdot.setLinSpaced(-1, 1);
  solver::State position = start, rate = start, acceleration = start;
  position.q[3] += 0.1, rate.v[3] += 0.1, acceleration.vdot[3] += 0.1;
  for (const solver::State* other : {&position, &rate, &acceleration}) {
    CHECK_FALSE(are_same(used->observe(*other), used->observe(start)));
    CHECK(are_same(used->observe(*other), test::chain(30, 12)->observe(*other)));
    CHECK(are_same(used->observe(start), test::chain(30, 12)->observe(start)));
    Eigen::VectorXd velocity, bias;
    used->constraint_rates(start, velocity, bias);  // leaves accelerations without vdot
    CHECK(are_same(used->observe(start), test::chain(30, 12)->observe(start)));
    Eigen::VectorXd phi, scale;
    used->constraints(*other, phi, scale, nullptr);  // leaves other positions
    CHECK(are_same(used->observe(start), test::chain(30, 12)->observe(start)));
  }
}

}  // namespace long_chain_test
}  // namespace hersey::mbd
