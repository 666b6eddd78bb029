#include "schema/format.h"

namespace hersey::model {
namespace {

TypePtr root() {
  const TypePtr parameters = named("a mapping from names to values", scalar("a number, quantity or word", "2500 N"));
  return object(
      "a model",
      {
          required("hersey", integer(1, {.low = 1, .high = 1}), "Version of this format."),
          defaulted("title", text("a line of text", "Big-end bearing"), "", "Heads the results and the report."),
          defaulted("description", text("text", "Table 1 of the paper"), "", "Free text, shown in the report."),
          optional(
              "parameters", parameters,
              "Values usable below as `${name}`; `--set name=value` replaces them. Quote a `${name}` inside braces "
              "or brackets, since YAML gives braces a meaning of its own."),
          optional("templates", named("a mapping from names to templates", template_format()),
                   "Parts of a model with `parameters` of their own, put in by `use`; see [templates](#templates)."),
          optional(
              "use", use_format(),
              "Puts templates into the mapping that contains it, this one or any below; see [templates](#templates)."),
          defaulted("gravity", vector("m/s^2", "0 -9.81 0 m/s^2"), "0 0 0 m/s^2",
                    "Acceleration of free fall, ground axes."),
          optional("bodies", bodies_format(),
                   "The rigid bodies. A file of bearings alone, for `hersey bearing`, has none.",
                   "**required** to simulate"),
          optional("joints", joints_format(),
                   "Connections between bodies. A body without any joint moves freely; loops may close."),
          optional("fmus", fmus_format(),
                   "Models of other programs that run beside the machine: controllers, loads, drives; see "
                   "[FMU](fmu.md#fmus-in-a-model)."),
          optional("drives", drives_format(), "Prescribed motions of joint coordinates."),
          optional("couplings", couplings_format(), "Relations between joint coordinates: gears, racks, cams."),
          optional("forces", forces_format(), "Loads and springs."),
          optional("contacts", contacts_format(), "Pairs of shapes that may touch."),
          optional("lubricants", lubricants_format(), "Oils that bearings refer to."),
          optional("thermal", thermal_network_format(), "Bodies and surroundings that the films' heat flows to."),
          optional("circuit", circuit_format(),
                   "The oil circuit that feeds films: pump, valves, galleries, drillings."),
          optional("bearings", bearings_format(),
                   "Oil films: journal bearings, plane sliders, thrust bearings, dampers and piston skirts."),
          optional("simulation", simulation_format(), "Time span, step and solver settings.",
                   "**required** to simulate"),
          defaulted("output", output_format(), "{}", "What is stored, and how often."),
          optional("study", study_format(), "Many runs of this model, shown together in one report."),
      });
}

}  // namespace

TypePtr template_format() {
  return part("a template {parameters: {...}, key: value, ...}", "{parameters: {angle: 90 deg}, width: 20 mm}",
              "template");
}

TypePtr use_format() {
  return part("a template's name, {template: name, parameter: value, ...} or a list of these",
              "{template: main_bearing, angle: 90 deg}", "use");
}

TypePtr axis_format() {
  return or_word(vector("1", "0 0 1"), {{"x", "the frame's x-axis"}, {"y", "its y-axis"}, {"z", "its z-axis"}});
}

const Type& model_format() {
  static const TypePtr format = root();
  return *format;
}

namespace {

/// An expression that `expression_text` explains, and a table; `over` if not null says what x is.
std::vector<TypePtr> mappings_of_functions(const std::string& example, const std::string& formula,
                                           const std::string& expression_text, const std::optional<Key>& over) {
  const TypePtr expression = object(
      "an expression",
      {
          required("expression", text("an expression", formula), expression_text),
          required("unit", text("a unit", example.substr(example.find(' ') + 1)), "Unit of the formula's value."),
      });
  const TypePtr column = text("a column's name", "angle");
  const TypePtr from_file = object(
      "a table in a file",
      {
          required("file", text("a file", "gas.csv"),
                   "Comma-separated values beside the model file; the first line names the columns with their units, "
                   "`angle [deg], pressure [bar]`."),
          required("x", column, "Name of the column with the argument, increasing."),
          required("y", column, "Name of the column with the value."),
      });
  const TypePtr pair = list("a pair", number("0.5"), 2);
  const TypePtr inline_table =
      object("a table in place", {
                                     required("points", list("a list of [x, y] pairs", pair), "Pairs, x increasing."),
                                     required("x_unit", text("a unit", "deg"), "Unit of x."),
                                     required("y_unit", text("a unit", "bar"), "Unit of y."),
                                 });
  std::vector<Key> table_keys = {
      required("table", any_of("a table", {from_file, inline_table}), "The points, in a file or in place."),
      optional("period", quantity_in({"s", "rad", "m"}, "720 deg", Range::positive()),
               "The table repeats with this period.", "does not repeat"),
      optional("shift", quantity_in({"s", "rad", "m"}, "180 deg"),
               "By how much later the table begins: 180 deg for the cylinder that fires then.", "0"),
      defaulted("interpolation",
                choice({{"linear", "straight between points"},
                        {"smooth", "monotone cubic: no overshoot, continuous first derivative"}}),
                "linear", "Between the points."),
      defaulted("scale", scale_factor("4418 mm^2"), "1",
                "Factor on y, with a unit: a pressure table times an area is a force."),
  };
  if (over) table_keys.insert(table_keys.begin() + 1, *over);
  return {expression, object("a table", std::move(table_keys))};
}

/// A constant in one of `si_units`, or one of these mappings.
TypePtr constant_or(const std::vector<std::string>& si_units, const std::string& example, std::vector<TypePtr> mappings,
                    const std::string& or_what, const std::string& id) {
  mappings.insert(mappings.begin(), quantity_in(si_units, example));
  return with_id(any_of("a constant such as " + example + or_what, std::move(mappings)), id);
}

TypePtr fmu_output_format() {
  return object(
      "the output of an FMU",
      {
          required("fmu", text("a name in `fmus`", "controller"),
                   "The FMU; of functions that are a force, torque, speed or acceleration."),
          required("output", text("a variable of the FMU", "torque"), "Its output."),
          defaulted("hold",
                    choice({{"constant", "the value of the last exchange"},
                            {"extrapolated", "on the line through the values of the last two exchanges"},
                            {"ramp",
                             "from the value of the last but one exchange to that of the last: continuous, and "
                             "one communication step late; what drives with a speed need"}}),
                    "constant", "How it goes on between two exchanges."),
          defaulted("scale", scale_factor("-1"), "1",
                    "Factor on the output; with a unit where the FMU gives the output none, `1 N.m`."),
      });
}

const std::string kOperations =
    "`+ - * / ^`, comparisons, `?:`, `pi`, `e`, sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, exp, ln, "
    "log10, sqrt, abs, sign, min, max.";
const std::string kInTimeAndCoordinates =
    "Formula in `t` [s] and joint coordinates such as `main.rotation` [rad or m] and `main.rotation_rate` [rad/s or "
    "m/s]; " +
    kOperations;

}  // namespace

TypePtr function_format(const std::vector<std::string>& si_units, const std::string& example) {
  std::string id = "function";
  for (const std::string& unit : si_units) id += " " + unit;
  std::vector<TypePtr> mappings =
      mappings_of_functions(example, "100*sin(2*pi*50*t)", kInTimeAndCoordinates,
                            defaulted("over", text("time or joint.coordinate", "main.rotation"), "time", "What x is."));
  mappings.push_back(fmu_output_format());
  return constant_or(si_units, example, std::move(mappings), ", an expression, a table or the output of an FMU", id);
}

TypePtr fmu_input_format() {
  std::vector<TypePtr> ways =
      mappings_of_functions("3000 rpm", "100*sin(2*pi*50*t)", kInTimeAndCoordinates,
                            defaulted("over", text("time or joint.coordinate", "main.rotation"), "time", "What x is."));
  ways.insert(ways.begin(),
              text("a joint coordinate, a quantity of the results, or a number with its unit", "main.rotation_rate"));
  return with_id(any_of("a joint coordinate such as main.rotation_rate, a quantity of the results such as "
                        "bearings.main.h_min, a constant such as 3000 rpm, an expression or a table",
                        std::move(ways)),
                 "function for an FMU");
}

TypePtr law_format(const std::string& si_unit, const std::string& argument, const std::string& argument_unit,
                   const std::string& example) {
  return constant_or(
      {si_unit}, example,
      mappings_of_functions(example, "1e5*" + argument + "^3",
                            "Formula in `" + argument + "` [" + argument_unit + "]; " + kOperations, std::nullopt),
      ", an expression or a table", "law " + si_unit + " over " + argument);
}

TypePtr relation_format() {
  return constant_or({"rad", "m"}, "0 mm",
                     mappings_of_functions("0 mm", "0.01*(1 - cos(input))",
                                           "Formula in `input` [rad or m]; " + kOperations, std::nullopt),
                     ", an expression or a table", "relation");
}

}  // namespace hersey::model
