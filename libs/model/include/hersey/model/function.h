#pragma once

#include <cstddef>
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

/// Course of an FMU's output from one exchange to the next.
enum class FmuHold {
  constant,      ///< the value of the exchange
  extrapolated,  ///< on the line through the values of this exchange and the one before
  ramp,          ///< from the value of the exchange before to that of this one: continuous, and one step late
};

/// The output of an FMU that a function follows.
struct FmuSignal {
  std::size_t fmu = 0, output = 0;  ///< indices in Model::fmus and Fmu::outputs
  double scale = 1;                 ///< factor on its value in SI
  FmuHold hold = FmuHold::constant;
};

/// A load, drive or magnitude: `value->value(x)` with x[i] the value of variables[i] in SI (s, rad, m, rad/s, m/s).
struct Function {
  std::shared_ptr<const ScalarFunction> value;      ///< never null; result in SI
  std::vector<Variable> variables;                  ///< empty for a constant
  std::optional<std::pair<double, double>> domain;  ///< range of variables[0] a table covers; unset: everywhere
  SourcePosition position;
  std::string path;  ///< key path, e.g. "forces.gas.magnitude"
  /// Set: a run replaces `value`, which is that of the FMU's start, by one that follows this output.
  std::optional<FmuSignal> signal = {};

  /// True if it reads no variable, not even the time.
  [[nodiscard]] bool is_constant() const { return variables.empty(); }
};

}  // namespace hersey::model
