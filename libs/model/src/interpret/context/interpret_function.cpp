#include <algorithm>
#include <cmath>

#include "hersey/core/expression.h"
#include "hersey/core/quantity_formula.h"
#include "hersey/core/spelling.h"
#include "hersey/core/table_function.h"
#include "hersey/core/units.h"
#include "interpret/context/fmu_variable.h"
#include "interpret/context/table_file.h"

namespace hersey::model {
namespace {

/// The points of a table with their units, inline or from a file.
struct Points {
  std::vector<double> x, y;
  std::string x_unit, y_unit;
  std::vector<SourcePosition> positions;  ///< of each point
};

class FunctionReader {
 public:
  FunctionReader(Context& context, const std::string& si_unit, const Argument& argument)
      : context_(context), si_unit_(si_unit), argument_(argument) {}

  Function read(const Value& value) {
    function_.position = value.position;
    function_.path = value.path;
    function_.value = std::make_shared<ConstantFunction>(0);  // where the text is broken
    if (value.broken || value.members.empty()) return function_;
    const Value& content = value.members.front().value;
    if (content.type->kind == Type::Kind::quantity) {
      read_constant(content);
    } else if (content.has("expression")) {
      read_expression(content);
    } else if (content.has("table")) {
      read_table(content);
    } else if (content.has("fmu")) {
      read_fmu(content);
    }
    return function_;
  }

 private:
  void read_constant(const Value& content) {
    if (content.unit.empty() || content.unit == si_unit_) {
      function_.value = std::make_shared<ConstantFunction>(content.number);
      return;
    }
    context_.fault(content, dimension_of(content.unit).name, expectation_of(si_unit_));
  }

  static std::string expectation_of(const std::string& si_unit) {
    const Dimension& dimension = dimension_of(si_unit);
    return dimension.name + ", such as " + dimension.example;
  }

  // --- expressions -----------------------------------------------------------------------------------------------

  void read_expression(const Value& content) {
    const Value& expression = *content.find("expression");
    const Value* unit = content.find("unit");
    if (expression.broken || unit == nullptr || unit->broken) return;
    const std::optional<double> scale = unit_factor(context_, *unit, unit->text, si_unit_);
    const std::string& text = formula_of(expression);
    const std::vector<std::string> names = variables_of(text);
    std::vector<Variable> variables;
    for (const std::string& name : names) {
      const std::optional<Variable> variable = variable_called(name);
      if (!variable) return report_unknown_name(expression, name);
      variables.push_back(*variable);
    }
    try {
      function_.value = std::make_shared<ExpressionFunction>(text, names, scale.value_or(1));
      if (names.empty()) function_.value = std::make_shared<ConstantFunction>(function_.value->value({}));
      function_.variables = std::move(variables);
    } catch (const ExpressionError& error) {
      report_in_expression(expression, error.position, error.what(), "an expression such as 100*sin(2*pi*50*t)", "");
      return;
    }
    check_value_at_start(expression);
  }

  /// With parameters in parentheses where they are part of it.
  static const std::string& formula_of(const Value& expression) {
    return expression.formula.empty() ? expression.text : expression.formula;
  }

  void report_in_expression(const Value& expression, int offset, const std::string& found, std::string expected,
                            std::string suggestion) {
    Fault fault{expression.position, expression.path, found, std::move(expected), std::move(suggestion)};
    if (expression.text_offset >= 0) {
      fault.position.column += expression.text_offset + offset;
    } else {
      fault.found += " in '" + formula_of(expression) + "'";
    }
    context_.faults.push_back(std::move(fault));
  }

  void report_unknown_name(const Value& expression, const std::string& name) {
    const std::string& text = formula_of(expression);
    const auto at = text.find(name);
    const auto before = text.find_last_not_of(' ', at > 0 ? at - 1 : 0);
    const auto after = text.find_first_not_of(' ', at + name.size());
    const bool is_call = after != std::string::npos && text[after] == '(';
    const bool is_unit = expression.text_offset < 0 && at > 0 && before != std::string::npos &&
                         (text[before] == '.' || ('0' <= text[before] && text[before] <= '9'));
    static const std::vector<std::string> functions = {"sin",   "cos",  "tan",  "asin", "acos", "atan",
                                                       "atan2", "sinh", "cosh", "tanh", "exp",  "ln",
                                                       "log10", "sqrt", "abs",  "sign", "min",  "max"};
    const std::vector<std::string> known = is_call ? functions : variable_names();
    report_in_expression(expression, static_cast<int>(at),
                         std::string("unknown ") + (is_call ? "function '" : "name '") + name + "'", one_of(known),
                         is_unit ? "parameters in expressions are bare numbers; one divided by its unit is: half: "
                                   "\"${load}/2 N\""
                                 : did_you_mean(name, known));
  }

