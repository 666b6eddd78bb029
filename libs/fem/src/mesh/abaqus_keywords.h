#pragma once

#include <set>
#include <string>
#include <string_view>

namespace hersey::fem {

/// Whether a keyword (upper case, without blanks) writes nodes or elements by a rule, or moves them: a mesh read
/// without following it would be another one.
[[nodiscard]] bool changes_the_mesh(std::string_view keyword);

/// Whether a keyword says nothing of shape, connections, stiffness or mass at rest: names, loads, supports, output,
/// contact laws, thermal constants.
[[nodiscard]] bool concerns_no_mesh(std::string_view keyword);

/// Parameters of a keyword that the reader follows or may ignore; null for a keyword it does not read.
[[nodiscard]] const std::set<std::string_view>* parameters_of(std::string_view keyword);

}  // namespace hersey::fem
