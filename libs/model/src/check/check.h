#pragma once

#include <map>
#include <string>
#include <vector>

#include "check/schema_type.h"
#include "tree/source_tree.h"

namespace hersey::model {

struct Member;

/// A checked value in SI units. Where the file is wrong the fault is reported and the value is left `broken`; the tree
/// stays complete enough to check the rest.
struct Value {
  const Type* type = nullptr;
  SourcePosition position;
  SourcePosition key_position;  ///< of the key that opens it; as `position` where there is none
  std::string path;
  bool broken = false;
  bool given = true;            ///< false: the default of a missing key
  double number = 0;            ///< quantity, integer
  std::vector<double> numbers;  ///< quantity with count > 1
  std::string unit;             ///< SI unit the quantity was found to have; empty for a bare 0 of several units
  std::string text;             ///< text, scalar, choice, reference, word of a quantity, tag of a variant
  std::string formula;          ///< as in Node; for expressions and for scales
  int text_offset = -1;         ///< as in Node
  std::size_t alternative = 0;  ///< any_of: which one; its value is `members.front()`
  std::vector<Member> members;  ///< object, named, variant by key; list by index

  /// The value of `key`, given or default; null if it has neither or is missing.
  /// @pre the format has this key here, so that no misspelt one reads as absent
  [[nodiscard]] const Value* find(const std::string& key) const;

  /// True if there is such a member; for mappings that are distinguished by their keys.
  [[nodiscard]] bool has(const std::string& key) const;
};

/// One `key: value`, or an item of a list with its index.
struct Member {
  std::string key;
  Value value;
};

/// Checks `node` against `type`.
/// @param positions  receives the position of every key, by path.
[[nodiscard]] Value check(const Node& node, const Type& type, std::vector<Fault>& faults,
                          std::map<std::string, SourcePosition>& positions);

/// Letters, digits and _, beginning with a letter: fit for expressions and key paths.
[[nodiscard]] bool is_name(const std::string& text);

}  // namespace hersey::model
