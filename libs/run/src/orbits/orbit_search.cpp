#include "orbits/orbit_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>

#include "hersey/core/error_text.h"
#include "hersey/solver/least_residual.h"
#include "time_stepping/floquet.h"
#include "time_stepping/shooting.h"

namespace hersey::run {
namespace {

constexpr int kMostOfFirst = 60;    // periods
constexpr int kMostOfGrowth = 600;  // from so small an oscillation that shooting finds none
constexpr int kMostOfNext = 16;
constexpr const char* kAtRest = "the search leads to rest";
constexpr int kStarts = 2;           // deviations with which the search for multipliers begins
constexpr double kDeviation = 1e-3;  // of a swing
constexpr double kBeyond = 0.02;     // of the range, by which trials may leave it
constexpr double kSmall = 1e-2;      // misfit from which a search may well wander
constexpr double kLost = 10;         // growth of the residual in one search

// Those of all films, or else of all joints.
std::vector<ObservedQuantity> usual_quantities(const std::vector<ObservedQuantity>& all) {
  std::vector<ObservedQuantity> of_films, of_joints;
  for (const ObservedQuantity& quantity : all) {
    const auto is_of_film = [&](const char* part) {
      return quantity.name.starts_with("bearings.") && quantity.name.find(part) != std::string::npos;
    };
    if (is_of_film(".eccentricity.") || (quantity.name.starts_with("bearings.") &&
                                         (quantity.name.ends_with(".h_min") || quantity.name.ends_with(".p_max"))))
      of_films.push_back(quantity);
    if (quantity.name.starts_with("joints.") && quantity.name.find(".coordinates") != std::string::npos)
      of_joints.push_back(quantity);
  }
  return of_films.empty() ? of_joints : of_films;
}

std::vector<ObservedQuantity> named_quantities(const std::vector<std::string>& names) {
  std::vector<ObservedQuantity> quantities;
  for (const std::string& name : names) quantities.push_back({name, ""});
  return quantities;
}

// Largest share of a swing between two motions at different values, of which the speed of angles that go round is one.
double distance_between(const PeriodMap& map, const Motion& from, const Motion& to) {
  const Eigen::VectorXd sizes = map.swing().sizes();
  const Eigen::Index nv = sizes.size() / 2;
  double largest = 0;
  const Eigen::VectorXd way = map.way(from, to);
  for (Eigen::Index i = 0; i < nv; ++i)
    if (!std::isinf(sizes[i])) largest = std::max({largest, std::abs(way[i]), std::abs(way[nv + i])});
  return largest;
}

// Weights of trials that predict a residual of zero from the newest one on: by changes between those of this search,
// `own` of them, and by those between the trials of orbits before. A change from these to those would lead back along
// the branch, where residuals vanish, too.
Eigen::VectorXd weights_of(const std::vector<Eigen::VectorXd>& residuals, std::size_t own) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t k = 0; k + 1 < own; ++k) pairs.emplace_back(k, k + 1);
  for (std::size_t k = own + 1; k < residuals.size(); ++k) pairs.emplace_back(own, k);
  std::vector<Eigen::VectorXd> changes;
  for (const auto& [a, b] : pairs) changes.emplace_back(residuals[a] - residuals[b]);
  const Eigen::VectorXd shares = solver::shares_of_changes(residuals.front(), changes);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(residuals.size()));
  weights[0] = 1;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    weights[static_cast<Eigen::Index>(pairs[k].first)] -= shares[static_cast<Eigen::Index>(k)];
    weights[static_cast<Eigen::Index>(pairs[k].second)] += shares[static_cast<Eigen::Index>(k)];
  }
  return weights;
}

// A motion beside `at` that deviates in every coordinate that moves, in none of their patterns: orbits that are the
// same from all sides, as that of a round rotor, have deviations of which periods never make others.
Motion beside(const PeriodMap& map, const Motion& at, int which) {
  constexpr double golden_angle = 2.399963229728653;
  const Eigen::VectorXd sizes = map.swing().sizes(), ways = map.swing().ways();
  Motion moved = at;
  Eigen::VectorXd way = Eigen::VectorXd::Zero(ways.size());
  std::vector<double>& v = moved.memory.numbers.at("v").values;
  for (Eigen::Index i = 0; i < ways.size(); ++i) {
    if (!(ways[i] > 0)) continue;
    const double angle = golden_angle * static_cast<double>(2 * i + 1) * which;
    way[i] = kDeviation * sizes[i] * std::cos(angle);
    const double speed = sizes[ways.size() + i];
    if (std::isfinite(speed)) v[static_cast<std::size_t>(i)] += kDeviation * speed * std::sin(angle);
  }
  map.mechanism().retract(at.q, way, moved.q);
  return moved;
}

