// Mechanisms of the IFToMM library of benchmark problems (University of A Coruna, lim.ii.udc.es/mbsbenchmark).
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <utility>

#include "benchmark_mechanisms.h"
#include "hersey/solver/step_control.h"
#include "simulate.h"
#include "source_dir.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace benchmark_test {

constexpr double kBenchmark = 1e-3;  // the benchmark's own measure
constexpr double kInstant = 1e-9;    // s: instants summed up from steps

using test::four_bars;
using test::governor;
using test::Squeezer;

/// Rows of numbers of a CSV file with `#` comments and one header line.
std::vector<std::vector<double>> read_csv(const std::string& name) {
  std::ifstream file(std::string(hersey::source_dir()) + "/verification/data/" + name);
  REQUIRE(file.good());
  std::vector<std::vector<double>> rows;
  bool header = true;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (std::exchange(header, false)) continue;
    std::vector<double>& row = rows.emplace_back();
    std::stringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
  }
  return rows;
}

TEST_CASE("FourBars_PassTheirSingularPositionOnTheRightBranch") {
  const auto m = four_bars(2);
  solver::State state = test::start(*m);
  const auto reference = read_csv("four_bar_n2.csv");
  double worst = 0;
  std::size_t next = 1;
  // First coupler point B0: the tip of crank 0.
  test::run(*m, state, 10, 10000, 0.9, [&](const solver::State& s) {
    if (next >= reference.size() || s.t < reference[next][0] - kInstant) return;
    const FrameMotion crank = m->frame_motion(s, m->spec().body_frames[1]);
    const Vector3 B0 = crank.X_WF * Vector3(1, 0, 0);
    worst = std::max(worst, std::hypot(B0.x() - reference[next][1], B0.y() - reference[next][2]));
    ++next;
  });
  CHECK(next == reference.size());
  MESSAGE("largest error of B0 ", worst);
  CHECK(worst < 1e-3);  // the benchmark's own measure
}

/// Distance of B0 from its position at t = 10 s.
double error_at_the_end(Mechanism& mechanism, const solver::State& state) {
  const Vector3 B0 = mechanism.frame_motion(state, mechanism.spec().body_frames[1]).X_WF * Vector3(1, 0, 0);
  return std::hypot(B0.x() - 0.3284581115, B0.y() - 0.9445185382);
}

struct ChosenSteps {
  int steps = 0, iterations = 0;
  double error = 0;
};

ChosenSteps four_bars_with_tolerance(double tolerance) {
  const auto m = four_bars(2);
  solver::State state = test::start(*m);
  const Eigen::VectorXd scales = m->position_scales();
  solver::GeneralizedAlpha integrator({.spectral_radius = 0.9});
  solver::StepControl control({.smallest = 1e-9, .largest = 0.1}, 1e-4);
  ChosenSteps chosen;
  while (state.t < 10 - 1e-12) {  // the end, but for round-off
    const double dt = control.proposed(10 - state.t);
    Eigen::VectorXd errors;
    const auto check = [&](const solver::State&, const Eigen::VectorXd& estimate) {
      errors = estimate.cwiseQuotient(scales) / tolerance;
      return errors.lpNorm<Eigen::Infinity>() <= 1;
    };
    const solver::StepSummary step = integrator.step(*m, state, dt, check);
    chosen.iterations += step.iterations;
    if (step.solved()) {
      control.accepted(dt, errors);
      ++chosen.steps;
    } else {
      REQUIRE(control.rejected(dt, errors.lpNorm<Eigen::Infinity>()));
    }
  }
  chosen.error = error_at_the_end(*m, state);
  return chosen;
}

