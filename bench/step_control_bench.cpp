// Error against cost of equal steps and of steps chosen by `{tolerance}`.
//
//   step_control_bench [EXAMPLES_DIR]
//
// A mechanism that keeps its energy (IFToMM A02), a bearing in its engine (slider_crank) and a rotor that runs up
// through its critical speed (flexible_rotor). The error is the root mean square of a path over the run, against steps
// four times shorter than the shortest; the cost is that of Newton iterations, rejected steps included. For each
// tolerance the cost of equal steps of the same error is printed, by their error's power law between two of them. The
// geometric mean of the ratios over a case is to be at most 1, though equal steps have their cost only if their length
// is known beforehand.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "benchmark_mechanisms.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "hersey/solver/generalized_alpha.h"
#include "hersey/solver/initialise.h"
#include "hersey/solver/step_control.h"

namespace {

using namespace hersey;

constexpr double kMostAllowed = 1;  // cost over that of equal steps

using Path = std::vector<double>;  // components of one instant after the other

/// What one way of stepping gave.
struct Trial {
  int steps = 0, cost = 0;
  Path path;
};

/// One problem: `equal` takes a number of steps, `chosen` a tolerance.
struct Case {
  std::string name;
  std::vector<int> counts;
  std::vector<double> tolerances;
  double unit = 1;  ///< of the path, what errors are shares of
  std::function<Trial(int)> equal;
  std::function<Trial(double)> chosen;
};

double root_mean_square(const Path& a, const Path& b) {
  double sum = 0;
  for (std::size_t i = 0; i < b.size(); ++i) sum += std::pow(a[i] - b[i], 2);
  return std::sqrt(sum / static_cast<double>(b.size()));
}

struct Point {
  double cost = 0, error = 0;
};

/// Cost of equal steps with this error: a straight line in logarithms between neighbours, or through the last two.
double cost_of_equal(const std::vector<Point>& equal, double error) {
  std::size_t i = 1;
  while (i + 1 < equal.size() && equal[i].error > error) ++i;
  const Point &a = equal[i - 1], &b = equal[i];
  const double slope = std::log(b.cost / a.cost) / std::log(b.error / a.error);
  return a.cost * std::pow(error / a.error, slope);
}

bool compare(const Case& c) {
  fmt::print("\n{}\n{:>24} {:>8} {:>8} {:>11} {:>18}\n", c.name, "", "steps", "Newton", "error", "cost over equal");
  const Path reference = c.equal(4 * c.counts.back()).path;
  std::vector<Point> equal;
  for (const int count : c.counts) {
    const Trial trial = c.equal(count);
    equal.push_back({static_cast<double>(trial.cost), root_mean_square(trial.path, reference) / c.unit});
    fmt::print("{:>24} {:8} {:8} {:11.3e}\n", "equal", trial.steps, trial.cost, equal.back().error);
    std::fflush(stdout);
  }
  double sum = 0;
  for (const double tolerance : c.tolerances) {
    const Trial trial = c.chosen(tolerance);
    const double error = root_mean_square(trial.path, reference) / c.unit;
    const double ratio = trial.cost / cost_of_equal(equal, error);
    sum += std::log(ratio);
    fmt::print("{:>24} {:8} {:8} {:11.3e} {:18.2f}\n", fmt::format("tolerance {:g}", tolerance), trial.steps,
               trial.cost, error, ratio);
    std::fflush(stdout);
  }
  const double mean = std::exp(sum / static_cast<double>(c.tolerances.size()));
  const bool met = mean <= kMostAllowed;
  fmt::print("geometric mean of the ratios: {:.2f}   {} (at most {})\n", mean, met ? "met" : "MISSED", kMostAllowed);
  return met;
}

// A02, two loops: the first crank's angle every 0.05 s, by Hermite interpolation where no step ends there.
class FourBars {
 public:
  static constexpr double kEnd = 10, kInterval = 0.05;

  FourBars() : mechanism_(mbd::test::four_bars(2)), state_(mechanism_->initial_state()) {
    const solver::InitialiseSummary start = solver::initialise(
        *mechanism_, state_, {.fixed = mechanism_->given_coordinates(), .fixed_rates = mechanism_->given_rates()});
    if (!start.solved()) throw std::runtime_error(start.message);
  }

  Trial equal(int count) {
    for (int i = 1; i <= count; ++i) {
      const solver::State before = state_;
      take(before, integrator_.step(*mechanism_, state_, kEnd * i / count - state_.t));
    }
    return trial_;
  }

