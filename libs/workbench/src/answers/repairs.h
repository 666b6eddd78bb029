#pragma once

#include <optional>
#include <string>
#include <vector>

#include "answers/request.h"
#include "hersey/core/input_error.h"
#include "hersey/model/text_map.h"

namespace hersey::workbench {

/// A change of the text that mends a fault.
struct Repair {
  std::string label;  ///< "Replace 'mas' by 'mass'"
  std::vector<model::TextEdit> edits;
};

/// The changes that a fault's message knows: the nearest name, a unit for a number without one, a key that is missing
/// or too many. Empty where it knows none.
/// @param map  of the text in which the fault stands; null where it is not YAML
[[nodiscard]] std::vector<Repair> repairs_of(const Fault& fault, const std::string& text, const model::TextMap* map);

/// A text that is looked up by lines, to count columns as browsers do.
class TextColumns {
 public:
  explicit TextColumns(std::string_view text);
  /// Column in UTF-16 units of a byte column, both from 1.
  [[nodiscard]] int utf16(int line, int column) const;

 private:
  std::string_view text_;
  std::vector<std::size_t> lines_;
};

/// `{line, column, endLine, endColumn, text}`.
[[nodiscard]] Json json_of(const model::TextEdit& edit, const TextColumns& columns);
[[nodiscard]] Json json_of(const std::vector<model::TextEdit>& edits, const TextColumns& columns);

/// A fault as Answers::check gives it.
/// @param file  name of the model file in faults; those of other files have no end and no repairs
/// @param folder  from which files are named
[[nodiscard]] Json json_of(const Fault& fault, const std::string& text, const model::TextMap* map,
                           const TextColumns& columns, const std::string& file, const std::string& folder);

}  // namespace hersey::workbench
