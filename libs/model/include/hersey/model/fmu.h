#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/fmi/description.h"
#include "hersey/model/function.h"

/// The section `fmus`: models of other programs, which run beside the machine.
namespace hersey::model {

/// What an input of an FMU is given at each exchange: a quantity of the results file, or a function of time and joint
/// coordinates.
struct FmuInput {
  fmi::Variable variable;
  std::string quantity;  ///< "bearings.main.h_min"; empty: the function
  std::optional<Function> function;
  bool is_coordinate = false;  ///< the function is a joint coordinate or its rate and no more
  std::string unit;            ///< SI unit of the variable; empty: it has none, and takes the number in SI
  std::string path;            ///< key path, "fmus.controller.inputs.speed"
  SourcePosition position;
};

/// An output of an FMU on which the model depends.
struct FmuOutputVariable {
  fmi::Variable variable;
  std::string unit;  ///< SI unit; empty: it has none
};

/// Start value of a variable of an FMU.
struct FmuParameter {
  fmi::Variable variable;
  std::variant<double, std::string> value;  ///< in the variable's own unit
  SourcePosition position;
};

/// One entry of `fmus`.
struct Fmu {
  std::string name;
  std::filesystem::path file;
  fmi::Description description;
  double step = 0;  ///< communication step [s], > 0
  std::vector<FmuInput> inputs;
  std::vector<FmuParameter> parameters;
  std::vector<FmuOutputVariable> outputs;  ///< those used, each once
  SourcePosition position;
};

/// A number of a variable in its own unit as one in SI.
[[nodiscard]] inline double to_si(const fmi::Variable& variable, double number) {
  return variable.unit && variable.unit->is_defined ? variable.unit->factor * number + variable.unit->offset : number;
}
/// A number in SI as one of a variable in its own unit.
[[nodiscard]] inline double from_si(const fmi::Variable& variable, double number) {
  return variable.unit && variable.unit->is_defined ? (number - variable.unit->offset) / variable.unit->factor : number;
}

}  // namespace hersey::model