// What to do where no orbit has been found from the model's start.
std::string advice(bool finds_period) {
  return std::string(
             "; begin nearer to it: let `hersey run` without `lead_in` run many periods, and give its last "
             "positions and speeds as `initial` of the joints; or begin the branch at another value") +
         (finds_period ? ", or give another `about`" : "");
}

double largest_share(const Eigen::VectorXd& way, Eigen::Index coordinates) {
  return coordinates > 0 ? way.head(coordinates).cwiseAbs().maxCoeff() : 0;
}

}  // namespace

OrbitSearch::OrbitSearch(const std::function<model::Model(double)>& model_at, const BranchOptions& options)
    : model_at_(model_at), options_(options), observed_(named_quantities(options.observed)) {}

OrbitMachine& OrbitSearch::machine_at(double value, double period) {
  if (machine_ && value == value_) return *machine_;
  model::Model model = model_at_(value);
  finds_period_ = model.simulation.cycle->is_period_found;
  const std::unique_ptr<OrbitMachine> before = std::move(machine_);
  machine_ = std::make_unique<OrbitMachine>(std::move(model), before ? before->steps() : 0, finds_period_ ? period : 0,
                                            options_.stop);
  value_ = value;
  if (before && finds_period_) machine_->map().lay_section_of(before->map());
  return *machine_;
}

FoundOrbit OrbitSearch::first(double value) {
  OrbitMachine& machine = machine_at(value, 0);
  const std::vector<ObservedQuantity> all = machine.quantities();
  if (observed_.empty()) observed_ = usual_quantities(all);
  machine.observe(observed_);
  for (ObservedQuantity& quantity : observed_) {
    const auto known = std::ranges::find(all, quantity.name, &ObservedQuantity::name);
    if (known != all.end()) quantity.unit = known->unit;
  }
  if (finds_period_)
    if (const Outcome section = machine.map().lay_section(kMostOfFirst); !section.solved())
      return no_answer<FoundOrbit>(section.message + advice(finds_period_));
  Shooting found = shoot_first(machine.map());
  if (!found.solved() && finds_period_ && !is_stopped()) {
    machine_.reset();
    PeriodMap& grown = machine_at(value, 0).map();
    if (grown.wait_while_it_grows(kMostOfGrowth).solved() && grown.lay_section(kMostOfFirst).solved())
      found = shoot_first(grown);
  }
  if (!found.solved()) return no_answer<FoundOrbit>(found.message + advice(finds_period_));
  return complete({found.motion, value, machine_->map().period()}, found.periods);
}

Shooting OrbitSearch::shoot_first(PeriodMap& map) const {
  Shooting found = shoot(map, {.tolerance = options_.tolerance, .most = kMostOfFirst, .repeats = [] { return true; }});
  // Where a small oscillation grows, rest is a motion that repeats, too.
  if (found.solved() && finds_period_ && map.swing().is_rest()) found.fail(kAtRest);
  return found;
}

MotionAtValue OrbitSearch::onto_section(MotionAtValue at) const {
  if (finds_period_) at.motion = machine_->map().onto_section(at.motion);
  return at;
}

// The constraint is one more residual of each trial.
FoundOrbit OrbitSearch::next(const AcrossBranch& plane, std::vector<PeriodTrial> near) {
  try {
    return search(plane, std::move(near));
  } catch (const std::exception& error) {
    return no_answer<FoundOrbit>(error_text(error));
  }
}

