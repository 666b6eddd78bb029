#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/core/scalar_function.h"

namespace hersey::model {

/// Variable on which a function of the model file depends.
struct Variable {
  enum class Kind { time, coordinate, rate, argument };  ///< argument: given by the function's key, a length, ...
  Kind kind = Kind::time;
  std::string joint;       ///< empty for time
  std::string coordinate;  ///< "rotation", "translation", "x", "y"; empty for time
};

/// A load, drive or magnitude: `value->value(x)` with x[i] the value of variables[i] in SI (s, rad, m, rad/s, m/s).
struct Function {
  std::shared_ptr<const ScalarFunction> value;      ///< never null; result in SI
  std::vector<Variable> variables;                  ///< empty for a constant
  std::optional<std::pair<double, double>> domain;  ///< range of variables[0] a table covers; unset: everywhere
  SourcePosition position;
  std::string path;  ///< key path, e.g. "forces.gas.magnitude"

  /// True if it reads no variable, not even the time.
  [[nodiscard]] bool is_constant() const { return variables.empty(); }
};

}  // namespace hersey::model
