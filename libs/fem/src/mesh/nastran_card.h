#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hersey::fem {

/// One entry of Nastran's bulk data: its name in upper case without the star of large fields, and its data fields in
/// order, continuations included. Each line of small fields gives eight, each of large fields four.
struct NastranCard {
  std::string name;
  std::vector<std::string_view> fields;
  int line = 0;
  /// Fault of the entry's lines: a continuation that belongs to another entry, or fields behind the tenth.
  std::string mistake;
  int line_of_mistake = 0;

  /// Returns field `index`, counted from 0; empty where there is none.
  [[nodiscard]] std::string_view field(std::size_t index) const {
    return index < fields.size() ? fields[index] : std::string_view();
  }
};

}  // namespace hersey::fem
