#pragma once

#include <deque>
#include <string>
#include <string_view>

#include "mesh/mesh_text.h"
#include "mesh/nastran_card.h"
#include "mesh/nastran_replication.h"

namespace hersey::fem {

/// Splits bulk data into entries: small, large and free fields, tabs, comments, continuations by +, *, comma or blanks,
/// replication.
class NastranCards {
 public:
  explicit NastranCards(LineScanner& lines) : lines_(lines) {}

  /// The next entry, into `card`, whose fields are good until the next call; false at the end of the text.
  bool next(NastranCard& card);

 private:
  void read(std::string_view line, NastranCard& card);
  bool next_line(std::string_view& line);
  std::string_view without_tabs(std::string_view line);
  void add_line(std::string_view line, NastranCard& card);

  LineScanner& lines_;
  std::string_view mark_;             ///< continuation mark of the line read last; often empty
  std::deque<std::string> expanded_;  ///< lines of this entry whose tabs were replaced, fields that were replicated
  NastranReplication replication_;
};

}  // namespace hersey::fem
