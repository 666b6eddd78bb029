#pragma once

#include <set>
#include <string>
#include <string_view>

namespace hersey::fem {

/// True if a keyword (upper case, without blanks) generates nodes or elements by a rule, or moves them: without it the
/// mesh would be another one.
[[nodiscard]] bool changes_the_mesh(std::string_view keyword);

/// True if a keyword has no influence on shape, connections, stiffness or mass at rest: names, loads, supports, output,
/// contact laws, thermal constants.
[[nodiscard]] bool concerns_no_mesh(std::string_view keyword);

/// Parameters of a keyword that the reader follows or may ignore; null for a keyword it does not read.
[[nodiscard]] const std::set<std::string_view>* parameters_of(std::string_view keyword);

}  // namespace hersey::fem