  /// An expression of time alone must have a value when the run starts.
  void check_value_at_start(const Value& expression) {
    const bool needs_joints = std::any_of(function_.variables.begin(), function_.variables.end(),
                                          [](const Variable& v) { return v.kind != Variable::Kind::time; });
    if (needs_joints) return;
    const Value* simulation = context_.root.find("simulation");
    const double start = simulation != nullptr ? number_of(*simulation, "start") : 0;
    const std::vector<double> x(function_.variables.size(), start);
    const double value = function_.value->value(x);
    if (!std::isfinite(value)) {
      context_.fault(expression,
                     "'" + formula_of(expression) + "', which is " + std::to_string(value) + " at the start",
                     "a finite value");
    }
  }

  // --- outputs of FMUs -------------------------------------------------------------------------------------------

  void read_fmu(const Value& content) {
    static const std::vector<std::string> followers{"N", "N.m", "rad/s", "m/s", "rad/s^2", "m/s^2"};
    const Value &name = *content.find("fmu"), *output = content.find("output");
    if (name.broken || output == nullptr || output->broken) return;
    if (std::find(followers.begin(), followers.end(), si_unit_) == followers.end())
      return context_.fault_at_key(content, "the output of an FMU",
                                   "a constant, an expression or a table: FMUs give forces, torques, speeds and "
                                   "accelerations");
    std::vector<Fmu>& fmus = context_.model.fmus;
    const auto fmu = std::find_if(fmus.begin(), fmus.end(), [&](const Fmu& one) { return one.name == name.text; });
    if (fmu == fmus.end()) {
      const std::vector<std::string> names = names_in(context_.root, "fmus");
      const bool is_broken = std::find(names.begin(), names.end(), name.text) != names.end();
      if (!is_broken)
        context_.fault(name, "'" + name.text + "'", names.empty() ? "a name in `fmus`, which is empty" : one_of(names),
                       did_you_mean(name.text, names));
      return;
    }
    const auto variable = exchanged_variable(context_, *output, *fmu, output->text, fmi::Causality::output);
    if (!variable) return;
    const std::optional<double> scale = scale_of(content, *variable);
    if (!scale) return;
    follow(static_cast<std::size_t>(fmu - fmus.begin()), *variable, *scale, text_of(content, "hold"));
  }

  /// Factor from the output in SI to the function's value; reports a unit that does not fit.
  std::optional<double> scale_of(const Value& content, const ExchangedVariable& output) {
    const Value& scale = *content.find("scale");
    if (scale.broken) return std::nullopt;
    try {
      const Quantity factor = scale.formula.empty() ? split_quantity(scale.text) : evaluate_formula(scale.formula);
      if (output.unit.empty()) return factor.unit.empty() ? factor.number : convert_to_si(factor, si_unit_);
      Quantity one = product({1, output.unit}, factor);  // in an SI unit, as the output is
      if (measure_the_same_but_for_radians(one.unit, si_unit_)) one.unit = si_unit_;
      return convert_to_si(one, si_unit_);
    } catch (const QuantityError& error) {
      context_.fault(scale.given ? scale : *content.find("output"), error.found,
                     expectation_of(si_unit_) + ", by the output's unit times `scale`", error.suggestion);
      return std::nullopt;
    }
  }

  void follow(std::size_t index, const ExchangedVariable& output, double scale, const std::string& hold) {
    std::vector<FmuOutputVariable>& outputs = context_.model.fmus[index].outputs;
    const auto known = std::find_if(outputs.begin(), outputs.end(), [&](const FmuOutputVariable& one) {
      return one.variable.name == output.variable.name;
    });
    const auto at = static_cast<std::size_t>(known - outputs.begin());
    // One without a unit in the FMU is recorded as a pure number: followers may give it different ones by `scale`.
    if (known == outputs.end()) outputs.push_back({output.variable, output.unit});
    function_.signal = FmuSignal{index, at, scale,
                                 hold == "ramp"           ? FmuHold::ramp
                                 : hold == "extrapolated" ? FmuHold::extrapolated
                                                          : FmuHold::constant};
    function_.variables = {Variable{}};
  }

