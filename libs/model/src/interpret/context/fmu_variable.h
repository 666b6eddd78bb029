#pragma once

#include <optional>
#include <string>

#include "interpret/context/interpret.h"

namespace hersey::model {

/// A variable of an FMU, its unit made complete, and the SI unit of what it measures; empty: it has no unit. FMUs leave
/// the radian out or add it as they like, so that "1/s" may be an angular velocity; "Hz" is none.
struct ExchangedVariable {
  fmi::Variable variable;
  std::string unit;
};

/// Finds the SI unit of a variable; reports one that cannot be converted.
[[nodiscard]] std::optional<ExchangedVariable> with_unit(Context& context, const Value& at,
                                                         const fmi::Variable& variable);

/// The real input or output called `name`; reports one that is not there, or is something else.
[[nodiscard]] std::optional<ExchangedVariable> exchanged_variable(Context& context, const Value& at, const Fmu& fmu,
                                                                  const std::string& name, fmi::Causality causality);

/// What a variable in this SI unit measures, in words.
[[nodiscard]] std::string kind_in_words(const std::string& si_unit);

}  // namespace hersey::model
