#pragma once

#include <string>

namespace hersey::cli {

/// The value of a command line option in `unit` (SI). @throws InputError naming the option.
[[nodiscard]] double quantity(const char* option, const std::string& text, const char* unit);

/// Metres in the unit of length `text`: "mm", or "25.4 mm" for an inch. @throws InputError
[[nodiscard]] double length_unit(const std::string& text);

}  // namespace hersey::cli
