#pragma once

#include <string>

namespace hersey::model {

/// The format of the model file as a JSON Schema (draft 2020-12), from the same tree the reader checks with.
[[nodiscard]] std::string schema_json();

/// The reference page docs/model-file.md, from the same tree.
[[nodiscard]] std::string schema_markdown();

/// Returns the description of the key at `path`, "bearings.main.supply": meaning, value, units, default and keys, from
/// the same tree; for an empty path the sections of a model.
/// @throws InputError for an unknown key, with the nearest one
[[nodiscard]] std::string explanation(const std::string& path);

}  // namespace hersey::model
