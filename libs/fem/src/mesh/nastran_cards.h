#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh_text.h"

namespace hersey::fem {

/// One entry of Nastran's bulk data: its name in upper case without the star of large fields, and its data fields in
/// turn, continuations included. Each line of small fields gives eight, each of large fields four.
struct NastranCard {
  std::string name;
  std::vector<std::string_view> fields;
  int line = 0;
  /// What is wrong with its lines: a continuation that belongs to another entry, or fields behind the tenth.
  std::string mistake;
  int line_of_mistake = 0;

  /// Field `place`, counted from 0; empty where there is none.
  [[nodiscard]] std::string_view field(std::size_t place) const {
    return place < fields.size() ? fields[place] : std::string_view();
  }
};

/// Splits bulk data into entries: small, large and free fields, tabs, comments, continuations by +, *, comma or blanks.
class NastranCards {
 public:
  explicit NastranCards(LineScanner& lines) : lines_(lines) {}

  /// The next entry, into `card`, whose fields are good until the next call; false at the end of the text.
  bool next(NastranCard& card);

 private:
  bool next_line(std::string_view& line);
  std::string_view without_tabs(std::string_view line);
  void add_line(std::string_view line, NastranCard& card);

  LineScanner& lines_;
  std::string_view mark_;             ///< by which the line read last names its continuation; often empty
  std::deque<std::string> expanded_;  ///< lines of this entry whose tabs were replaced
};

}  // namespace hersey::fem
