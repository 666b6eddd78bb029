#pragma once

#include <exception>
#include <string>

namespace hersey {

/// Whether an exception tells of a bug of the program, whatever the model is: a broken contract, or one of the standard
/// library's own complaints. What is known to go wrong is told by runtime errors, and memory by std::bad_alloc.
[[nodiscard]] bool is_bug(const std::exception& error);

/// What to tell a user of an exception. Of a bug no expressions of the source: one line that asks for a report, and a
/// second one with the place, for those who read the report.
[[nodiscard]] std::string error_text(const std::exception& error);

}  // namespace hersey
