#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hersey::fem {

/// Reads a text line by line, without line ends and the byte order mark before the first line; `number` counts from 1.
class LineScanner {
 public:
  explicit LineScanner(std::string_view text);

  /// Reads the next line into `line`; false at the end.
  bool next(std::string_view& line);
  /// Makes the next call of `next` return the same line again.
  void back() { at_ = start_, --number_; }
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] std::size_t bytes_left() const { return text_.size() - at_; }
  /// True if the last line has a line end; without one the text may have been truncated.
  [[nodiscard]] bool ends_with_line() const { return text_.empty() || text_.back() == '\n'; }

 private:
  std::string_view text_;
  std::size_t at_ = 0, start_ = 0;
  int number_ = 0;
};

/// Returns a text without blanks and tabs at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Returns a text in capitals.
[[nodiscard]] std::string upper(std::string_view text);

/// Splits a line at commas into trimmed parts; an empty last part (a trailing comma) is dropped. Reuses `parts`.
void split_at_commas(std::string_view text, std::vector<std::string_view>& parts);

/// True if two texts are equal except for the case of letters.
[[nodiscard]] bool equal_ignoring_case(std::string_view a, std::string_view b);

/// Parses the whole text as an integer that fits `long`; false if it is none.
[[nodiscard]] bool parse_integer(std::string_view text, long& value);

/// Parses the whole text as a finite number, exponents also as Fortran and Nastran write them (1.5D3, 1.5+3); false if
/// it is none.
[[nodiscard]] bool parse_number(std::string_view text, double& value);

}  // namespace hersey::fem
