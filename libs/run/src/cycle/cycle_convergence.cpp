#include "cycle/cycle_convergence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace hersey::run {
namespace {

constexpr double kSmallRise = 1;  // K, of walls over the supply

constexpr double kRoundOff = 1e-9;  // of times

/// Over the larger of both; 0 where both vanish.
double difference(double a, double b) {
  const double larger = std::max(std::abs(a), std::abs(b));
  return larger > 0 ? std::abs(a - b) / larger : 0;
}

}  // namespace

bool CycleConvergence::ends(double t) const {
  const auto& plan = model_.simulation.cycle;
  return plan && t - model_.simulation.start >= (ended_ + 1) * plan->period * (1 - kRoundOff);
}

CycleChange CycleConvergence::take(const std::vector<BearingCycle>& cycle) {
  std::vector<Figures> now;
  now.reserve(cycle.size());
  for (const BearingCycle& bearing : cycle) {
    const double energy = bearing.energy_film + bearing.energy_asperity;
    now.push_back({bearing.moft.value, bearing.pofp.value, energy / bearing.duration()});
  }
  CycleChange change{.number = ++ended_, .value = std::numeric_limits<double>::quiet_NaN()};
  // Shooting has compared the motion of a machine without bearings.
  if (cycle.empty() && ended_ > 1) {
    change.value = 0;
    change.largest = "the motion, compared by shooting";
  }
  using Figure = std::pair<const char*, double Figures::*>;
  constexpr std::array<Figure, 3> figures{
      {{"film thickness", &Figures::h_min}, {"peak pressure", &Figures::p_max}, {"friction", &Figures::power}}};
  for (std::size_t i = 0; i < last_.size(); ++i)
    for (const auto& [name, figure] : figures) {
      const double value = difference(now[i].*figure, last_[i].*figure);
      if (value <= change.value) continue;
      change.value = value;
      change.largest = std::string(name) + " of " + model_.bearings[i].name;
    }
  for (std::size_t i = 0; i < last_.size(); ++i) {
    const double value = cycle[i].walls.largest / (kSmallRise + std::abs(cycle[i].walls.rise));
    if (value <= change.value) continue;
    change.value = value;
    change.largest = "wall temperature of " + model_.bearings[i].name;
  }
  last_ = std::move(now);
  return change;
}

bool CycleConvergence::converged(const CycleChange& change) const {
  return change.value <= model_.simulation.cycle->tolerance;
}

void CycleConvergence::persist(Archive& archive) {
  archive.io("ended", ended_);
  archive.each("last", last_, [](Archive& a, Figures& figures) {
    a.io("h_min", figures.h_min), a.io("p_max", figures.p_max), a.io("power", figures.power);
  });
}

}  // namespace hersey::run
