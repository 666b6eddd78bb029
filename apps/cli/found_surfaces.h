#pragma once

#include <string>
#include <vector>

#include "hersey/fem/surface_detection.h"

namespace hersey::cli {

/// Returns a table of possible bearing surfaces, in millimetres; if there are many, the smaller ones are only counted.
[[nodiscard]] std::string found_text(const std::vector<fem::FoundSurface>& found);

}  // namespace hersey::cli
