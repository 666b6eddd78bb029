// The section `fmus`: descriptions of the FMUs are read, and names and units compared with them.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "hersey/core/expression.h"
#include "hersey/core/quantity_formula.h"
#include "hersey/core/spelling.h"
#include "hersey/core/units.h"
#include "hersey/fmi/fmu_file.h"
#include "interpret/context/fmu_variable.h"

namespace hersey::model {
namespace {

constexpr double kWholeSteps = 1e-9;  // relative distance from a whole number that is round-off of written numbers

/// Number and unit of a text such as "3000 rpm" in SI, with its SI unit, "1" for a bare number.
std::optional<std::pair<double, std::string>> si_number(Context& context, const Value& at, const std::string& text) {
  try {
    const Quantity quantity = evaluate_formula(text);
    if (quantity.unit.empty()) return std::pair{quantity.number, std::string("1")};
    const std::optional<std::string> unit = si_unit_of(quantity.unit);
    if (unit) return std::pair{convert_to_si(quantity, *unit), *unit};
    context.fault(at, "unknown unit '" + quantity.unit + "'", "a unit such as rpm or N.m");
  } catch (const QuantityError& error) {
    context.fault(at, error.found, error.expected, error.suggestion);
  }
  return std::nullopt;
}

const std::string& formula_of_scalar(const Value& value) { return value.formula.empty() ? value.text : value.formula; }

/// True for what begins as a number: names of quantities do not.
bool begins_as_number(const std::string& text) {
  return !text.empty() && std::string_view("0123456789.+-(").find(text.front()) != std::string_view::npos;
}

class FmuReader {
 public:
  FmuReader(Context& context, const std::string& name, const Value& value) : context_(context), value_(value) {
    fmu_.name = name;
    fmu_.position = value.key_position;
    fmu_.step = number_of(value, "step");
  }

  /// Nothing where there is no description to compare with; faults have been reported then.
  std::optional<Fmu> read() {
    const Value* file = value_.find("file");
    if (file == nullptr || file->broken || !open(*file)) return std::nullopt;
    check_step();
    if (const Value* inputs = value_.find("inputs"))
      for (const auto& [name, given] : inputs->members) read_input(name, given);
    if (const Value* parameters = value_.find("parameters"))
      for (const auto& [name, given] : parameters->members) read_parameter(name, given);
    return std::move(fmu_);
  }

 private:
  bool open(const Value& file) {
    fmu_.file = referenced_file(context_, file.text);
    std::string why;
    try {
      const fmi::FmuFile archive(fmu_.file);
      fmu_.description = archive.description();
      why = fmi::missing_library(archive, fmu_.description);
    } catch (const fmi::FmuError& error) {
      why = error.what();
    }
    if (why.empty()) return true;
    context_.fault(file, fmu_.file.string() + ": " + why,
                   "an FMU for co-simulation by FMI 2.0 or 3.0 with a library for 64-bit Linux");
    return false;
  }

  void check_step() {
    const double fixed = fmu_.description.fixed_internal_step, ratio = fixed > 0 ? fmu_.step / fixed : 1;
    if (ratio >= 1 - kWholeSteps && std::abs(ratio - std::round(ratio)) <= kWholeSteps * ratio) return;
    const Value* step = value_.find("step");
    if (step != nullptr && !step->broken)
      context_.fault(*step, fmt::format("{:.6g} s", fmu_.step),
                     fmt::format("a multiple of {:.6g} s, the FMU's own step", fixed));
  }

  void read_input(const std::string& name, const Value& given) {
    std::optional<ExchangedVariable> variable = exchanged_variable(context_, given, fmu_, name, fmi::Causality::input);
    if (!variable || given.broken || given.members.empty()) return;
    FmuInput input{.variable = std::move(variable->variable),
                   .unit = std::move(variable->unit),
                   .path = given.path,
                   .position = given.position};
    const Value& content = given.members.front().value;
    if (content.type->kind != Type::Kind::text)
      input.function = function(given, content, input.unit);
    else if (begins_as_number(formula_of_scalar(content)))
      input.function = constant(content, input.unit);
    else if (const auto coordinate = joint_variable(context_, content.text))
      input.function = value_of(*coordinate, content, input), input.is_coordinate = true;
    else
      input.quantity = content.text;
    fmu_.inputs.push_back(std::move(input));
  }

  /// An expression or table; an expression in the SI unit of what it gives, if that fits.
  Function function(const Value& given, const Value& content, const std::string& unit) {
    std::string wanted = unit;
    if (content.has("expression")) {
      const std::optional<std::string> own = si_unit_of(text_of(content, "unit"));
      if (own && (wanted.empty() || measure_the_same_but_for_radians(*own, wanted))) wanted = *own;
    }
    return function_of(context_, given, wanted.empty() ? "1" : wanted);
  }

  /// A joint coordinate or its rate, "main.rotation_rate".
  std::optional<Function> value_of(const JointVariable& coordinate, const Value& content, const FmuInput& input) {
    if (!input.unit.empty() && !measure_the_same_but_for_radians(coordinate.unit, input.unit)) {
      context_.fault(content, dimension_of(coordinate.unit).name, kind_in_words(input.unit) + " for this input");
      return std::nullopt;
    }
    return Function{.value = std::make_shared<ExpressionFunction>(content.text, std::vector{content.text}),
                    .variables = {coordinate.variable},
                    .position = content.position,
                    .path = content.path};
  }

