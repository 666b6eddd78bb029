#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hersey/model/model.h"

namespace hersey::model {

/// Short names of what is varied most of a bearing, by its kind, with their key paths in the model file.
struct ShortNames {
  std::vector<std::pair<std::string, std::string>> paths;  ///< "load", "bearings.main.operating_point.load"
  std::pair<std::string, std::string> load_or_position;    ///< of which one is given: "load", "eccentricity_ratio"
};
/// Returns the short names of a bearing of `model`.
[[nodiscard]] ShortNames short_names(const Model& model, const Bearing& bearing);

}  // namespace hersey::model
