#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hersey/fmi/fmu_error.h"

namespace hersey::fmi {

/// Unit of a variable, as an FMU defines it: SI value = factor * number + offset (FMI 2.0.4, section 2.2.2; FMI 3.0.1,
/// section 2.4.3).
struct Unit {
  std::string name;             ///< free text, "rpm"
  bool is_defined = false;      ///< false: the FMU has a name for it and says no more
  std::array<int, 8> powers{};  ///< of kg, m, s, A, K, mol, cd and rad
  double factor = 1, offset = 0;

  /// Product of base units in the form that core/units.h reads, "kg.m2.s-2"; "1" for a pure number.
  [[nodiscard]] std::string base_units() const;
};

/// Type of a variable. `other`: one that this program does not exchange.
enum class VariableType { real, integer, boolean, text, other };

enum class Causality { parameter, input, output, other };

/// A variable of an FMU.
struct Variable {
  std::string name;
  unsigned reference = 0;  ///< value reference
  VariableType type = VariableType::other;
  std::string type_name;  ///< that of the standard: "Real", "Float64"
  Causality causality = Causality::other;
  std::string causality_name;  ///< "calculatedParameter", "local"
  bool is_array = false;       ///< it has dimensions (FMI 3)
  bool is_constant = false;    ///< its variability
  std::optional<Unit> unit;    ///< unset: the FMU gives none
  bool is_relative = false;    ///< a difference (relativeQuantity), to which the unit's offset is not added
  std::string start;           ///< as written; empty: none
};

/// The parts of an FMU's modelDescription.xml that its importer needs.
struct Description {
  int version = 0;  ///< 2 or 3
  std::string model_name, token, model_identifier;
  bool saves_state = false;        ///< its state can be got, set and serialised
  double fixed_internal_step = 0;  /// communication steps are multiples of it (FMI 3) [s]; 0: any
  std::vector<Variable> variables;

  /// The variable called `name`; null if there is none.
  [[nodiscard]] const Variable* find(const std::string& name) const;
  /// Names of the variables of a causality that are one number each, in the FMU's order.
  [[nodiscard]] std::vector<std::string> names(Causality causality) const;
};

/// Reads the text of a modelDescription.xml.
/// @throws FmuError unless it is well-formed and describes co-simulation by FMI 2.0 or 3.0
/// @verified_by description_test.cpp
[[nodiscard]] Description read_description(const std::string& xml);

}  // namespace hersey::fmi
