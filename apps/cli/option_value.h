#pragma once

#include <string>

namespace hersey::cli {

/// The quantity given to `option`, in SI. @throws InputError naming the option.
[[nodiscard]] double in_si(const char* option, const std::string& text, const char* unit);

/// Metres in the unit given to --length-unit: "mm" is one millimetre, "25.4 mm" an inch. @throws InputError
[[nodiscard]] double length_unit(const std::string& text);

}  // namespace hersey::cli
