#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/raw_mesh.h"

namespace hersey::fem {

/// Meaning of the words after a SET's number.
struct NastranSetWords {
  std::vector<LabelRange> labels;
  /// A word that is no number: of a set of plots, of frequencies, or ALL.
  std::optional<std::string> other;
  std::string fault;  ///< a range that ends before it begins; empty: none
};

/// "1 THRU 10 EXCEPT 4, 6, 15": numbers behind EXCEPT are left out of the range, up to the first beyond it.
[[nodiscard]] NastranSetWords read_set_words(const std::vector<std::string_view>& words);

/// Words between blanks and commas.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view line);

/// True if a line ends the case control section: BEGIN BULK, also shortened (BEGIN BU).
[[nodiscard]] bool is_begin_bulk(std::string_view line);

}  // namespace hersey::fem