FoundOrbit OrbitSearch::search(const AcrossBranch& plane, std::vector<PeriodTrial> near) {
  std::vector<PeriodTrial> trials = std::move(near);
  for (PeriodTrial& trial : trials) {
    trial.start = onto_section({std::move(trial.start), 0, 0}).motion;
    trial.end = onto_section(std::move(trial.end));
  }
  MotionAtValue start = plane.predicted;
  double first = 0;
  const auto [low, high] = std::minmax(options_.from, options_.to);
  for (int periods = 1; periods <= kMostOfNext; ++periods) {
    if (start.value < low - kBeyond * (high - low) || start.value > high + kBeyond * (high - low))
      return no_answer<FoundOrbit>("the search for it leaves the range");
    PeriodMap& map = machine_at(start.value, start.period).map();
    if (finds_period_) map.expect_period(start.period);
    if (const Outcome period = map.take_from(start.motion); !period.solved())
      return no_answer<FoundOrbit>(period.message);
    trials.insert(trials.begin(), {start.motion, {map.motion(), start.value, map.period()}});
    std::vector<Eigen::VectorXd> residuals;
    std::vector<MotionAtValue> ends;
    for (const PeriodTrial& one : trials) {
      const Eigen::VectorXd way = way_between(map.mechanism(), one.start, one.end.motion);
      Eigen::VectorXd residual(way.size() + 1);
      residual << way, plane.direction.dot(plane.metric.way(map.mechanism(), plane.predicted, one.end));
      map.compare_by_swing(residual);
      residuals.push_back(std::move(residual));
      ends.push_back(one.end);
    }
    const double misfit = largest_share(residuals.front(), map.coordinates());
    if (periods == 1) first = misfit;
    if (misfit > kLost * std::max(first, kSmall)) return no_answer<FoundOrbit>("the search for it diverges");
    start = combine(map.mechanism(), ends, weights_of(residuals, static_cast<std::size_t>(periods)));
    if (plane.keeps_value) start.value = plane.predicted.value;
    const double distance = distance_between(map, ends.front().motion, start.motion);
    const double change = std::abs(start.value - ends.front().value) / std::abs(options_.to - options_.from);
    if (std::max({misfit, distance, change}) > options_.tolerance) continue;
    return complete(start, periods);
  }
  return no_answer<FoundOrbit>(fmt::format("none has been found within {} periods", kMostOfNext));
}

FoundOrbit OrbitSearch::complete(const MotionAtValue& at, int periods) {
  OrbitMachine& machine = machine_at(at.value, at.period);
  PeriodMap& map = machine.map();
  if (finds_period_) map.expect_period(at.period);
  FoundOrbit found;
  BranchPoint& point = found.point;
  machine.observe(observed_);
  if (const Outcome period = map.take_from(at.motion); !period.solved()) return no_answer<FoundOrbit>(period.message);
  point.orbit.excursions = machine.excursions();
  machine.observe({});
  if (finds_period_) map.lay_section_at_start();
  point.orbit.value = at.value;
  point.orbit.period = map.period();
  point.at = at;
  point.sizes = map.swing().sizes();
  point.ways = map.swing().ways();
  point.is_rest = map.swing().is_rest();
  found.set_solved(true);
  point.orbit.periods = periods + 1;
  if (point.is_rest) return found;
  Shooting shooting;
  shooting.motion = at.motion;
  // What a period makes of them has accelerations, oil and temperatures that belong to it.
  const Motion end = map.motion();
  for (int which = 1; which <= kStarts; ++which) {
    const Motion start = beside(map, at.motion, which);
    ++point.orbit.periods;
    if (!map.take_from(finds_period_ ? map.onto_section(start) : start).solved()) continue;
    shooting.near.push_back(combine(map.mechanism(), {at.motion, map.motion(), end}, Eigen::Vector3d(1, 1, -1)));
  }
  if (shooting.near.empty()) return no_answer<FoundOrbit>("no period beside it can be run");
  const FloquetMultipliers multipliers = floquet_multipliers(map, shooting, options_.multipliers, kStarts);
  point.orbit.multipliers = multipliers.values;
  point.orbit.periods += multipliers.periods;
  for (const FloquetMultipliers::Trial& trial : multipliers.trials)
    point.trials.push_back({trial.start, {trial.end, at.value, trial.period}});
  if (!multipliers.solved()) return no_answer<FoundOrbit>("no multipliers: " + multipliers.message);
  return found;
}

}  // namespace hersey::run
