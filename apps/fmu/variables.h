#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hersey/run/simulation.h"

namespace hersey::fmu {

/// A variable of an FMU that its importer reads or sets. Its value reference is its index in the list, counted from 1;
/// 0 is time.
struct Variable {
  enum class Kind { parameter, input, output };
  Kind kind = Kind::output;
  std::string name;        ///< structured, "bearings.big_end.force.x"
  std::string unit;        ///< SI
  std::string text;        ///< description
  std::string source;      ///< key path of the model file, name of an input or of an output
  std::size_t column = 0;  ///< of an output's row
  std::size_t size = 0;    ///< of an array, which is the whole row; 0: one number
  double start = 0;        ///< of a parameter or input [SI]
};

/// Everything that an FMU of a model shows, and how it was made.
struct Variables {
  std::vector<Variable> list;
  std::vector<std::string> overrides;  ///< with which the model was exported
  std::string token;                   ///< GUID, instantiation token
};

/// Numbers of the model file that overrides can set: `parameters`, and keys with one number. Not those of `simulation`,
/// not inputs.
/// @param text  of the model file, as given
[[nodiscard]] std::vector<Variable> parameters_of(const std::string& text, const std::vector<run::InputInfo>& inputs);

/// Parameters, inputs and outputs, each name once. In FMI 3 rows of numbered columns are arrays, too: a further
/// variable behind all others, so that names and value references of the others are the same in both versions.
[[nodiscard]] std::vector<Variable> variables_of(const std::string& text, run::Simulation& simulation, int version);

/// Values that a variable has.
[[nodiscard]] inline std::size_t size_of(const Variable& variable) { return variable.size == 0 ? 1 : variable.size; }

/// As the FMU keeps them in resources/variables.json.
[[nodiscard]] std::string to_json(const Variables& variables);
/// @throws std::runtime_error where the text is not of to_json
[[nodiscard]] Variables from_json(const std::string& text);

}  // namespace hersey::fmu
