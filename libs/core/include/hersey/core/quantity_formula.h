#pragma once

#include <string_view>
#include <vector>

#include "hersey/core/units.h"

/// Formulas of quantities, such as those of the parameters of a model.
namespace hersey {

/// Returns the value and the unit of a formula such as "(50 mm)/2 - 3*(0.1 mm)" or "2*(100 N)*(30 mm)".
///
/// Numbers with or without units, `pi`, parentheses, and `^` before signs before `*` and `/` before `+` and `-`, as in
/// arithmetic: -2^2 is -4, (-2)^2 is 4. A unit extends to the next operator; `/` and `*` belong to the unit if a letter
/// follows immediately, so "3 m/s*2" is twice 3 m/s. Quantities of the same dimension can be added; a factor without
/// unit leaves the unit unchanged, other products are in SI units. Degrees Celsius can be neither factors nor summands.
/// @returns the value, finite, in `unit`; an empty unit for a bare number.
/// @throws QuantityError if the text is no such formula or its dimensions are incompatible.
[[nodiscard]] Quantity evaluate_formula(std::string_view text);

/// Returns the values of `count` formulas side by side, "0 -(2500 N) 2*(3 N)". Operators inside a formula have no
/// spaces around them. A value without unit has the unit of the next one, as in `parse_quantities`.
/// @throws QuantityError as above, or if the number of formulas differs from `count`.
[[nodiscard]] std::vector<Quantity> evaluate_formulas(std::string_view text, int count);

}  // namespace hersey
