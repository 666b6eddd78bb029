#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hersey::model {

/// The format of the model file as a JSON Schema (draft 2020-12), from the same tree the reader checks with.
[[nodiscard]] std::string schema_json();

/// The reference page docs/model-file.md, from the same tree.
[[nodiscard]] std::string schema_markdown();

/// Returns the description of the key at `path`, "bearings.main.supply": meaning, value, units, default and keys, from
/// the same tree; for an empty path the sections of a model.
/// @throws InputError for an unknown key, with the nearest one
[[nodiscard]] std::string explanation(const std::string& path);

/// The description of a key in parts, for a program that shows them.
struct KeyExplanation {
  std::string path;       ///< with <name> where names are free
  std::string condition;  ///< "type: revolute", where only some variants have the key; else empty
  std::string text;       ///< meaning, a sentence; empty for the item of a mapping with free names
  std::string kind;   ///< "text", "scalar", "integer", "quantity", "choice", "reference", "mapping", "named" or "list"
  std::string value;  ///< what is expected: "a length > 0, such as 45 mm"
  std::string unit;   ///< SI unit of a quantity: the first that the format allows; else empty
  std::vector<std::string> units;  ///< usual units of it
  std::string default_text;        ///< in words
  bool is_required = false;
  std::vector<std::pair<std::string, std::string>> allowed;  ///< words that may be given, with their meaning
  std::vector<std::pair<std::string, std::string>> keys;     ///< of a mapping, with their meaning
};

/// Descriptions of the key at `path` as explanation(), in parts; several where variants differ in it, and none for an
/// empty path. @throws InputError as explanation()
[[nodiscard]] std::vector<KeyExplanation> key_explanations(const std::string& path);

/// A value that the format allows for the key at `path`, as YAML in one line: its example, the first of its words, or
/// the keys that a mapping requires. @throws InputError as explanation()
[[nodiscard]] std::string example_value(const std::string& path);

}  // namespace hersey::model
