#include "time_stepping/instants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "hersey/core/input_error.h"
#include "hersey/core/settable_function.h"
#include "hersey/core/table_function.h"

namespace hersey::run {
namespace {

constexpr double kMostPeriods = 1e6;

/// Argument of a table during the run: value + rate (t - start).
struct UniformMotion {
  double value = 0, rate = 0;
};

/// The motion of a coordinate that a drive moves at constant speed.
std::optional<UniformMotion> driven_motion(const mbd::MechanismSpec& spec, const mbd::Observation& start,
                                           const mbd::CoordinateRef& coordinate) {
  for (const mbd::DriveSpec& drive : spec.drives) {
    const bool is_it = drive.coordinate.joint == coordinate.joint && drive.coordinate.value == coordinate.value;
    const auto* speed = dynamic_cast<const ConstantFunction*>(now(drive.function.get()));
    if (!is_it || drive.kind != mbd::DriveSpec::Kind::speed || speed == nullptr) continue;
    const auto joint = static_cast<std::size_t>(coordinate.joint.index);
    return UniformMotion{start.joints[joint].position[static_cast<std::size_t>(coordinate.value)], speed->value({})};
  }
  return std::nullopt;
}

class KinkCollector {
 public:
  explicit KinkCollector(const model::Model& model) : model_(model), run_(model.simulation) {}

  void add(const ScalarFunction* function, const UniformMotion& argument) {
    const auto* table = dynamic_cast<const TableFunction*>(now(function));
    if (table == nullptr || argument.rate == 0) return;
    const double end = argument.value + argument.rate * run_.duration;
    if (bends_again_and_again(*table)) require_few(std::abs(end - argument.value) / (table->upper() - table->lower()));
    for (const double x : table->kinks(std::min(argument.value, end), std::max(argument.value, end))) {
      times_.push_back(run_.start + (x - argument.value) / argument.rate);
    }
  }

  std::vector<double> times() {
    std::sort(times_.begin(), times_.end());
    return std::move(times_);
  }

 private:
  static bool bends_again_and_again(const TableFunction& table) {
    return table.is_periodic() && !table.kinks(table.lower(), 2 * table.upper() - table.lower()).empty();
  }

  /// The reader has counted the bends of tables over time and over the crank, which it can name; other coordinates move
  /// as the machine has it.
  void require_few(double periods) const {
    if (periods <= kMostPeriods) return;
    throw InputError(
        Fault{{model_.file, 0, 0},
              "",
              fmt::format("a table over a driven coordinate that repeats {:.3g} times during the run", periods),
              "at most a million times: steps hit every bend of it",
              "a longer period, interpolation: smooth, or a fixed step"});
  }

  const model::Model& model_;
  const model::Simulation& run_;
  std::vector<double> times_;
};

void add_multiples(double interval, const model::Simulation& run, std::vector<double>& times) {
  if (!(interval > 0)) return;
  for (double k = 1; k * interval < run.duration; ++k) times.push_back(run.start + k * interval);
}

}  // namespace

std::vector<double> jumps(const model::Model& model) {
  const model::Simulation& run = model.simulation;
  std::vector<double> times;
  for (const model::Force& force : model.forces)
    if (const auto* unbalance = force.as<model::Unbalance>(); unbalance != nullptr && unbalance->begins)
      if (*unbalance->begins > run.start && *unbalance->begins < run.start + run.duration)
        times.push_back(*unbalance->begins);
  std::sort(times.begin(), times.end());
  return times;
}

std::vector<double> kinks(const model::Model& model, const mbd::MechanismSpec& spec, const mbd::Observation& start) {
  const model::Simulation& run = model.simulation;
  const UniformMotion time{run.start, 1};
  KinkCollector collector(model);
  for (const mbd::DriveSpec& drive : spec.drives) collector.add(drive.function.get(), time);
  for (const mbd::LoadSpec& load : spec.loads) {
    for (const mbd::LoadTerm& term : load.terms) {
      if (term.variables.empty()) continue;
      const mbd::Variable& variable = term.variables.front();
      if (variable.kind == mbd::Variable::Kind::time) collector.add(term.magnitude.get(), time);
      if (variable.kind != mbd::Variable::Kind::position) continue;
      const std::optional<UniformMotion> motion = driven_motion(spec, start, variable.coordinate);
      if (motion) collector.add(term.magnitude.get(), *motion);
    }
  }
  const auto add_pressure = [&](const model::Function& pressure) {
    if (pressure.variables.empty()) return;
    const bool is_time = pressure.variables.front().kind == model::Variable::Kind::time;
    if (is_time) collector.add(pressure.value.get(), time);
    if (!is_time && run.crank) collector.add(pressure.value.get(), {run.crank->initial_angle, run.crank->speed});
  };
  for (const model::Bearing& bearing : model.bearings)
    for (const model::Function& pressure : bearing.feature_pressures) add_pressure(pressure);
  for (const model::Force& force : model.forces)
    if (const auto* ring = force.as<model::PistonRing>(); ring != nullptr && ring->gas) add_pressure(*ring->gas);
  std::vector<double> times = collector.times(), all;
  const std::vector<double> beginnings = jumps(model);
  std::merge(times.begin(), times.end(), beginnings.begin(), beginnings.end(), std::back_inserter(all));
  return all;
}

std::vector<double> instants_to_hit(const model::Model& model, const std::vector<double>& kinks) {
  const model::Simulation& run = model.simulation;
  std::vector<double> times = kinks;
  add_multiples(model.output.interval, run, times);
  if (run.cycle) add_multiples(run.cycle->period, run, times);
  if (!model.bearings.empty()) add_multiples(model.output.fields_every, run, times);
  for (const double t : model.output.meshes_at)
    if (t > 0 && t < run.duration) times.push_back(run.start + t);
  times.push_back(run.start + run.duration);
  std::sort(times.begin(), times.end());
  // Two instants closer than round-off are one; of these the later, so that the end stays the end.
  const double close = 1e-12 * std::max(std::abs(times.front()), std::abs(times.back()));
  std::vector<double> distinct;
  for (const double t : times) {
    if (!distinct.empty() && t - distinct.back() <= close) distinct.pop_back();
    distinct.push_back(t);
  }
  return distinct;
}

}  // namespace hersey::run
