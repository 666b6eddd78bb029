#pragma once

#include <string>

#include "hersey/fem/mesh_quality.h"

namespace hersey::cli {

/// The quantity given to `option`, in SI. @throws InputError naming the option.
[[nodiscard]] double in_si(const char* option, const std::string& text, const char* unit);

/// Metres in the unit given to --length-unit: "mm" is one millimetre, "25.4 mm" an inch. @throws InputError
[[nodiscard]] double length_unit(const std::string& text);

/// Value of --parts: one or apart.
[[nodiscard]] inline fem::Parts parts_of(const std::string& text) {
  return text == "apart" ? fem::Parts::apart : fem::Parts::one;
}

}  // namespace hersey::cli
