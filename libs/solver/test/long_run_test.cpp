#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "hersey/solver/generalized_alpha.h"
#include "one_coordinate.h"

namespace hersey::solver {
namespace long_run_test {

/// A pendulum, q'' = -sin q, swinging to 2 rad: largest error of its energy in periods [from, to).
struct EnergyErrors {
  double early = 0, late = 0;
};

EnergyErrors energy_errors(double rho, int periods, int steps_per_period) {
  test::OneCoordinate e;
  e.force = [](double q, double, double) { return std::sin(q); };
  e.force_by_q = [](double q, double, double) { return std::cos(q); };
  State s = e.at(2, 0);
  GeneralizedAlpha integrator({.spectral_radius = rho, .rtol = 1e-12});
  const double period = 8.3499;  // 4 K(sin 1), 4 decimals: only counts periods
  const auto energy = [](const State& state) { return 0.5 * state.v[0] * state.v[0] - std::cos(state.q[0]); };
  const double start = energy(s);
  EnergyErrors errors;
  for (int i = 0; i < periods * steps_per_period; ++i) {
    REQUIRE(integrator.step(e, s, period / steps_per_period).solved());
    double& error = 10 * i < periods * steps_per_period ? errors.early : errors.late;
    error = std::max(error, std::abs(energy(s) - start));
  }
  return errors;
}

TEST_CASE("Energy_StaysBoundedOverThousandPeriods") {
  // Without dissipation the error of the energy is that within one period, about (omega dt)^2/12 of it, and does not
  // grow: the last nine hundred periods are as accurate as the first hundred.
  const EnergyErrors errors = energy_errors(1, 1000, 60);
  MESSAGE("energy error ", errors.early, ", then ", errors.late);
  CHECK(errors.early < 5e-3);
  CHECK(errors.late < 1.01 * errors.early);
}

TEST_CASE("Energy_LeaksBelowSpectralRadiusOne") {
  // The dissipation that loops need is not free: of third order in the step, in proportion to the number of periods.
  const EnergyErrors errors = energy_errors(0.6, 100, 30), fine = energy_errors(0.6, 100, 60);
  CHECK(errors.late > 2 * errors.early);
  CHECK(fine.late < errors.late / 4);
}

}  // namespace long_run_test
}  // namespace hersey::solver
