#include "time_stepping/shooting.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "hersey/solver/least_residual.h"

namespace hersey::run {
namespace {

constexpr std::size_t kMostTrials = 12;
constexpr double kGrowth = 4;  // of the residual, beyond which earlier trials say nothing of where the machine is
constexpr std::size_t kFewestTrials = 3;

// Trials of x = P(x), newest first.
struct Trials {
  std::vector<Motion> ends;
  std::vector<Eigen::VectorXd> residuals;

  void add(Motion end, Eigen::VectorXd residual) {
    ends.insert(ends.begin(), std::move(end));
    residuals.insert(residuals.begin(), std::move(residual));
    keep(kMostTrials);
  }
  void keep(std::size_t most) {
    ends.resize(std::min(ends.size(), most));
    residuals.resize(ends.size());
  }
};

double largest(const Eigen::VectorXd& way) { return way.size() > 0 ? way.cwiseAbs().maxCoeff() : 0; }

}  // namespace

Shooting shoot(PeriodMap& map, const ShootingOptions& options) {
  Shooting found;
  Trials trials;
  Motion start = map.motion();
  while (found.periods < options.most) {
    const bool is_predicted = !trials.ends.empty();
    const Outcome period = is_predicted ? map.take_from(start) : map.take();
    ++found.periods;
    if (!period.solved()) {
      if (options.on_period) options.on_period(std::numeric_limits<double>::quiet_NaN());
      // A prediction that no machine can follow: the motion before it goes on as it is.
      if (!is_predicted || found.periods == options.most) return no_answer<Shooting>(period.message);
      trials.keep(0);
      start = map.motion();
      continue;
    }
    Motion end = map.motion();
    Eigen::VectorXd residual = way_between(map.mechanism(), start, end);
    if (!options.predicts) trials.keep(0);
    trials.add(std::move(end), std::move(residual));
    std::vector<Eigen::VectorXd> residuals = trials.residuals;
    for (Eigen::VectorXd& way : residuals) map.compare_by_swing(way);
    const double misfit = largest(residuals.front().head(map.coordinates()));
    if (options.on_period) options.on_period(misfit);
    if (residuals.size() > 1 && residuals[0].norm() > kGrowth * residuals[1].norm()) {
      trials.keep(1);
      residuals.resize(1);
    }
    const solver::LeastResidual least = solver::combine_to_least_residual(residuals);
    start = combine(map.mechanism(), trials.ends, least.weights);
    const double distance = largest(map.way(trials.ends.front(), start).head(map.coordinates()));
    const bool repeats = misfit <= options.tolerance && distance <= options.tolerance && options.repeats();
    if (repeats && (trials.ends.size() >= kFewestTrials || !options.predicts)) {
      found.motion = std::move(start);
      found.near = std::move(trials.ends);
      found.set_solved(true);
      return found;
    }
  }
  found.motion = map.motion();
  found.fail(fmt::format("no motion has been found that repeats within {} periods", found.periods));
  return found;
}

}  // namespace hersey::run
