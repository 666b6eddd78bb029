#include "time_stepping/energy_monitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>

#include "observation/observe_step.h"

namespace hersey::run {
namespace {

/// Share of the available energy that a run may gain without a source before it ends as failed. The energy of coarse
/// steps of sound motions swings by some percent within a period; an explosion exceeds any share.
constexpr double kMostOfRun = 0.2;

/// Share of the remaining allowance that one step may gain.
constexpr double kMostOfStep = 0.1;

/// Share of the available energy that steps may regain after a loss. On a swing that steps follow badly the energy
/// falls and rises again; a limit on gains without this allowance would remove energy.
constexpr double kTakenBack = 0.1;

/// Share of the energy that a step moves: Newton's method leaves force residuals up to its tolerance (1e-8 of their
/// terms).
constexpr double kUnsolved = 1e-6;

/// Share of the stored energy: round-off of differences of sums of many terms.
constexpr double kRoundOffOfStores = 1e-12;

/// Share of the energy put in by a step: if no more than that was available before the step, the motion begins with it.
/// The method's error for a force that rises from zero within one step is a share of that force's work, however short
/// the step.
constexpr double kFromNothing = 1e-6;

/// Share of the energy of preloads, weights and loads over the size of the machine: a motion with less energy counts as
/// standstill.
constexpr double kStandstill = 1e-9;

double sum_of(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

double sum_of_sizes(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0, [](double s, double x) { return s + std::abs(x); });
}

double of_motion(const mbd::EnergyView& view) {
  return sum_of(view.kinetic) + sum_of(view.elastic_kinetic) + sum_of(view.strain);
}

}  // namespace

double EnergyMonitor::Books::available() const {
  double sum = at_start + noise;
  for (const double most : most_in) sum += most;
  for (std::size_t i = 0; i < in_store.size(); ++i)
    sum += std::max(in_store[i], 0.0) + std::max(0.0, std::min(in_store[i], 0.0) - least_in[i]);
  return sum;
}

EnergyMonitor::EnergyMonitor(const model::Model&, model::Machine& machine) : machine_(machine) {
  knows_losses_ = machine.mechanism->spec().elastics.empty();
  for (const ForceKind kind : force_kinds(machine)) {
    is_film_.push_back(kind == ForceKind::bearing);
    if (kind != ForceKind::spring) knows_losses_ = false;
  }
}

// The first entry is the potential energy of gravity, relative to the start.
std::vector<double> EnergyMonitor::stores(const mbd::EnergyView& view) const {
  std::vector<double> stored{view.potential - potential_at_start_};
  stored.insert(stored.end(), view.springs.begin(), view.springs.end());
  stored.insert(stored.end(), view.functions.begin(), view.functions.end());
  for (const mbd::ForceView& force : view.forces) stored.push_back(force.stored);
  return stored;
}

double EnergyMonitor::smallest_monitored(const mbd::EnergyView& view) const {
  const mbd::MechanismSpec& spec = machine_.mechanism->spec();
  double weight = 0;
  for (const mbd::BodySpec& body : spec.bodies) weight += body.mass;
  for (const mbd::MechanismSpec::Elastic& elastic : spec.elastics) weight += elastic.body->mass();
  const Eigen::VectorXd scales = machine_.mechanism->position_scales();
  const double length = scales.size() > 0 ? scales.maxCoeff() : 0;
  double stored = spec.gravity.norm() * weight * length;
  for (const mbd::ForceView& force : view.forces) stored += std::abs(force.stored);
  return kStandstill * (stored + sum_of_sizes(view.springs) + sum_of(view.strain));
}

void EnergyMonitor::begin(const solver::State& state) {
  machine_.mechanism->view_energy(state, false, from_);
  has_refused_ = false;
  if (is_begun_) return;
  is_begun_ = true;
  potential_at_start_ = from_.potential;
  books_.at_start = of_motion(from_);
  books_.in_store = books_.least_in = stores(from_);
  books_.noise = smallest_monitored(from_);
}

void EnergyMonitor::begin_anew(const solver::State& state) {
  is_begun_ = false;
  books_ = {};
  balance_ = lost_ = 0;
  begin(state);
}

void EnergyMonitor::enter(const mbd::WorkBetween& work) {
  std::vector<double> sources;
  for (const auto* list : {&work.drives, &work.loads, &work.functions, &work.pressures})
    for (const mbd::StepWork& one : *list) sources.push_back(one.value);
  for (std::size_t i = 0; i < work.forces.size(); ++i)
    if (is_film_[i] != 0) sources.push_back(work.forces[i].value);
  trial_ = books_;
  trial_.put_in.resize(sources.size());
  trial_.most_in.resize(sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    trial_.put_in[i] += sources[i];
    trial_.most_in[i] = std::max(trial_.most_in[i], trial_.put_in[i]);
  }
  const std::vector<double> stored = stores(to_);
  for (std::size_t i = 0; i < stored.size(); ++i) trial_.least_in[i] = std::min(trial_.least_in[i], stored[i]);
}

bool EnergyMonitor::allows(const solver::State& end) {
  mbd::Mechanism& mechanism = *machine_.mechanism;
  mechanism.view_energy(end, true, to_);
  const mbd::WorkBetween work = mechanism.work_between(from_, to_);
  enter(work);
  const std::vector<double> before = stores(from_), after = stores(to_);
  double gain = of_motion(to_) - of_motion(from_), moved = std::abs(gain), stored = of_motion(from_) + of_motion(to_);
  for (std::size_t i = 0; i < before.size(); ++i) {
    gain += after[i] - before[i];
    moved += std::abs(after[i] - before[i]);
    stored += std::abs(before[i]) + std::abs(after[i]);
  }
  stored += std::abs(from_.potential);
  double uncertainty = 0;
  const auto put_in = [&](const mbd::StepWork& one) {
    gain -= one.value;
    uncertainty += one.uncertainty;
    moved += std::abs(one.value);
  };
  for (const auto* list : {&work.drives, &work.loads, &work.functions, &work.pressures})
    std::for_each(list->begin(), list->end(), put_in);
  for (std::size_t i = 0; i < work.forces.size(); ++i) {
    if (is_film_[i] != 0)
      put_in(work.forces[i]);
    else
      gain += work.lost[i];
  }
  gain += work.lost_in_springs;
  uncertainty += kUnsolved * moved + kRoundOffOfStores * stored;
  gain_ = gain - uncertainty;
  const bool begins = books_.available() <= kFromNothing * trial_.available();
  if (begins && gain_ <= trial_.available()) gain_ = std::min(gain_, 0.0);
  loss_ = knows_losses_ ? std::max(0.0, -gain - uncertainty) : 0;
  // The negated comparison also refuses an energy that is not a number.
  const double left = std::max(0.0, kMostOfRun * trial_.available() - std::max(0.0, balance_));
  has_refused_ = !(gain_ <= std::max(0.0, -balance_) + kMostOfStep * left);
  return !has_refused_;
}

void EnergyMonitor::follow(const solver::State& end) {
  (void)allows(end);
  gain_ = loss_ = 0;
  has_refused_ = false;
}

void EnergyMonitor::accept() {
  std::swap(from_, to_);
  std::swap(books_, trial_);
  balance_ = std::max(-kTakenBack * books_.available(), balance_ + gain_);
  lost_ += loss_;
}

bool EnergyMonitor::has_lost_much() const { return lost_ > kMostOfRun * books_.available(); }

std::string EnergyMonitor::reason_of_loss() const {
  const mbd::LargestEnergyChanges changes = machine_.mechanism->largest_energy_changes(to_, from_);
  std::string text = fmt::format("{:.3g} J of the {:.3g} J at the start and put in since were lost without a sink",
                                 lost_, books_.available());
  if (!changes.body.empty()) text += fmt::format(", of late in {}", changes.body);
  if (!changes.force.empty()) text += fmt::format(", where {} acts", changes.force);
  return text;
}

std::string EnergyMonitor::reason() const {
  const mbd::LargestEnergyChanges changes = machine_.mechanism->largest_energy_changes(from_, to_);
  const double available = books_.available();
  std::string text = fmt::format("{:.3g} J were gained without a source", gain_);
  if (balance_ > 0) text += fmt::format(", beside {:.3g} J in the steps before", balance_);
  text += fmt::format("; the energy at the start and what was put in since are {:.3g} J", available);
  if (!changes.body.empty()) text += fmt::format("; most of it is found in {}", changes.body);
  if (!changes.force.empty()) text += fmt::format(", where {} acts", changes.force);
  return text;
}

void EnergyMonitor::persist(Archive& archive) {
  archive.io("is_begun", is_begun_), archive.io("balance", balance_), archive.io("lost", lost_),
      archive.io("potential", potential_at_start_);
  archive.io("at_start", books_.at_start), archive.io("noise", books_.noise);
  archive.io("put_in", books_.put_in), archive.io("most_in", books_.most_in);
  archive.io("in_store", books_.in_store), archive.io("least_in", books_.least_in);
  const Archive::Group group(archive, "from");
  from_.persist(archive);
}

}  // namespace hersey::run