  // --- variables -------------------------------------------------------------------------------------------------

  std::vector<std::string> variable_names() {
    if (!argument_.name.empty()) return {argument_.name};
    std::vector<std::string> names = {"t"};
    for (const std::string& joint : names_in(context_.root, "joints")) {
      const auto coordinates = coordinates_of_joint(context_.root, joint);
      if (!coordinates) continue;
      for (const JointCoordinate& coordinate : *coordinates) {
        names.push_back(joint + "." + coordinate.name);
        names.push_back(joint + "." + coordinate.name + "_rate");
      }
    }
    return names;
  }

  std::optional<Variable> variable_called(const std::string& name) {
    if (!argument_.name.empty()) {
      if (name != argument_.name) return std::nullopt;
      return Variable{Variable::Kind::argument, "", name};
    }
    if (name == "t") return Variable{};
    const std::optional<JointVariable> found = joint_variable(context_, name);
    return found ? std::optional(found->variable) : std::nullopt;
  }

  std::string unit_of(const Variable& variable) {
    if (variable.kind == Variable::Kind::argument) return argument_.unit;
    if (variable.kind == Variable::Kind::time) return "s";
    return joint_variable(context_, variable.joint + "." + variable.coordinate +
                                        (variable.kind == Variable::Kind::rate ? "_rate" : ""))
        ->unit;
  }

  // --- tables ----------------------------------------------------------------------------------------------------

  void read_table(const Value& content) {
    const std::optional<Variable> variable = variable_of_table(content);
    const Value& table = *content.find("table");
    if (table.broken || table.members.empty()) return;
    const Value& source = table.members.front().value;
    std::optional<Points> points = source.has("file") ? points_from_file(source) : inline_points(source);
    if (!points || !variable) return;
    const bool usable = convert_points(*points, source, content, unit_of(*variable)) && check_order(*points);
    const std::optional<double> period = argument_of(content, "period", unit_of(*variable));
    const std::optional<double> shift = argument_of(content, "shift", unit_of(*variable));
    if (!usable || !period || !shift || !check_period(*points, *period, source)) return;
    for (double& x : points->x) x += *shift;
    const bool smooth = text_of(content, "interpolation") == "smooth";
    if (*period == 0) function_.domain = {points->x.front(), points->x.back()};
    function_.value = std::make_shared<TableFunction>(
        std::move(points->x), std::move(points->y),
        TableFunction::Options{.interpolation = smooth ? Interpolation::smooth : Interpolation::linear,
                               .period = *period});
    function_.variables = {*variable};
  }

  std::optional<Variable> variable_of_table(const Value& content) {
    if (!argument_.name.empty()) return variable_called(argument_.name);
    const Value& over = *content.find("over");
    const std::optional<Variable> variable = over.text == "time" ? Variable{} : variable_called(over.text);
    if (!variable && !over.broken) {
      std::vector<std::string> names = variable_names();
      names.front() = "time";
      context_.fault(over, "'" + over.text + "'", one_of(names), did_you_mean(over.text, names));
    }
    return variable;
  }

  std::optional<Points> inline_points(const Value& source) {
    const Value* list = source.find("points");
    const Value* x_unit = source.find("x_unit");
    const Value* y_unit = source.find("y_unit");
    if (list == nullptr || x_unit == nullptr || y_unit == nullptr || list->broken) return std::nullopt;
    Points points{{}, {}, x_unit->text, y_unit->text, {}};
    for (const auto& [index, pair] : list->members) {
      if (pair.members.size() != 2 || pair.members[0].value.broken || pair.members[1].value.broken) {
        return std::nullopt;
      }
      points.x.push_back(pair.members[0].value.number);
      points.y.push_back(pair.members[1].value.number);
      points.positions.push_back(pair.position);
    }
    return points;
  }

  std::optional<Points> points_from_file(const Value& source) {
    const Value& file = *source.find("file");
    const Value* x = source.find("x");
    const Value* y = source.find("y");
    if (file.broken || x == nullptr || y == nullptr || x->broken || y->broken) return std::nullopt;
    const std::optional<CsvTable> table = read_table_file(context_, file);
    if (!table) return std::nullopt;
    const Column* x_column = column_of(*table, *x);
    const Column* y_column = column_of(*table, *y);
    if (x_column == nullptr || y_column == nullptr) return std::nullopt;
    Points points{x_column->values, y_column->values, x_column->unit, y_column->unit, {}};
    for (const int line : table->lines) points.positions.push_back({table->file, line, 1});
    return points;
  }

