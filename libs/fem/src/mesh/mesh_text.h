#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hersey::fem {

/// Lines of a text in turn, without their ends and the byte order mark before the first; `number` counts from 1.
class LineScanner {
 public:
  explicit LineScanner(std::string_view text);

  /// The next line, into `line`; false at the end.
  bool next(std::string_view& line);
  /// Lets the next call of `next` return the same line again.
  void back() { at_ = start_, --number_; }
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] std::size_t bytes_left() const { return text_.size() - at_; }
  /// Whether the last line ends as lines do; where it does not, the text may have been cut in it.
  [[nodiscard]] bool ends_with_line() const { return text_.empty() || text_.back() == '\n'; }

 private:
  std::string_view text_;
  std::size_t at_ = 0, start_ = 0;
  int number_ = 0;
};

/// Without blanks and tabs at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// In capitals.
[[nodiscard]] std::string upper(std::string_view text);

/// Parts between commas, trimmed; an empty last part (a trailing comma) is left out. Reuses `parts`.
void split_at_commas(std::string_view text, std::vector<std::string_view>& parts);

/// Equal but for the case of letters.
[[nodiscard]] bool equal_ignoring_case(std::string_view a, std::string_view b);

/// The whole text as a whole number that fits `long`; false if it is none.
[[nodiscard]] bool parse_integer(std::string_view text, long& value);

/// The whole text as a finite number, exponents also as Fortran and Nastran write them (1.5D3, 1.5+3); false if none.
[[nodiscard]] bool parse_number(std::string_view text, double& value);

}  // namespace hersey::fem
