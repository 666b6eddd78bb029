#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hersey/model/model.h"

namespace hersey::model {

/// Short names of what is varied most of a bearing, by its kind, with their key paths in the model file.
struct ShortNames {
  std::vector<std::pair<std::string, std::string>> paths;  ///< "load", "bearings.main.operating_point.load"
  std::pair<std::string, std::string>
      load_or_position;  ///< of which one is given: "load", "eccentricity_ratio"; both empty: none
};
/// Returns the short names of a bearing of `model`.
[[nodiscard]] ShortNames short_names(const Model& model, const Bearing& bearing);

/// What is known of a kind of bearing before there is a model with one.
struct BearingKindNames {
  std::string kind;                     ///< "journal", as in the model file
  std::string title;                    ///< "Journal bearing"
  std::vector<std::string> point_keys;  ///< keys of its operating point, in the order of the schema
  ShortNames short_names;               ///< of a bearing of the given name
};

/// Returns the names of a kind for a bearing called `bearing` with the oil `lubricant`; unset for an unknown kind.
/// @param kind  as in the model file; empty: the kind of a bearing that names none
[[nodiscard]] std::optional<BearingKindNames> names_of_kind(const std::string& kind, const std::string& bearing,
                                                            const std::string& lubricant);

}  // namespace hersey::model
