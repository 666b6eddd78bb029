#include "hersey/solver/step_control.h"

#include <algorithm>
#include <cmath>

#include "hersey/core/contract.h"

namespace hersey::solver {
namespace {

constexpr double kAim = 0.5;             // share of the tolerance aimed at
constexpr double kLargestGrowth = 1.3;   // per step
constexpr double kSmallestGrowth = 1.1;  // below it the step stays
constexpr double kLargestCut = 0.2;
constexpr double kOrder = 3;             // of the local error
constexpr double kFinestCut = 64;        // an instant this many parts of a step away from its end is reached in parts
constexpr double kRoundOff = 1e-9;       // of times
constexpr double kSmallestError = 1e-6;  // a step without error says nothing about the next

}  // namespace

StepControl::StepControl(const StepControlOptions& options, double first)
    : options_(options), dt_(std::clamp(first, options.smallest, options.largest)) {
  HERSEY_REQUIRE(0 < options.smallest && options.smallest <= options.largest, "limits of the step in their order");
}

/// The largest unit/2^k that is not above `most`.
double StepControl::part_of_unit(double most) const {
  return options_.unit * std::exp2(std::floor(std::log2(most / options_.unit * (1 + kRoundOff))));
}

double StepControl::proposed(double remaining) const {
  if (options_.unit > 0) {
    const double part = part_of_unit(std::min(dt_, remaining));
    const double parts = remaining / part * kFinestCut;
    if (part >= options_.smallest && std::abs(parts - std::round(parts)) < kRoundOff * parts) return part;
  }
  if (remaining <= dt_ * (1 + 1e-9)) return remaining;
  return remaining < 2 * dt_ ? 0.5 * remaining : dt_;
}

/// To double a step only where the doubled one would still meet the aim.
void StepControl::accept_part(double dt, double error) {
  const double factor = std::pow(kAim / error, 1 / kOrder);
  const bool was_cut = dt < part_of_unit(dt_) * (1 - kRoundOff);
  if (factor < 1)
    dt_ = std::max(factor, kLargestCut) * dt;
  else if (!was_cut)
    dt_ = factor >= 2 && !after_rejection_ ? 2 * dt : dt;
  dt_ = std::clamp(dt_, options_.smallest, options_.largest);
  after_rejection_ = false;
}

void StepControl::accepted(double dt, double error) {
  const double e = std::max(error, kSmallestError);
  const double wanted = std::pow(kAim / e, 0.7 / kOrder) * std::pow(last_error_ / kAim, 0.4 / kOrder);
  if (options_.unit > 0) return accept_part(dt, e);
  double growth = std::min(wanted, after_rejection_ ? 1.0 : kLargestGrowth);
  if (growth > 1 && growth < kSmallestGrowth) growth = 1;
  // A step cut to hit an instant does not shorten those that follow.
  dt_ = growth * dt < dt_ && dt < dt_ && growth >= 1 ? dt_ : std::max(growth, kLargestCut) * dt;
  dt_ = std::clamp(dt_, options_.smallest, options_.largest);
  last_error_ = e;
  after_rejection_ = false;
}

bool StepControl::rejected(double dt, double error) {
  return shorten(dt, std::clamp(std::pow(kAim / error, 1 / kOrder), kLargestCut, 0.9));
}

bool StepControl::failed(double dt) { return shorten(dt, 0.5); }

bool StepControl::shorten(double dt, double factor) {
  after_rejection_ = true;
  last_error_ = kAim;
  if (dt <= options_.smallest) return false;
  dt_ = std::max(factor * dt, options_.smallest);
  return true;
}

void StepControl::persist(Archive& archive) {
  archive.io("dt", dt_);
  archive.io("last_error", last_error_);
  archive.io("after_rejection", after_rejection_);
}

}  // namespace hersey::solver