  std::optional<Function> constant(const Value& content, const std::string& unit) {
    const auto number = si_number(context_, content, formula_of_scalar(content));
    if (!number) return std::nullopt;
    if (!unit.empty() && !measure_the_same_but_for_radians(number->second, unit)) {
      context_.fault(content, dimension_of(number->second).name, kind_in_words(unit) + " for this input");
      return std::nullopt;
    }
    Function function{.value = std::make_shared<ConstantFunction>(number->first)};
    function.position = content.position;
    function.path = content.path;
    return function;
  }

  /// Structural parameters are none: they change sizes of arrays, in a mode of their own.
  static bool is_settable(const fmi::Variable& variable) {
    return !variable.is_constant && !variable.is_array && variable.type != fmi::VariableType::other &&
           (variable.causality_name == "parameter" || variable.causality == fmi::Causality::input);
  }

  [[nodiscard]] std::vector<std::string> settable_names() const {
    std::vector<std::string> names;
    for (const fmi::Causality causality : {fmi::Causality::parameter, fmi::Causality::input})
      for (const std::string& name : fmu_.description.names(causality))
        if (is_settable(*fmu_.description.find(name))) names.push_back(name);
    return names;
  }

  void read_parameter(const std::string& name, const Value& given) {
    const fmi::Variable* found = fmu_.description.find(name);
    if (found == nullptr || !is_settable(*found)) {
      const std::vector<std::string> names = settable_names();
      context_.fault_at_key(
          given,
          found == nullptr ? "no variable '" + name + "' in the FMU"
                           : "variable '" + name + "', which is no parameter or input that can be set",
          names.empty() ? "a parameter or input; this FMU has none" : one_of(names), did_you_mean(name, names));
      return;
    }
    if (given.broken) return;
    if (const auto value = start_value(*found, given)) fmu_.parameters.push_back({*found, *value, given.position});
  }

  std::optional<std::variant<double, std::string>> start_value(const fmi::Variable& variable, const Value& given) {
    const std::string& text = given.text;
    if (variable.type == fmi::VariableType::text) return text;
    if (variable.type == fmi::VariableType::boolean && (text == "true" || text == "false"))
      return text == "true" ? 1.0 : 0.0;
    if (variable.type == fmi::VariableType::real) return real_value(variable, given);
    long long whole = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), whole);
    const bool is_whole = error == std::errc{} && end == text.data() + text.size();
    if (variable.type == fmi::VariableType::integer && is_whole) return static_cast<double>(whole);
    context_.fault(given, "'" + text + "' for a variable of type " + variable.type_name,
                   variable.type == fmi::VariableType::boolean   ? "true or false"
                   : variable.type == fmi::VariableType::integer ? "a whole number"
                                                                 : "variables of other types, which can be set");
    return std::nullopt;
  }

  std::optional<std::variant<double, std::string>> real_value(const fmi::Variable& variable, const Value& given) {
    const auto number = si_number(context_, given, formula_of_scalar(given));
    if (!number) return std::nullopt;
    if (number->second == "1") return number->first;
    const std::optional<ExchangedVariable> known = with_unit(context_, given, variable);
    if (!known) return std::nullopt;
    if (!known->unit.empty() && measure_the_same_but_for_radians(number->second, known->unit))
      return from_si(known->variable, number->first);
    context_.fault(given, dimension_of(number->second).name,
                   known->unit.empty() ? "a bare number: the FMU gives this variable no unit"
                                       : kind_in_words(known->unit) + ", or a bare number in " + variable.unit->name +
                                             ", the variable's own unit");
    return std::nullopt;
  }

  Context& context_;
  const Value& value_;
  Fmu fmu_;
};

}  // namespace

void interpret_fmus(Context& context) {
  for (const auto& [name, value] : section(context.root, "fmus"))
    if (std::optional<Fmu> fmu = FmuReader(context, name, value).read()) context.model.fmus.push_back(std::move(*fmu));
}

namespace {

/// Checkpoints that are asked for, of a run whose state cannot be saved.
void warn_of_checkpoints(Context& context) {
  const Value* simulation = context.root.find("simulation");
  const Value* asked = simulation == nullptr ? nullptr : simulation->find("checkpoint");
  if (asked == nullptr || !asked->given) return;
  for (const Fmu& fmu : context.model.fmus) {
    if (fmu.description.saves_state) continue;
    context.model.warnings.push_back({asked->key_position, asked->path,
                                      "checkpoints, but FMU " + fmu.name + " cannot save its state: none is written",
                                      "FMUs with canGetAndSetFMUState and canSerializeFMUState", ""});
    return;
  }
}

}  // namespace

void check_fmus(Context& context) {
  if (context.model.fmus.empty() || context.model.is_of_bearings_alone()) return;
  const Simulation& run = context.model.simulation;
  const auto refuse = [&](const std::string& key, const std::string& found, const std::string& expected) {
    context.faults.push_back({context.model.position_of(key), key, found, expected, ""});
  };
  if (run.analysis != Analysis::dynamics)
    refuse("simulation.analysis", "an analysis other than `dynamics` with `fmus`",
           "`dynamics`: FMUs go on in time, with the machine");
  if (run.cycle && run.cycle->lead_in != LeadIn::none)
    refuse("simulation.cycle.lead_in", "a lead-in with `fmus`",
           "`lead_in: none`: the state of an FMU is no part of a motion that is searched for");
  warn_of_checkpoints(context);
}

}  // namespace hersey::model
