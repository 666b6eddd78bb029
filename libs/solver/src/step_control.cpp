#include "hersey/solver/step_control.h"

#include <algorithm>
#include <cmath>

#include "hersey/core/contract.h"

namespace hersey::solver {
namespace {

constexpr double kAim = 0.5;  // share of the tolerance aimed at
constexpr double kLargestCut = 0.2;
constexpr double kLargestTrend = 2;       // by which a step's error factor may be thought to change to the next
constexpr double kFinestCut = 64;         // an instant this many parts of a step away from its end is reached in parts
constexpr double kRoundOffOfTime = 1e-9;  // relative round-off of times
constexpr double kSmallestError = 1e-6;   // a step without error says nothing about the next

/// Returns a change that continues the previous one: zero if their signs are opposite, as those of noise are.
double lasting(double before, double now) {
  if (before * now <= 0) return 0;
  return std::min(std::abs(now), kLargestTrend * std::abs(before));
}

}  // namespace

StepControl::StepControl(const StepControlOptions& options, double first)
    : options_(options), dt_(std::clamp(first, options.smallest, options.largest)) {
  HERSEY_REQUIRE(0 < options.smallest && options.smallest <= options.largest, "limits of the step in their order");
}

/// The largest unit/2^k that is not above `most`.
double StepControl::part_of_unit(double most) const {
  return options_.unit * std::exp2(std::floor(std::log2(most / options_.unit * (1 + kRoundOffOfTime))));
}

double StepControl::proposed(double remaining) const {
  if (options_.unit > 0) {
    const double part = part_of_unit(std::min(dt_, remaining));
    const double parts = remaining / part * kFinestCut;
    if (part >= options_.smallest && std::abs(parts - std::round(parts)) < kRoundOffOfTime * parts) return part;
  }
  return remaining / std::max(1.0, std::ceil(remaining / dt_ * (1 - kRoundOffOfTime)));
}

/// Theory manual eq. (integrator.14): the step with which the next error would be the one aimed at.
double StepControl::wanted(double dt, const Eigen::VectorXd& errors) {
  const Eigen::VectorXd factors = errors / std::pow(dt, options_.order);
  double factor = kSmallestError / std::pow(dt, options_.order);
  if (factors.size() > 0) factor = std::max(factor, factors.lpNorm<Eigen::Infinity>());
  Eigen::VectorXd change;
  if (factors_.size() == factors.size()) change = factors - factors_;
  for (Eigen::Index i = 0; i < std::min(change.size(), change_.size()); ++i)
    factor = std::max(factor, std::hypot(factors[i], options_.reach * lasting(change_[i], change[i])));
  const double trend = factor_ > 0 ? std::clamp(factor / factor_, 1 / kLargestTrend, kLargestTrend) : 1;
  factors_ = factors;
  change_ = change;
  factor_ = factor;
  return std::pow(kAim / (factor * trend), 1 / options_.order);
}

/// To double a step only where the doubled one would still meet the aim.
void StepControl::accept_part(double dt, double wanted) {
  const bool was_cut = dt < part_of_unit(dt_) * (1 - kRoundOffOfTime);
  if (wanted < dt)
    dt_ = std::max(wanted, kLargestCut * dt);
  else if (!was_cut)
    dt_ = wanted >= 2 * dt && !after_rejection_ ? 2 * dt : dt;
}

void StepControl::accepted(double dt, const Eigen::VectorXd& errors) {
  const double next = wanted(dt, errors);
  if (options_.unit > 0)
    accept_part(dt, next);
  else  // a step cut to hit an instant does not shorten those that follow
    dt_ = std::clamp(next, kLargestCut * dt_, (after_rejection_ ? 1 : options_.largest_growth) * dt_);
  dt_ = std::clamp(dt_, options_.smallest, options_.largest);
  after_rejection_ = false;
}

bool StepControl::rejected(double dt, double error) {
  return shorten(dt, std::clamp(std::pow(kAim / error, 1 / options_.order), kLargestCut, 0.9));
}

bool StepControl::failed(double dt) { return shorten(dt, 0.5); }

bool StepControl::shorten(double dt, double factor) {
  after_rejection_ = true;
  factors_.resize(0);
  change_.resize(0);
  factor_ = 0;
  if (dt <= options_.smallest * (1 + 2 * kRoundOffOfTime)) return false;  // as `proposed` rounds it
  dt_ = std::max(factor * dt, options_.smallest);
  return true;
}

void StepControl::persist(Archive& archive) {
  archive.io("dt", dt_);
  archive.io("factors", factors_);
  archive.io("change", change_);
  archive.io("factor", factor_);
  archive.io("after_rejection", after_rejection_);
}

}  // namespace hersey::solver
