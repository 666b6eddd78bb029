#pragma once

#include <string>
#include <vector>

#include "hersey/model/bare_number.h"

namespace hersey::model {

/// All numbers without unit where the format asks for a quantity, in a model, for callers whose
/// numbers are SI by agreement. Empty, too, where the text is no YAML.
///
/// @param text       of the model file
/// @param file       names it in faults
/// @param overrides  as of model::read
/// @verified_by bare_numbers_test.cpp
[[nodiscard]] std::vector<BareNumber> bare_numbers(const std::string& text, const std::string& file,
                                                   const std::vector<std::string>& overrides);

}  // namespace hersey::model
