#pragma once

#include <map>
#include <optional>
#include <string>

#include "hersey/core/input_error.h"

namespace hersey::run {

/// Key path of the first part of a machine that a message names: "joint main, rotation" -> joints.main; "t = 0 s:
/// bearing big_end: ..." -> bearings.big_end; empty if it names none. Whether a model has that part is not asked.
[[nodiscard]] std::string path_of_named_part(const std::string& message);

/// Part of a model that a message is about.
struct NamedPart {
  std::string path;
  SourcePosition position;  ///< of its key in the text
};

/// @param positions  model::Model::positions
/// @returns nothing where the message names no part that stands in the text
/// @verified_by named_part_test.cpp
[[nodiscard]] std::optional<NamedPart> named_part(const std::string& message,
                                                  const std::map<std::string, SourcePosition>& positions);

}  // namespace hersey::run
