#pragma once

#include <exception>
#include <string>

namespace hersey {

/// True if an exception indicates a bug of the program, independent of the model: a violated contract or an exception
/// of the standard library. Expected failures are reported by runtime errors, exhausted memory by std::bad_alloc.
[[nodiscard]] bool is_bug(const std::exception& error);

/// Returns the message for the user. For a bug it contains no expressions of the source: its first line asks for a
/// report, its second line gives the location in the source for the readers of the report.
[[nodiscard]] std::string error_text(const std::exception& error);

}  // namespace hersey
