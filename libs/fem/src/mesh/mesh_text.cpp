#include "mesh/mesh_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace hersey::fem {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

bool parse_plain(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

// 1.5D3 and 1.5+3 rewritten as 1.5e3; empty where the text is longer than any number.
std::string_view with_usual_exponent(std::string_view text, std::array<char, 64>& buffer) {
  std::size_t size = 0;
  for (const char c : text) {
    if (size + 2 > buffer.size()) return {};
    const char last = size == 0 ? '\0' : buffer[size - 1];
    const bool is_bare_exponent = (c == '+' || c == '-') && size > 0 && last != 'e';
    if (is_bare_exponent) buffer[size++] = 'e';
    if (c == '+') continue;
    buffer[size++] = c == 'd' || c == 'D' || c == 'E' ? 'e' : c;
  }
  return {buffer.data(), size};
}

}  // namespace

LineScanner::LineScanner(std::string_view text) : text_(text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";  // of UTF-8; some programs write it
  if (text_.starts_with(mark)) text_.remove_prefix(mark.size());
}

bool LineScanner::next(std::string_view& line) {
  if (at_ >= text_.size()) return false;
  start_ = at_;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  line = text_.substr(at_, end - at_);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  at_ = std::min(end + 1, text_.size());
  ++number_;
  return true;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string upper(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return std::toupper(c); });
  return result;
}

void split_at_commas(std::string_view text, std::vector<std::string_view>& parts) {
  parts.clear();
  while (true) {
    const std::size_t comma = text.find(',');
    parts.push_back(trimmed(text.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  if (parts.back().empty()) parts.pop_back();
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](unsigned char x, unsigned char y) {
           return std::tolower(x) == std::tolower(y);
         });
}

bool parse_integer(std::string_view text, long& value) {
  text = without_plus(text);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

bool parse_number(std::string_view text, double& value) {
  text = without_plus(text);
  if (parse_plain(text, value)) return true;
  std::array<char, 64> buffer{};
  return parse_plain(with_usual_exponent(text, buffer), value);
}

}  // namespace hersey::fem
