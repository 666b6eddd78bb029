#include "interpret/context/fmu_variable.h"

#include <fmt/format.h>

#include "hersey/core/spelling.h"
#include "hersey/core/units.h"

namespace hersey::model {
namespace {

/// SI unit of a unit that an FMU defines, with the radian where it makes a unit that the program knows.
std::optional<std::string> si_unit_of_defined(const fmi::Unit& given) {
  if (const auto si = si_unit_of(given.base_units()))
    return *si == "Hz" && given.name.find("Hz") == std::string::npos ? "1/s" : *si;
  fmi::Unit unit = given;
  for (const int radians : {0, 1, -1}) {
    unit.powers.back() = radians;
    if (auto si = si_unit_of(unit.base_units())) return si;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ExchangedVariable> with_unit(Context& context, const Value& at, const fmi::Variable& variable) {
  if (!variable.unit) return ExchangedVariable{variable, ""};
  ExchangedVariable known{variable, ""};
  fmi::Unit& unit = *known.variable.unit;
  const std::optional<std::string> si = unit.is_defined ? si_unit_of_defined(unit) : si_unit_of(unit.name);
  if (!si) {
    context.fault(at,
                  fmt::format("variable '{}' in '{}', {}", variable.name, unit.name,
                              unit.is_defined ? "a unit of a kind that no quantity of a machine has"
                                              : "a unit that the FMU does not define"),
                  "a variable in a unit that hersey knows, or without one");
    return std::nullopt;
  }
  known.unit = *si;
  if (unit.is_defined) return known;
  // A name that says enough, as N.m does.
  unit.offset = convert_to_si({0, unit.name}, *si);
  unit.factor = convert_to_si({1, unit.name}, *si) - unit.offset;
  if (variable.is_relative) unit.offset = 0;
  unit.is_defined = true;
  return known;
}

std::optional<ExchangedVariable> exchanged_variable(Context& context, const Value& at, const Fmu& fmu,
                                                    const std::string& name, fmi::Causality causality) {
  const bool is_input = causality == fmi::Causality::input;
  const std::string what = is_input ? "input" : "output";
  const fmi::Variable* found = fmu.description.find(name);
  std::string why;
  if (found == nullptr)
    why = fmt::format("no variable '{}' in the FMU", name);
  else if (found->causality != causality)
    why = fmt::format("variable '{}', whose causality is {}", name, found->causality_name);
  else if (found->is_array)
    why = fmt::format("variable '{}', an array", name);
  else if (found->type != fmi::VariableType::real)
    why = fmt::format("variable '{}' of type {}", name, found->type_name);
  if (found != nullptr && why.empty()) return with_unit(context, at, *found);
  std::vector<std::string> names = fmu.description.names(causality);
  std::erase_if(names,
                [&](const std::string& one) { return fmu.description.find(one)->type != fmi::VariableType::real; });
  const std::string expected =
      names.empty() ? fmt::format("an {} that is a real number, of which this FMU has none", what) : one_of(names);
  if (is_input)
    context.fault_at_key(at, why, expected, did_you_mean(name, names));
  else
    context.fault(at, why, expected, did_you_mean(name, names));
  return std::nullopt;
}

std::string kind_in_words(const std::string& si_unit) {
  return si_unit == "1/s" ? "an angular velocity or a frequency" : dimension_of(si_unit).name;
}

}  // namespace hersey::model