  Trial chosen(double tolerance) {
    const Eigen::VectorXd scales = mechanism_->position_scales();
    solver::StepControl control({.smallest = 1e-9, .largest = 0.1}, 1e-4);
    while (state_.t < kEnd - 1e-12) {
      const solver::State before = state_;
      const double dt = control.proposed(kEnd - state_.t);
      Eigen::VectorXd errors;
      const auto check = [&](const solver::State&, const Eigen::VectorXd& estimate) {
        errors = estimate.cwiseQuotient(scales) / tolerance;
        return errors.lpNorm<Eigen::Infinity>() <= 1;
      };
      const solver::StepSummary summary = integrator_.step(*mechanism_, state_, dt, check);
      if (summary.solved()) {
        control.accepted(dt, errors);
        take(before, summary);
      } else {
        trial_.cost += summary.iterations;
        if (!control.rejected(dt, errors.lpNorm<Eigen::Infinity>())) throw std::runtime_error(summary.message);
      }
    }
    return trial_;
  }

 private:
  void take(const solver::State& before, const solver::StepSummary& summary) {
    if (!summary.solved()) throw std::runtime_error(summary.message);
    ++trial_.steps;
    trial_.cost += summary.iterations;
    for (; kInterval * static_cast<double>(trial_.path.size() + 1) <= state_.t + 1e-12;) {
      const double h = state_.t - before.t;
      const double x = (kInterval * static_cast<double>(trial_.path.size() + 1) - before.t) / h, y = 1 - x;
      trial_.path.push_back(before.q[0] * (1 + 2 * x) * y * y + state_.q[0] * x * x * (3 - 2 * x) +
                            h * (before.v[0] * x * y * y - state_.v[0] * x * x * y));
    }
  }

  std::unique_ptr<mbd::Mechanism> mechanism_;
  solver::State state_;
  solver::GeneralizedAlpha integrator_{{.spectral_radius = 0.9}};
  Trial trial_;
};

/// A path of a model at the multiples of an interval.
struct Watched {
  std::filesystem::path model, results;
  std::string dataset;
  std::size_t components = 2;
  double duration = 0, interval = 0;  ///< [s]

  [[nodiscard]] Trial run(const std::string& step, const std::string& rows) const {
    std::vector<std::string> all{"output=" + rows};
    all.push_back("simulation.duration=" + fmt::format("{:.17g} s", duration));
    all.push_back("simulation.step=" + step);
    const run::Summary summary =
        run::simulate(model::read(model.string(), all), {.results = results, .overwrite = true});
    if (summary.status != run::Status::completed) throw std::runtime_error(summary.message);
    Trial trial{summary.steps, summary.newton_iterations, {}};
    const results::Reader reader(results);
    const std::vector<double> t = reader.read("/time").values, values = reader.read(dataset).values;
    const std::size_t width = values.size() / t.size();
    double next = interval;
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (std::abs(t[i] - next) > 1e-6 * interval) continue;
      for (std::size_t k = 0; k < components; ++k) trial.path.push_back(values[i * width + k]);
      next += interval;
    }
    return trial;
  }

  [[nodiscard]] Trial equal(int count) const {
    return run(fmt::format("{:.17g} s", duration / count), "{fields_every: 1 s}");
  }
  [[nodiscard]] Trial chosen(double tolerance) const {
    return run(fmt::format("{{tolerance: {:g}}}", tolerance),
               fmt::format("{{interval: {:.17g} s, fields_every: 1 s}}", interval));
  }
};

Case of_model(std::string name, const Watched& watched, std::vector<int> counts, std::vector<double> tolerances,
              double unit) {
  return {std::move(name),
          std::move(counts),
          std::move(tolerances),
          unit,
          [watched](int count) { return watched.equal(count); },
          [watched](double tolerance) { return watched.chosen(tolerance); }};
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path examples = argc > 1 ? argv[1] : "examples";
  const std::filesystem::path results = std::filesystem::temp_directory_path() / "step_control_bench.h5";
  bool met = true;
  try {
    met &= compare({"A02 four-bars, N = 2, 10 s, spectral radius 0.9: the first crank's angle [rad]",
                    {400, 800, 1600, 3200, 6400},
                    {1e-4, 1e-5, 1e-6, 1e-7, 1e-8},
                    1,
                    [](int count) { return FourBars().equal(count); },
                    [](double tolerance) { return FourBars().chosen(tolerance); }});
    const Watched journal{
        examples / "slider_crank/model.yaml", results, "/bearings/big_end/eccentricity", 2, 0.04, 0.04 / 72};
    met &= compare(of_model("slider_crank, 720 degrees: the journal over its clearance", journal,
                            {360, 720, 1440, 2880}, {1e-2, 1e-3, 1e-4, 1e-5}, 34e-6));
    const Watched rotor{examples / "flexible_rotor/model.yaml", results, "/bodies/disc/position", 2, 3, 0.02};
    met &= compare(of_model("flexible_rotor, a run-up of 3 s: the disc [mm]", rotor, {1500, 3000, 6000, 12000},
                            {1e-4, 1e-5, 1e-6}, 1e-3));
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    met = false;
  }
  std::filesystem::remove(results);
  return met ? 0 : 1;
}