TEST_CASE("FourBars_CostNoMoreThanEqualStepsOfTheSameError") {
  // Errors go as the inverse square of the number of steps. A step that lags by one step behind the motion, or keeps
  // the length of a while ago, costs a hundred times the error.
  const auto m = four_bars(2);
  solver::State state = test::start(*m);
  solver::GeneralizedAlpha integrator({.spectral_radius = 0.9});
  int iterations = 0;
  for (int i = 1; i <= 3000; ++i) {
    const solver::StepSummary step = integrator.step(*m, state, 10.0 * i / 3000 - state.t);
    REQUIRE(step.solved());
    iterations += step.iterations;
  }
  const double error = error_at_the_end(*m, state), equal = error * 3000 * 3000;
  for (const double tolerance : {1e-5, 1e-6, 1e-7}) {
    CAPTURE(tolerance);
    const ChosenSteps chosen = four_bars_with_tolerance(tolerance);
    const double size = chosen.error * chosen.steps * chosen.steps;
    MESSAGE(chosen.steps, " steps: ", size / equal, " times the error of equal ones");
    CHECK(size < 1.21 * equal);  // 1.1 times the steps
    // Iterations over those of equal steps of the same error.
    CHECK(chosen.iterations * std::sqrt(chosen.error / error) < iterations);
  }
}

TEST_CASE("FortyFourBarsOfHinges_RunLikeThoseWithoutRedundancy") {
  // Three constraints of each loop are redundant.
  const auto m = four_bars(40, true);
  CHECK(m->redundancies().size() == 40);
  CHECK(m->nv() == 81);
  CHECK(m->nlambda() == 80);
  solver::State state = test::start(*m);
  test::run(*m, state, 10, 500, 0.9);
  const Vector3 B0 = m->frame_motion(state, m->spec().body_frames[1]).X_WF * Vector3(1, 0, 0);
  CHECK(std::hypot(B0.x() - 0.1805122267, B0.y() - 0.9835727406) < kBenchmark);
  const Observation observation = m->observe(state);
  CHECK(observation.constraint_drift < 1e-11);  // Newton's tolerance of constraints
  // Nothing acts across the plane, and nothing shares it out.
  // Nothing but what 1e-9 of the forces in the plane leaves.
  for (const JointObservation& joint : observation.joints) CHECK(std::abs(joint.force.z()) < 1e-6);
}

TEST_CASE("FortyFourBars_MatchTheBenchmark") {
  // 121 coordinates, 120 constraint rows.
  const auto m = four_bars(40);
  solver::State state = test::start(*m);
  test::run(*m, state, 10, 400, 0.9);
  const Vector3 B0 = m->frame_motion(state, m->spec().body_frames[1]).X_WF * Vector3(1, 0, 0);
  const double error = std::hypot(B0.x() - 0.1805122267, B0.y() - 0.9835727406);
  MESSAGE("error of B0 at the end ", error);
  CHECK(error < kBenchmark);
}

TEST_CASE("StiffGovernor_FollowsTheReference") {
  const auto m = governor();
  solver::State state = test::start(*m);
  const auto reference = read_csv("flyball_governor.csv");
  double worst = 0, highest = 0;
  std::size_t next = 1;
  test::run(*m, state, 10, 10000, 0.8, [&](const solver::State& s) {
    const double height = s.q[1];
    highest = std::max(highest, height);
    if (next >= reference.size() || s.t < reference[next][0] - kInstant) return;
    worst = std::max(worst, std::abs(height - reference[next][3]));
    ++next;
  });
  CHECK(next == reference.size());
  MESSAGE("largest error of s ", worst);
  CHECK(worst < 1e-4);                             // the benchmark's own measure
  CHECK(std::abs(highest - 0.7435637640) < 1e-4);  // the benchmark's own measure
}

TEST_CASE("AndrewsSqueezer_MatchesTheTestSet") {
  Squeezer squeezer;
  Mechanism& m = *squeezer.mechanism;
  solver::State state = test::start(m);
  test::run(m, state, 0.03, 6000, 0.9);
  const Observation observation = m.observe(state);
  // Reference solution of the test set at t = 0.03 s.
  const std::pair<const char*, double> reference[] = {{"beta", 15.81077119629904},    {"Theta", -15.75637105984298},
                                                      {"gamma", 0.04082224013073101}, {"Phi", -0.5347301163226948},
                                                      {"delta", 0.5244099658805303},  {"Omega", 0.5347301163226948},
                                                      {"epsilon", 1.048080741042263}};
  for (const auto& angle : reference) {
    CAPTURE(std::string(angle.first));
    CHECK(std::abs(squeezer.angle(observation, angle.first) / angle.second - 1) < 1e-5);  // steps of 5 us, second order
  }
}

}  // namespace benchmark_test
}  // namespace hersey::mbd
