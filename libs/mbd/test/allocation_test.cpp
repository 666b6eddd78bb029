// A time step after the first takes nothing from the heap.
#include <doctest/doctest.h>

#include <atomic>
#include <cstddef>

#include "benchmark_mechanisms.h"
#include "hersey/mbd/bushing.h"
#include "simulate.h"
#include "test_mechanisms.h"

// Everything ends in malloc: operator new, Eigen's matrices, the sparse solver. The address sanitizer has its own.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {
std::atomic<bool> counting{false};
std::atomic<int> allocations{0};
void count() {
  if (counting) ++allocations;
}
}  // namespace

extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT
void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT
void* __libc_realloc(void* block, std::size_t size);             // NOLINT
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT
void* malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  count();
  return __libc_calloc(number, size);
}
void* realloc(void* block, std::size_t size) {
  count();
  return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count();
  return __libc_memalign(alignment, size);
}
}

namespace hersey::mbd {
namespace {

/// Allocations in steps 4 to 23: the first ones find pivots and sizes.
int allocations_of(Mechanism& mechanism, double dt, double spectral_radius) {
  solver::State state = test::start(mechanism);
  solver::GeneralizedAlpha integrator({.spectral_radius = spectral_radius});
  int iterations = 0;
  allocations = 0;
  for (int i = 0; i < 23; ++i) {
    counting = i >= 3;
    const solver::StepSummary summary = integrator.step(mechanism, state, dt);
    counting = false;
    REQUIRE(summary.converged());
    iterations += summary.iterations;
  }
  CHECK(iterations >= 20);
  return allocations;
}

TEST_CASE("Counter_SeesWhatTheHeapGives") {
  allocations = 0;
  counting = true;
  auto* const vector = new Eigen::VectorXd(100);
  counting = false;
  delete vector;
  CHECK(allocations == 2);
}

TEST_CASE("StepsAfterTheFirst_TakeNothingFromTheHeap") {
  CHECK(allocations_of(*test::four_bars(5), 5e-3, 0.9) == 0);
  CHECK(allocations_of(*test::governor(), 1e-3, 0.8) == 0);
  CHECK(allocations_of(*test::Squeezer().mechanism, 1e-5, 0.9) == 0);
}

TEST_CASE("EveryKindOfPart_TakesNothingFromTheHeap") {
  // Every joint type, balls, closing joints, couplings, drives, loads, springs, friction and control.
  CHECK(allocations_of(*test::nasty_mechanism(), 1e-4, 0.8) == 0);
}

}  // namespace
}  // namespace hersey::mbd
#endif
