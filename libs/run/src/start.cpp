#include "start.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/solver/initialise.h"

namespace hersey::run {
namespace {

using Range = std::pair<double, double>;

// The values the first variable of a function runs through, where they are known before the run.
std::optional<Range> range_of(const model::Model& model, const model::Variable& variable) {
  const model::Simulation& run = model.simulation;
  const double end = run.start + run.duration;
  if (variable.kind == model::Variable::Kind::time) return Range{run.start, end};
  if (variable.kind == model::Variable::Kind::coordinate && run.crank && variable.joint == run.crank->joint) {
    const double first = run.crank->initial_angle, last = first + run.crank->speed * run.duration;
    return Range{std::min(first, last), std::max(first, last)};
  }
  return std::nullopt;
}

void check_covers_run(const model::Model& model, const model::Function& function, std::vector<Fault>& faults) {
  if (!function.domain || function.variables.empty()) return;
  const std::optional<Range> needed = range_of(model, function.variables.front());
  if (!needed) return;
  // A run whose last step ends a rounding error beyond the table is covered.
  const double slack = 1e-9 * std::max(std::abs(needed->first), std::abs(needed->second));
  const auto [first, last] = *function.domain;
  if (first <= needed->first + slack && needed->second <= last + slack) return;
  faults.push_back({function.position, function.path,
                    fmt::format("the table covers {:.6g} to {:.6g} (SI units), the run needs {:.6g} to {:.6g}", first,
                                last, needed->first, needed->second),
                    "a table that covers the whole run", "extend the table, shorten the run, or give `period:`"});
}

void check_tables(const model::Model& model) {
  std::vector<Fault> faults;
  for (const model::Drive& drive : model.drives) check_covers_run(model, drive.motion, faults);
  for (const model::Force& force : model.forces) {
    for (const model::Function& function : force.load.functions) check_covers_run(model, function, faults);
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

// "joint main, rotation" -> joints.main; "bearing big_end: ..." -> bearings.big_end.
std::string path_of(const std::string& row) {
  const std::size_t space = row.find(' ');
  if (space == std::string::npos) return {};
  const std::string kind = row.substr(0, space);
  const std::string name = row.substr(space + 1, row.find_first_of(",:", space) - space - 1);
  for (const char* section : {"joint", "drive", "bearing", "body"}) {
    if (kind == section) return (kind == "body" ? "bodies" : kind + "s") + "." + name;
  }
  return {};
}

Fault fault_at(const model::Model& model, const std::string& row, std::string found, std::string expected,
               std::string suggestion) {
  const std::string path = path_of(row);
  SourcePosition position = path.empty() ? SourcePosition{model.file, 0, 0} : model.position_of(path);
  return {std::move(position), path, std::move(found), std::move(expected), std::move(suggestion)};
}

std::vector<Fault> faults_of(const model::Model& model, const solver::InitialiseSummary& summary) {
  using Status = solver::InitialiseStatus;
  std::vector<Fault> faults;
  for (const std::string& row : summary.redundant) {
    faults.push_back(fault_at(
        model, row, "singular mechanism: " + row + " constrains a motion that other joints or drives already constrain",
        "constraints that are independent",
        "replace this joint by one that leaves more free (a revolute in a plane loop by a spherical or cylindrical "
        "joint)"));
  }
  for (const std::string& row : summary.undetermined) {
    faults.push_back(fault_at(model, row, "singular mechanism: nothing determines the motion of " + row,
                              "mass, inertia, a joint or a drive for every coordinate",
                              "give the bodies behind it mass and inertia, or hold it with a drive"));
  }
  if (!faults.empty()) return faults;
  if (summary.status == Status::domain_error) {
    return {fault_at(model, summary.message, summary.message, "a journal inside its shell at the start",
                     "move the bodies' frames or the joints' `initial` values, or enlarge `radial_clearance`")};
  }
  return {fault_at(model, summary.message, summary.message, "initial values from which the loops can be closed",
                   "check frames and `initial` values of the joints")};
}

}  // namespace

solver::State starting_state(const model::Model& model, model::Machine& machine) {
  check_tables(model);
  solver::State state = machine.mechanism->initial_state();
  state.t = model.simulation.start;
  solver::InitialiseOptions options;
  options.held = machine.mechanism->given_coordinates();
  const solver::InitialiseSummary summary = solver::initialise(*machine.mechanism, state, options);
  if (!summary.consistent()) throw InputError(faults_of(model, summary));
  return state;
}

}  // namespace hersey::run
