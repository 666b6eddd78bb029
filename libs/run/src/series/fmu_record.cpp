#include "series/fmu_record.h"

#include <algorithm>
#include <set>

namespace hersey::run {
namespace {

/// Names of variables are free text: a slash would open a group, dots are steps of a path, and `time` is the scale of
/// the rows. Each name once.
std::string name_in_file(std::string name, std::set<std::string>& taken) {
  std::replace(name.begin(), name.end(), '/', '|');
  while (name.empty() || name.find_first_not_of('.') == std::string::npos || !taken.insert(name).second) name += '_';
  return name;
}

constexpr const char* kUnits = "1|rad|1/s|Hz|rad/s|rad/s^2|m|m/s|m/s^2|N|N.m|Pa|W|K|m^3/s";

template <class Signal>
Quantity<double, Signal> line_of(const char* name, const char* text) {
  return {name,
          kUnits,
          text,
          [](const double& value, std::size_t /*k*/) { return value; },
          {.note = "in the SI unit of the variable, 1 where the FMU gives none",
           .unit = [](const Signal& signal) { return signal.unit; },
           .each = [](const Signal& signal) { return std::vector{signal.name}; }}};
}

}  // namespace

const FmuRecord::Table& FmuRecord::of_inputs() {
  static const Table table{line_of<Signal>("<input>", "given to input <input> at the last exchange before this row")};
  return table;
}

const FmuRecord::Table& FmuRecord::of_outputs() {
  static const Table table{
      line_of<Signal>("<output>", "returned by output <output> at the last exchange before this row")};
  return table;
}

FmuRecord::FmuRecord(const model::Fmu& fmu, results::Writer& writer) {
  const std::string group = "/fmus/" + fmu.name + "/";
  std::set<std::string> taken{"time"};
  const auto plan = [&](const fmi::Variable& variable, const std::string& unit) {
    return Signal{name_in_file(variable.name, taken), unit.empty() ? "1" : unit};
  };
  for (const model::FmuInput& input : fmu.inputs)
    inputs_.emplace_back(of_inputs(), group, plan(input.variable, input.unit), writer);
  for (const model::FmuOutputVariable& output : fmu.outputs)
    outputs_.emplace_back(of_outputs(), group, plan(output.variable, output.unit), writer);
}

void FmuRecord::append(const FmuSignals& signals) const {
  for (std::size_t i = 0; i < inputs_.size(); ++i) inputs_[i].append(signals.inputs[i]);
  for (std::size_t i = 0; i < outputs_.size(); ++i) outputs_[i].append(signals.outputs[i]);
}

QuantityGroup FmuRecord::describe() {
  QuantityGroup group{.path = "/fmus/<u>/", .heading = "of an FMU that runs beside the machine", .quantities = {}};
  run::describe(of_inputs(), "n", group);
  run::describe(of_outputs(), "n", group);
  return group;
}

}  // namespace hersey::run
