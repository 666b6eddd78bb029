#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/nastran_card.h"

namespace hersey::fem {

/// Entries written by their difference from the previous one: "=" repeats a field, "==" all that follow, "*(2)" or "*2"
/// adds to a number; "=(3)" or "=3" instead of a name repeats the step three times more.
class NastranReplication {
 public:
  /// True if an entry is written by its difference from the previous one.
  [[nodiscard]] static bool is_written_so(const NastranCard& card);

  /// Replaces the entry by its expanded form; `storage` holds the text of its fields.
  void replace(NastranCard& card, std::deque<std::string>& storage);

  /// The next repetition, into `card`; false where none is left.
  bool repeat(NastranCard& card, std::deque<std::string>& storage);

  /// Keeps what the next entry may refer to: the entry, and the step if it was written so.
  void keep(const NastranCard& card, bool is_written_so);

 private:
  void step(NastranCard& card, std::deque<std::string>& storage);

  std::string name_;                 ///< name of the last entry
  std::vector<std::string> fields_;  ///< its fields
  std::vector<std::string> steps_;   ///< steps of the last entry written by differences: "=", "*..." or a value
  long left_ = 0;                    ///< repetitions still to come
  int line_ = 0;                     ///< line of the repetitions
  long made_ = 0;
};

}  // namespace hersey::fem
