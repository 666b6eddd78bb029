#pragma once

#include <string>
#include <vector>

namespace hersey::model {

/// Returns the value at a key path of a model after overrides and parameters are applied, as JSON: mappings and lists
/// with texts as they are written ("40 um"), null for nothing. Nothing is checked against the format.
///
///
/// @param text       of the model file
/// @param file       names it in faults
/// @param overrides  as of model::read
/// @param path       "bearings.big_end.radial_clearance", "parameters.load"; empty for all of it
/// @throws InputError if the text is not YAML, an override has no target, or there is no value at `path`.
/// @verified_by override_test.cpp
[[nodiscard]] std::string written_json(const std::string& text, const std::string& file,
                                       const std::vector<std::string>& overrides, const std::string& path);

}  // namespace hersey::model
