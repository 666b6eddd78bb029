#pragma once

#include <string>
#include <vector>

#include "hersey/core/input_error.h"

namespace hersey::model {

/// One thing that an earlier version of the format wrote in another way.
struct Change {
  SourcePosition position;  ///< of the value that is renamed, or of the key that goes
  std::string path;         ///< "lubricants.oil.grade"
  std::string what;         ///< "sae_5w_30 is written sae_5w30"
};

struct Conversion {
  std::string text;             ///< of the model file, as this version reads it
  std::vector<Change> changes;  ///< in the order of the file; empty: `text` is as it was given
};

/// Converts a model file of an earlier version. Only outdated parts are changed: comments, order and layout stay, and
/// so do other faults.
///
///
/// @param text  of the model file
/// @param file  names it in faults
/// @throws InputError if the text is not YAML.
/// @verified_by convert_test.cpp
[[nodiscard]] Conversion converted(const std::string& text, const std::string& file);

}  // namespace hersey::model
