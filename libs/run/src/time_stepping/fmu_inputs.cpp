#include "time_stepping/fmu_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/core/units.h"
#include "table/output_name.h"

namespace hersey::run {
namespace {

/// Names of the numbers of a row: "a.b", or "a.b.x" and "a.b[1]" where it has several, counted from 1.
std::vector<std::string> names_of(const results::LatestRow& row) {
  const std::string name = output_name(row.path);
  if (row.shape.empty()) return {name};
  if (row.shape.size() > 1) return {};
  std::vector<std::string> names;
  for (std::size_t k = 0; k < row.shape.front(); ++k) {
    const bool is_numbered = row.components.size() <= k || row.components[k] == std::to_string(k);
    names.push_back(is_numbered ? fmt::format("{}[{}]", name, k + 1) : name + "." + row.components[k]);
  }
  return names;
}

/// Factor and offset of a row's unit; units of no dimension that the program knows are SI as they stand.
std::pair<double, double> to_si(const std::string& unit) {
  const std::optional<std::string> si = si_unit_of(unit);
  if (!si || *si == unit) return {1, 0};
  const double offset = convert_to_si({0, unit}, *si);
  return {convert_to_si({1, unit}, *si) - offset, offset};
}

}  // namespace

FmuInputs::FmuInputs(const model::Model& model, const model::Machine& machine, const solver::State& start)
    : model_(model), machine_(machine), snapshot_(model, machine, start, Options{}) {
  std::vector<Fault> faults;
  for (const model::Fmu& fmu : model.fmus) {
    std::vector<Column>& columns = columns_.emplace_back();
    for (const model::FmuInput& input : fmu.inputs) {
      columns.emplace_back();
      if (input.function) continue;
      reads_rows_ = true;
      try {
        columns.back() = find(input);
      } catch (const InputError& error) {
        faults.push_back(error.faults().front());
      }
    }
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

FmuInputs::Column FmuInputs::find(const model::FmuInput& input) const {
  std::vector<std::string> all;
  const std::vector<results::LatestRow>& rows = snapshot_.latest();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!is_row_of_steps(rows[i].path)) continue;
    const std::vector<std::string> names = names_of(rows[i]);
    const auto found = std::find(names.begin(), names.end(), input.quantity);
    if (found == names.end()) {
      all.insert(all.end(), names.begin(), names.end());
      continue;
    }
    if (!input.unit.empty() && rows[i].unit != input.unit &&
        !measure_the_same_but_for_radians(rows[i].unit, input.unit))
      throw InputError(Fault{input.position, input.path, fmt::format("'{}', in {}", input.quantity, rows[i].unit),
                             fmt::format("a quantity in {}, as the FMU's input {} is", input.unit, input.variable.name),
                             ""});
    const auto [factor, offset] = to_si(rows[i].unit);
    return {i, static_cast<std::size_t>(found - names.begin()), factor, offset};
  }
  throw InputError(Fault{input.position, input.path, "no quantity '" + input.quantity + "' in the results",
                         "a number of the results at each step by its path with dots: joints.<j>.rotation, "
                         "bodies.<b>.position.x, bearings.<b>.h_min",
                         did_you_mean(input.quantity, all)});
}

double FmuInputs::value_of(const model::Function& function, const mbd::Observation& seen) const {
  std::vector<double> x;
  const std::vector<mbd::JointSpec>& joints = machine_.mechanism->spec().joints;
  for (const model::Variable& variable : function.variables) {
    if (variable.kind == model::Variable::Kind::time) {
      x.push_back(seen.t);
      continue;
    }
    const auto joint = std::find_if(joints.begin(), joints.end(),
                                    [&](const mbd::JointSpec& one) { return one.name == variable.joint; });
    HERSEY_REQUIRE(joint != joints.end(), "the reader checks joints");
    const mbd::JointObservation& own = seen.joints[static_cast<std::size_t>(joint - joints.begin())];
    const auto coordinate = mbd::find_coordinate(joint->type, variable.coordinate);
    HERSEY_REQUIRE(coordinate && coordinate->size == 1, "the reader checks coordinates");
    const auto& values = variable.kind == model::Variable::Kind::rate ? own.rate : own.position;
    x.push_back(values[static_cast<std::size_t>(coordinate->offset)]);
  }
  return function.value->value(x);
}

std::vector<std::vector<double>> FmuInputs::at(const StepRecord& step, const EnergySummary& energy) {
  if (reads_rows_) snapshot_.write_row(step, energy);
  std::vector<std::vector<double>> values;
  for (std::size_t f = 0; f < model_.fmus.size(); ++f) {
    std::vector<double>& own = values.emplace_back();
    for (std::size_t i = 0; i < columns_[f].size(); ++i) {
      const std::optional<model::Function>& function = model_.fmus[f].inputs[i].function;
      const Column& column = columns_[f][i];
      own.push_back(function ? value_of(*function, step.mechanism)
                             : column.factor * snapshot_.latest()[column.row].values[column.column] + column.offset);
    }
  }
  return values;
}

}  // namespace hersey::run
