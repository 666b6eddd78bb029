#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "hersey/fem/surface_detection.h"

namespace hersey::cli {

/// In SI, as `hersey mesh --json` has them.
[[nodiscard]] nlohmann::json found_json(const std::vector<fem::FoundSurface>& found);

/// A table of surfaces with what could be a bearing, in millimetres; the smaller ones of many are counted only.
[[nodiscard]] std::string found_text(const std::vector<fem::FoundSurface>& found);

/// The lines of a model file that make frames and bearings of the bores and journals; empty where there are none.
/// @param file, length_unit  of the mesh that has the surfaces by their names
[[nodiscard]] std::string model_lines(const std::vector<fem::FoundSurface>& found, const std::string& file,
                                      const std::string& length_unit);

}  // namespace hersey::cli
