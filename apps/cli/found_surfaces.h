#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "hersey/fem/surface_detection.h"

namespace hersey::cli {

/// Returns the surfaces in SI, in the format of `hersey mesh --json`.
[[nodiscard]] nlohmann::json found_json(const std::vector<fem::FoundSurface>& found);

/// Returns a table of possible bearing surfaces, in millimetres; if there are many, the smaller ones are only counted.
[[nodiscard]] std::string found_text(const std::vector<fem::FoundSurface>& found);

/// Returns the lines of a model file that make frames and bearings of the bores and journals; empty if there are none.
/// @param file, length_unit  of the mesh that has the surfaces by their names
[[nodiscard]] std::string model_lines(const std::vector<fem::FoundSurface>& found, const std::string& file,
                                      const std::string& length_unit);

}  // namespace hersey::cli
