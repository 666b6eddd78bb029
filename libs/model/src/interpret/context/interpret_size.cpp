#include "interpret/context/interpret_size.h"

#include <fmt/format.h>

#include <cmath>

#include "hersey/core/memory.h"
#include "hersey/core/table_function.h"

namespace hersey::model {
namespace {

// The least that a film takes: fields, Jacobian and factors of a bearing by itself are 2900 to 3100 bytes for each node
// of grids of 250 x 250 and 500 x 250 (peak of the process), with a third off for solvers that keep less.
constexpr double kBytesPerNode = 2000;

// Steps have to hit every one: of a run with so many nothing would come.
constexpr double kMostInstants = 1e6;

const Value* at_path(const Value& root, const std::string& section, const std::string& name) {
  const Value* const all = root.find(section);
  return all == nullptr ? nullptr : all->find(name);
}

void check_grid(Context& context, const Bearing& bearing) {
  const Value* const value = at_path(context.root, "bearings", bearing.name);
  const Value* const grid = value == nullptr ? nullptr : value->find("grid");
  if (grid == nullptr || grid->broken) return;
  const double nodes = 1.0 * bearing.film.grid.n_phi * bearing.film.grid.n_z;
  const double needed = kBytesPerNode * nodes, usable = usable_memory();
  if (needed <= usable) return;
  context.fault_at_key(*grid, fmt::format("{:.4g} nodes, which need at least {:.3g} GB of memory", nodes, needed / 1e9),
                       fmt::format("at most the {:.3g} GB of this machine, {:.2g} nodes", usable / 1e9,
                                   std::floor(usable / kBytesPerNode)));
}

/// How often a table over time, or over the crank's rotation, bends during the run.
double bends_of(const Function& function, const Simulation& run) {
  const auto* const table = dynamic_cast<const TableFunction*>(function.value.get());
  if (table == nullptr || !table->is_periodic() || function.variables.empty()) return 0;
  const Variable& variable = function.variables.front();
  const bool is_of_crank =
      run.crank && variable.kind == Variable::Kind::coordinate && variable.joint == run.crank->joint;
  if (variable.kind != Variable::Kind::time && !is_of_crank) return 0;
  const double period = table->upper() - table->lower();
  const double distance = run.duration * (is_of_crank ? std::abs(run.crank->speed) : 1);
  // Twice around, less once: the period's own ends bend too.
  const auto in_three = static_cast<double>(table->kinks(table->lower(), table->upper() + 2 * period).size());
  const auto in_two = static_cast<double>(table->kinks(table->lower(), table->upper() + period).size());
  return (in_three - in_two) * distance / period;
}

void check_bends(Context& context, const Function& function) {
  const double bends = bends_of(function, context.model.simulation);
  if (bends <= kMostInstants) return;
  context.faults.push_back({function.position, function.path,
                            fmt::format("a table that bends {:.3g} times during the run", bends),
                            "at most a million bends, which error-controlled steps all hit",
                            "a longer period, interpolation: smooth, or a fixed step"});
}

void check_interval(Context& context, const char* key, double interval) {
  const Value* const output = context.root.find("output");
  const Value* const value = output == nullptr ? nullptr : output->find(key);
  const double count = interval > 0 ? context.model.simulation.duration / interval : 0;
  if (value == nullptr || value->broken || count <= kMostInstants) return;
  context.fault(*value, fmt::format("{:.3g} instants during the run", count),
                "at most a million, which error-controlled steps all hit", "a longer interval");
}

}  // namespace

void check_size(Context& context) {
  const Model& model = context.model;
  for (const Bearing& bearing : model.bearings) check_grid(context, bearing);
  const Simulation& run = model.simulation;
  if (!run.error_control || run.duration <= 0) return;
  for (const Drive& drive : model.drives) check_bends(context, drive.motion);
  for (const Force& force : model.forces)
    for (const auto& followed : functions_of(force)) check_bends(context, *followed.function);
  for (const Bearing& bearing : model.bearings)
    for (const Function& pressure : bearing.feature_pressures) check_bends(context, pressure);
  check_interval(context, "interval", model.output.interval);
  check_interval(context, "fields_every", model.output.fields_every);
}

}  // namespace hersey::model
