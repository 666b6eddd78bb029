// A time step after the first takes nothing from the heap.
#include <doctest/doctest.h>

#include "benchmark_mechanisms.h"
#include "count_allocations.h"
#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace allocation_test {

/// Allocations in steps 4 to 23: the first ones find pivots and sizes.
long allocations_of(Mechanism& mechanism, double dt, double spectral_radius) {
  solver::State state = test::start(mechanism);
  solver::GeneralizedAlpha integrator({.spectral_radius = spectral_radius});
  int iterations = 0;
  long allocations = 0;
  for (int i = 0; i < 23; ++i) {
    const long before = hersey::test::allocations;
    const solver::StepSummary summary = integrator.step(mechanism, state, dt);
    if (i >= 3) allocations += hersey::test::allocations - before;
    REQUIRE(summary.solved());
    iterations += summary.iterations;
  }
  CHECK(iterations >= 20);
  return allocations;
}

TEST_CASE("Counter_CountsAllocations") {
  if (!hersey::test::counts_allocations) return;
  const long before = hersey::test::allocations;
  auto* const vector = new Eigen::VectorXd(100);
  const long taken = hersey::test::allocations - before;
  delete vector;
  CHECK(taken == 2);
}

TEST_CASE("StepsAfterTheFirst_DoNotAllocate") {
  CHECK(allocations_of(*test::four_bars(5), 5e-3, 0.9) == 0);
  CHECK(allocations_of(*test::governor(), 1e-3, 0.8) == 0);
  CHECK(allocations_of(*test::Squeezer().mechanism, 1e-5, 0.9) == 0);
}

TEST_CASE("EveryKindOfPart_DoesNotAllocate") {
  // Every joint type, balls, closing joints, couplings, drives, loads, springs, friction and control.
  CHECK(allocations_of(*test::nasty_mechanism(false), 1e-4, 0.8) == 0);
}

}  // namespace allocation_test
}  // namespace hersey::mbd
