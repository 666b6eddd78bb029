#pragma once

#include <optional>
#include <string>

#include "interpret/context/interpret.h"

namespace hersey::model {

/// A variable of an FMU, its unit made complete, and the SI unit of what it measures; empty: it has no unit.
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

/// True if two SI units are of one dimension.
[[nodiscard]] bool measures(const std::string& unit, const std::string& si_unit);

}  // namespace hersey::model
