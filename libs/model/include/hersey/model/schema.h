#pragma once

#include <string>

namespace hersey::model {

/// The format of the model file as a JSON Schema (draft 2020-12), from the same tree the reader checks with.
[[nodiscard]] std::string schema_json();

/// The reference page docs/model-file.md, from the same tree.
[[nodiscard]] std::string schema_markdown();

}  // namespace hersey::model
