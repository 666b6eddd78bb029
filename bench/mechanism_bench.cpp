// Rigid mechanisms of the IFToMM library: cost and error at two steps each, error against cost of both integrators, and
// how the time per step grows with the number of loops.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "benchmark_mechanisms.h"
#include "hersey/solver/dormand_prince.h"
#include "hersey/solver/generalized_alpha.h"
#include "hersey/solver/initialise.h"
#include "hersey/solver/step_control.h"
#include "mechanisms_pendulum.h"

namespace {

using namespace hersey;
using namespace hersey::mbd;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Cost {
  int steps = 0, iterations = 0;
  double seconds = 0;  ///< of the steps alone
  bool completed = false;
};

/// Steps to `end` in equal steps; `watch` sees every state.
template <class Watch>
Cost run(Mechanism& mechanism, solver::State& state, double end, int steps, double spectral_radius, Watch watch) {
  Cost cost;
  const solver::InitialiseSummary start = solver::initialise(
      mechanism, state, {.fixed = mechanism.given_coordinates(), .fixed_rates = mechanism.given_rates()});
  if (!start.solved()) {
    fmt::print("{}\n", start.message);
    return cost;
  }
  solver::GeneralizedAlpha integrator({.spectral_radius = spectral_radius});
  const double began = cpu_seconds();
  for (int i = 1; i <= steps; ++i) {
    const solver::StepSummary summary = integrator.step(mechanism, state, end * i / steps - state.t);
    if (!summary.solved()) {
      fmt::print("{}\n", summary.message);
      return cost;
    }
    ++cost.steps;
    cost.iterations += summary.iterations;
    watch(state);
  }
  cost.seconds = cpu_seconds() - began;
  cost.completed = true;
  return cost;
}

/// One line of the table; returns whether a target (0: none) was met.
bool print(const std::string& name, double end, const Cost& cost, double error, double target) {
  const bool met = cost.completed && (target == 0 || error <= target);
  fmt::print("{:30} {:9.3g} {:8} {:8.2f} {:9.2f} {:9.3f} {:10.2e}   {}\n", name, 1e3 * end / std::max(cost.steps, 1),
             cost.steps, static_cast<double>(cost.iterations) / std::max(cost.steps, 1),
             1e6 * cost.seconds / std::max(cost.steps, 1), cost.seconds, error,
             target == 0 ? "" : fmt::format("{} (error below {:g})", met ? "met" : "MISSED", target));
  return met;
}

Vector3 first_crank_tip(Mechanism& mechanism, const solver::State& state) {
  return mechanism.frame_motion(state, mechanism.spec().body_frames[1]).X_WF * Vector3(1, 0, 0);
}

/// A01 over 2000 s: the largest distance from the exact place at 4000 outputs.
bool pendulum(int steps, double target) {
  constexpr double end = 2000;
  const auto mechanism = mbd::test::simple_pendulum();
  solver::State state = mechanism->initial_state();
  const verification::Pendulum exact{0.5 * std::numbers::pi, std::sqrt(9.81)};
  double worst = 0;
  int step = 0;
  const Cost cost = run(*mechanism, state, end, steps, 1.0, [&](const solver::State& s) {
    if (++step % (steps / 4000) != 0) return;
    worst = std::max(worst, 2 * std::abs(std::sin(0.5 * (s.q[0] - exact.angle(s.t)))));
  });
  return print("A01 pendulum, 2000 s", end, cost, worst, target);
}

bool four_bars(int N, int steps, double x, double y, double target) {
  const auto mechanism = mbd::test::four_bars(N);
  solver::State state = mechanism->initial_state();
  const Cost cost = run(*mechanism, state, 10, steps, 0.9, [](const solver::State&) {});
  const Vector3 B0 = first_crank_tip(*mechanism, state);
  return print(fmt::format("A02 four-bars, N = {}, 10 s", N), 10, cost, std::hypot(B0.x() - x, B0.y() - y), target);
}

bool squeezer(int steps, double target) {
  // At 0.03 s: IVP test set, problem "andrews".
  const std::array<std::pair<const char*, double>, 7> reference{{{"beta", 15.81077119629904},
                                                                 {"Theta", -15.75637105984298},
                                                                 {"gamma", 0.04082224013073101},
                                                                 {"Phi", -0.5347301163226948},
                                                                 {"delta", 0.5244099658805304},
                                                                 {"Omega", 0.5347301163226948},
                                                                 {"epsilon", 1.048080741042263}}};
  mbd::test::Squeezer squeezer;
  solver::State state = squeezer.mechanism->initial_state();
  const Cost cost = run(*squeezer.mechanism, state, 0.03, steps, 0.9, [](const solver::State&) {});
  const Observation observation = squeezer.mechanism->observe(state);
  double error = 0;
  for (const auto& [name, value] : reference)
    error = std::max(error, std::abs(squeezer.angle(observation, name) / value - 1));
  return print("A03 squeezer, 0.03 s", 0.03, cost, error, target);
}

bool governor(int steps, double target) {
  const auto mechanism = mbd::test::governor();
  solver::State state = mechanism->initial_state();
  const Cost cost = run(*mechanism, state, 10, steps, 0.8, [](const solver::State&) {});
  return print("A05 governor, 10 s", 10, cost, std::abs(state.q[1] - 0.6196229171), target);
}

/// Time per step of N four-bars from N = 10 to 320, and the exponent of its growth.
bool scaling() {
  fmt::print("\n{:>8} {:>12} {:>16} {:>16}\n", "N", "coordinates", "us per step", "us per step / N");
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  int points = 0;
  for (int N = 10; N <= 320; N *= 2) {
    const auto mechanism = mbd::test::four_bars(N);
    solver::State state = mechanism->initial_state();
    const Cost cost = run(*mechanism, state, 1, 200, 0.9, [](const solver::State&) {});
    if (!cost.completed) return false;
    const double per_step = cost.seconds / cost.steps, x = std::log(N), y = std::log(per_step);
    fmt::print("{:8} {:12} {:16.1f} {:16.2f}\n", N, mechanism->nv(), 1e6 * per_step, 1e6 * per_step / N);
    std::fflush(stdout);
    ++points, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double exponent = (points * sxy - sx * sy) / (points * sxx - sx * sx);
  const bool met = exponent <= 1.1;
  fmt::print("exponent of the time per step: {:.3f}   {} (at most 1.1)\n", exponent, met ? "met" : "MISSED");
  return met;
}

/// One way of stepping a mechanism: its cost, and where it ends.
struct Trial {
  int steps = 0;
  double seconds = 0, error = 0;
};

solver::State consistent_start(Mechanism& mechanism) {
  solver::State state = mechanism.initial_state();
  const solver::InitialiseSummary start = solver::initialise(
      mechanism, state, {.fixed = mechanism.given_coordinates(), .fixed_rates = mechanism.given_rates()});
  if (!start.solved()) fmt::print("{}\n", start.message);
  return state;
}

/// Steps of the explicit method chosen by their error, as a run with `step: {tolerance}` chooses them.
Trial explicit_trial(Mechanism& mechanism, double end, double tolerance, solver::State& state) {
  state = consistent_start(mechanism);
  solver::DormandPrince integrator;
  const Eigen::VectorXd scales = mechanism.position_scales();
  solver::StepControl control({.smallest = 1e-9, .largest = 0.02 * end, .order = 8, .reach = 1, .largest_growth = 2},
                              1e-3);
  Eigen::VectorXd errors;
  const auto check = [&](const solver::State&, const Eigen::VectorXd& error) {
    errors = error.cwiseQuotient(scales) / tolerance;
    return errors.lpNorm<Eigen::Infinity>() <= 1;
  };
  Trial trial;
  const double began = cpu_seconds();
  for (; state.t < end * (1 - 1e-12); ++trial.steps) {
    const double dt = control.proposed(end - state.t);
    const solver::StepSummary summary = integrator.step(mechanism, state, dt, check);
    if (summary.solved()) {
      control.accepted(dt, errors);
    } else if (summary.status == solver::StepStatus::inaccurate
                   ? !control.rejected(dt, errors.lpNorm<Eigen::Infinity>())
                   : !control.failed(dt)) {
      fmt::print("{}\n", summary.message);
      break;
    }
  }
  trial.seconds = cpu_seconds() - began;
  return trial;
}

/// Error against processor time of equal steps of generalized-alpha and of chosen steps of the explicit method. The
/// ratio is that of the costs at the error of the explicit steps, by the second order of the others.
bool precision(const std::string& name, std::unique_ptr<Mechanism> mechanism, double end,
               const std::vector<int>& counts, const std::vector<double>& tolerances, double at, double least) {
  solver::State exact = consistent_start(*mechanism);
  solver::DormandPrince integrator;
  constexpr int fine = 1000;  // far below all errors printed
  for (int i = 1; i <= fine; ++i)
    if (!integrator.step(*mechanism, exact, end * i / fine - exact.t, {}).solved()) return false;
  const auto error_of = [&](const solver::State& s) { return (s.q - exact.q).lpNorm<Eigen::Infinity>(); };
  fmt::print("\n{}: largest error of a coordinate at the end\n", name);
  Trial last;
  for (const int count : counts) {
    solver::State state = mechanism->initial_state();
    const Cost cost = run(*mechanism, state, end, count, 0.9, [](const solver::State&) {});
    last = {cost.steps, cost.seconds, error_of(state)};
    fmt::print("{:>36} {:8} steps {:9.4f} s {:10.2e}\n", "generalized_alpha", last.steps, last.seconds, last.error);
  }
  double best = 0;
  for (const double tolerance : tolerances) {
    solver::State state;
    Trial trial = explicit_trial(*mechanism, end, tolerance, state);
    trial.error = error_of(state);
    const double ratio = last.seconds * std::sqrt(last.error / trial.error) / trial.seconds;
    fmt::print("{:>36} {:8} steps {:9.4f} s {:10.2e}   {:.1f} times faster\n",
               fmt::format("dormand_prince, tolerance {:g}", tolerance), trial.steps, trial.seconds, trial.error,
               ratio);
    if (trial.error <= at && best == 0) best = last.seconds * std::sqrt(last.error / at) / trial.seconds;
  }
  const bool met = best >= least;
  fmt::print("at an error of {:g}: {:.1f} times   {} (at least {:g})\n", at, best, met ? "met" : "MISSED", least);
  return met;
}

}  // namespace

int main() {
  fmt::print("{:30} {:>9} {:>8} {:>8} {:>9} {:>9} {:>10}\n", "", "step [ms]", "steps", "Newton", "us/step", "CPU [s]",
             "error");
  bool met = true;
  met &= four_bars(2, 2500, 0.3284581115, 0.9445185382, 0);
  met &= four_bars(2, 10000, 0.3284581115, 0.9445185382, 1e-3);
  met &= four_bars(40, 500, 0.1805122267, 0.9835727406, 1e-3);
  met &= four_bars(40, 2000, 0.1805122267, 0.9835727406, 1e-4);
  met &= squeezer(2000, 0);
  met &= squeezer(6000, 1e-5);
  met &= governor(2500, 0);
  met &= governor(10000, 1e-4);
  met &= pendulum(1000000, 0);
  met &= pendulum(5000000, 1e-3);
  met &=
      precision("A02 four-bars, N = 40, 10 s", mbd::test::four_bars(40), 10, {500, 2000}, {1e-5, 1e-6, 1e-7}, 3e-5, 2);
  met &= precision("A04 Bricard, 10 s", mbd::test::bricard(), 10, {2500, 10000}, {1e-6, 1e-8, 1e-10, 1e-12}, 7e-8, 5);
  met &= precision("A04 Bricard, 10 s", mbd::test::bricard(), 10, {40000}, {1e-8, 1e-9, 1e-10, 1e-11}, 4e-9, 8);
  met &= scaling();
  return met ? 0 : 1;
}
