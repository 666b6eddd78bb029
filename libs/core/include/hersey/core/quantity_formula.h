#pragma once

#include <string_view>
#include <vector>

#include "hersey/core/units.h"

/// Quantities computed from others, as parameters of a model are.
namespace hersey {

/// The value of "(50 mm)/2 - 3*(0.1 mm)" or "2*(100 N)*(30 mm)", its unit worked out with it.
///
/// Numbers with or without units, `pi`, parentheses, and `^` before signs before `*` and `/` before `+` and `-`, as in
/// arithmetic: -2^2 is -4, (-2)^2 is 4. A unit reaches to the next operator; `/` and `*` belong to it where a letter
/// follows at once, so "3 m/s*2" is twice 3 m/s. Quantities are added where they measure the same; a factor without
/// unit leaves the unit as it is, other products are in SI units. Degrees Celsius are no factors and no summands.
/// @returns the value, finite, in `unit`; an empty unit for a bare number.
/// @throws QuantityError where the text is no such formula, or measures do not go together.
[[nodiscard]] Quantity evaluate_formula(std::string_view text);

/// The values of `count` formulas side by side, "0 -(2500 N) 2*(3 N)": in each of them operators stand without spaces.
/// A value without unit has the next one's, as in `parse_quantities`.
/// @throws QuantityError as above, or where it is another count.
[[nodiscard]] std::vector<Quantity> evaluate_formulas(std::string_view text, int count);

}  // namespace hersey