  const Column* column_of(const CsvTable& table, const Value& name) {
    const Column* column = table.find(name.text);
    if (column == nullptr) {
      context_.fault(name, "no column '" + name.text + "' in " + table.file, one_of(table.names()),
                     did_you_mean(name.text, table.names()));
    }
    return column;
  }

  /// Converts points to SI: x by its unit, y by its unit times the scale. Reports units that do not fit.
  bool convert_points(Points& points, const Value& source, const Value& content, const std::string& x_si_unit) {
    const Value& x_source = *source.find(source.has("x_unit") ? "x_unit" : "x");
    const Value& y_source = *source.find(source.has("y_unit") ? "y_unit" : "y");
    const std::optional<double> x_factor = unit_factor(context_, x_source, points.x_unit, x_si_unit);
    const Value& scale_value = *content.find("scale");
    Quantity scale;
    try {
      scale = scale_value.formula.empty() ? split_quantity(scale_value.text) : evaluate_formula(scale_value.formula);
    } catch (const QuantityError& error) {
      context_.fault(scale_value, error.found, scale_value.type->expectation(), error.suggestion);
      return false;
    }
    const bool has_y_unit = !points.y_unit.empty(), has_scale_unit = !scale.unit.empty();
    const std::string unit =
        has_y_unit && has_scale_unit ? "(" + points.y_unit + ").(" + scale.unit + ")" : points.y_unit + scale.unit;
    const std::optional<double> y_factor =
        unit_factor(context_, has_scale_unit ? scale_value : y_source, unit, si_unit_);
    if (!x_factor || !y_factor) return false;
    for (double& x : points.x) x *= *x_factor;
    for (double& y : points.y) y *= *y_factor * scale.number;
    return true;
  }

  bool check_order(const Points& points) {
    for (std::size_t i = 1; i < points.x.size(); ++i) {
      if (points.x[i] > points.x[i - 1]) continue;
      context_.faults.push_back({points.positions[i], function_.path, "an x that does not increase",
                                 "each x greater than the one before", ""});
      return false;
    }
    return true;
  }

  /// Period or shift in SI, 0 without one; nothing where it is broken or measures something else than x.
  std::optional<double> argument_of(const Value& content, const std::string& key, const std::string& x_si_unit) {
    const Value* value = content.find(key);
    if (value == nullptr) return 0.0;
    if (value->broken) return std::nullopt;
    if (value->unit == x_si_unit) return value->number;
    context_.fault(*value, dimension_of(value->unit).name, expectation_of(x_si_unit));
    return std::nullopt;
  }

  bool check_period(const Points& points, double period, const Value& source) {
    if (period == 0) return true;
    const double span = points.x.back() - points.x.front();
    const double round_off = 1e-9 * period;
    if (span > period + round_off) {
      context_.fault_at_key(source, "a table longer than its period", "x within one period");
      return false;
    }
    const double first = points.y.front(), last = points.y.back();
    const bool closes = std::abs(last - first) <= 1e-6 * (std::abs(last) + std::abs(first));
    if (span < period - round_off || closes) return true;
    context_.faults.push_back({points.positions.back(), function_.path,
                               "a last value that differs from the first, one period before", "the same value", ""});
    return false;
  }

  Context& context_;
  const std::string& si_unit_;
  const Argument& argument_;
  Function function_;
};

}  // namespace

std::optional<JointVariable> joint_variable(const Context& context, const std::string& name) {
  const auto dot = name.find('.');
  if (dot == std::string::npos) return std::nullopt;
  const std::string joint = name.substr(0, dot), rest = name.substr(dot + 1);
  const auto coordinates = coordinates_of_joint(context.root, joint);
  if (!coordinates) return std::nullopt;
  for (const JointCoordinate& coordinate : *coordinates) {
    const std::string unit = coordinate.rotational ? "rad" : "m";
    if (rest == coordinate.name) return JointVariable{{Variable::Kind::coordinate, joint, coordinate.name}, unit};
    if (rest == coordinate.name + "_rate")
      return JointVariable{{Variable::Kind::rate, joint, coordinate.name}, unit + "/s"};
  }
  return std::nullopt;
}

Function function_of(Context& context, const Value& value, const std::string& si_unit, const Argument& argument) {
  return FunctionReader(context, si_unit, argument).read(value);
}

}  // namespace hersey::model
