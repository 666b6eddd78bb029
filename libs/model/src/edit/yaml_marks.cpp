#include "edit/yaml_marks.h"

#include <algorithm>

namespace hersey::model {
namespace {

/// The mark of UTF-8 that some editors write first, which is no part of line 1 for the parser either.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// A quote opens a quoted scalar only where a scalar begins.
bool opens_quotes(std::string_view text, std::size_t at) {
  if (text[at] != '"' && text[at] != '\'') return false;
  return at == 0 || std::string_view(" \t\n[{,:").find(text[at - 1]) != std::string_view::npos;
}

}  // namespace

std::vector<std::size_t> starts_of_lines(const std::string& text) {
  std::vector<std::size_t> lines{text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0};
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') lines.push_back(i + 1);
  return lines;
}

std::size_t behind_quotes(std::string_view text, std::size_t at) {
  const char quote = text[at];
  for (std::size_t i = at + 1; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text[i] == quote) {
      if (quote == '"' || i + 1 >= text.size() || text[i + 1] != quote) return i + 1;
      ++i;  // '' is a quote in single quotes
    }
  }
  return text.size();
}

bool begins_comment(std::string_view text, std::size_t at) {
  return text[at] == '#' && (at == 0 || kSpace.find(text[at - 1]) != std::string_view::npos || text[at - 1] == '\n');
}

std::size_t behind_brackets(std::string_view text, std::size_t at) {
  int depth = 0;
  for (std::size_t i = at; i < text.size(); ++i) {
    if (begins_comment(text, i)) {
      i = std::min(text.find('\n', i), text.size());
    } else if (opens_quotes(text, i)) {
      i = behind_quotes(text, i) - 1;
    } else if (text[i] == '{' || text[i] == '[') {
      ++depth;
    } else if ((text[i] == '}' || text[i] == ']') && --depth == 0) {
      return i + 1;
    }
  }
  return text.size();
}

std::size_t without_trailing_space(std::string_view text, std::size_t begin, std::size_t end) {
  while (end > begin && std::string_view(" \t\r\n").find(text[end - 1]) != std::string_view::npos) --end;
  return end;
}

std::size_t end_of_line(std::string_view text, std::size_t at) { return std::min(text.find('\n', at), text.size()); }

std::size_t indentation(std::string_view text, std::size_t line) {
  const std::size_t first = text.find_first_not_of(' ', line);
  return (first == std::string_view::npos ? text.size() : first) - line;
}

std::size_t behind_plain(std::string_view text, std::size_t at, std::size_t column, bool is_in_flow) {
  std::size_t end = at;
  for (std::size_t i = at; i < text.size(); ++i) {
    const bool ends_key = text[i] == ':' && (i + 1 == text.size() ||
                                             std::string_view(" \t\r\n").find(text[i + 1]) != std::string_view::npos);
    if (begins_comment(text, i) || ends_key) break;
    if (is_in_flow && std::string_view(",[]{}").find(text[i]) != std::string_view::npos) break;
    if (text[i] == '\n' && !is_in_flow) {
      std::size_t next = i + 1;
      while (next < text.size() && without_trailing_space(text, next, end_of_line(text, next)) == next)
        next = end_of_line(text, next) + 1;  // empty lines
      if (next >= text.size() || indentation(text, next) <= column) break;
    }
    end = i + 1;
  }
  return without_trailing_space(text, at, end);
}

std::size_t behind_block(std::string_view text, std::size_t at, std::size_t column) {
  std::size_t end = end_of_line(text, at);
  const bool keeps_empty_lines = text.substr(at, end - at).find('+') < 3;
  for (std::size_t line = end + 1; line < text.size();) {
    const std::size_t stop = end_of_line(text, line);
    const bool is_empty = without_trailing_space(text, line, stop) == line;
    if (!is_empty && indentation(text, line) <= column) break;
    if (!is_empty || keeps_empty_lines) end = stop;
    line = stop + 1;
  }
  if (keeps_empty_lines) return end > at && text[end - 1] == '\r' ? end - 1 : end;
  return without_trailing_space(text, at, end);
}

std::size_t behind_colon(std::string_view text, std::size_t at) {
  const std::size_t colon = std::min(text.find_first_not_of(kSpace, at), text.size());
  return colon < text.size() && text[colon] == ':' ? colon + 1 : at;
}

}  // namespace hersey::model
