#pragma once

#include <doctest/doctest.h>

#include <cmath>

#include "hersey/mbd/mechanism.h"
#include "hersey/solver/generalized_alpha.h"
#include "hersey/solver/initialise.h"

namespace hersey::mbd::test {

/// Returns a consistent start with prescribed coordinates fixed.
inline solver::State start(Mechanism& mechanism) {
  solver::State state = mechanism.initial_state();
  const solver::InitialiseSummary summary = solver::initialise(mechanism, state,
                                                               {.fixed = mechanism.given_coordinates(),
                                                                .fixed_rates = mechanism.given_rates(),
                                                                .stiff = mechanism.elastic_coordinates()});
  INFO(summary.message);
  REQUIRE(summary.solved());
  return state;
}

/// Steps to `end` in `steps` equal steps, calling observe(state) after each.
template <class Observe>
void run(Mechanism& mechanism, solver::State& state, double end, int steps, double spectral_radius, Observe observe) {
  solver::GeneralizedAlpha integrator({.spectral_radius = spectral_radius, .rtol = 1e-9});
  const double dt = (end - state.t) / steps, t0 = state.t;
  for (int i = 1; i <= steps; ++i) {
    const solver::StepSummary summary = integrator.step(mechanism, state, t0 + i * dt - state.t);
    INFO(summary.message);
    REQUIRE(summary.solved());
    observe(state);
  }
}

inline void run(Mechanism& mechanism, solver::State& state, double end, int steps, double spectral_radius = 0.8) {
  run(mechanism, state, end, steps, spectral_radius, [](const solver::State&) {});
}

}  // namespace hersey::mbd::test
