#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"

namespace hersey::model {

struct Entry;

/// A YAML document as plain data: text, structure and the location of each piece. No types are guessed.
struct Node {
  enum class Kind { null, scalar, sequence, mapping };
  Kind kind = Kind::null;
  SourcePosition position = {};
  std::string text = {};       ///< of a scalar, after `${parameter}` substitution
  std::string formula = {};    ///< the same with every parameter in parentheses; empty if there is no text besides them
  bool is_pasted = false;      ///< no operator is beside the parameters: `text` may be read as it is
  int text_offset = 0;         ///< columns from `position` to the first letter of `text`; -1 where they do not map
  std::string origin = {};     ///< where a substituted text comes from, "parameter load, model.yaml:5:9"; or empty
  bool reported = false;       ///< a fault has been reported: nothing more to say about it
  std::vector<Node> items;     ///< of a sequence
  std::vector<Entry> entries;  ///< of a mapping, in the order of the file

  /// The value of `key` in a mapping; null if it is not there.
  [[nodiscard]] const Node* find(const std::string& key) const;
  [[nodiscard]] Node* find(const std::string& key);
};

/// One `key: value` of a mapping.
struct Entry {
  std::string key;
  SourcePosition position;  ///< of the key
  Node value;
};

/// How much a copy of a value would be.
struct Extent {
  std::size_t nodes = 1, depth = 1;
  std::size_t text_bytes = 0, key_bytes = 0;  ///< of its scalars, and of the keys in it
};

[[nodiscard]] Extent extent_of(const Node& node);

/// The scalar as the user may recognise it: with parameters in parentheses where they are part of a formula.
[[nodiscard]] const std::string& written(const Node& node);

/// "a mapping", "a list", "nothing", or the scalar in quotes with its origin.
[[nodiscard]] std::string description_of(const Node& node);

/// Reads `text` as one YAML document; duplicate keys and keys that are no names are added to `faults`.
/// @returns nothing after a syntax error, which is added to `faults` too: the rest of the tree would be a torso.
[[nodiscard]] std::optional<Node> parse_yaml(const std::string& text, const std::string& file,
                                             std::vector<Fault>& faults);

/// Gives `node` and everything in it the position `position`.
void move_to(Node& node, const SourcePosition& position);

}  // namespace hersey::model
