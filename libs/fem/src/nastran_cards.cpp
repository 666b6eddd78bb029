#include "nastran_cards.h"

#include <algorithm>
#include <cctype>

namespace hersey::fem {
namespace {

constexpr std::size_t kName = 8, kSmall = 8, kLarge = 16, kDataEnd = 72;

bool is_free(std::string_view line) { return line.find(',') != std::string_view::npos; }

std::string_view first_field(std::string_view line) {
  return trimmed(is_free(line) ? line.substr(0, line.find(',')) : line.substr(0, kName));
}

bool continues(std::string_view line) {
  const std::string_view first = first_field(line);
  return first.empty() || first.front() == '+' || first.front() == '*';
}

void add_columns(std::string_view line, bool is_large, std::vector<std::string_view>& fields) {
  const std::size_t width = is_large ? kLarge : kSmall;
  for (std::size_t column = kName; column < kDataEnd; column += width)
    fields.push_back(column < line.size() ? trimmed(line.substr(column, width)) : std::string_view());
}

// Missing fields at the end are empty; a ninth (large: fifth) names the continuation.
void add_free(std::string_view line, bool is_large, std::vector<std::string_view>& fields) {
  const std::size_t count = is_large ? 4 : 8;
  std::size_t comma = line.find(',');
  for (std::size_t k = 0; k < count; ++k) {
    if (comma == std::string_view::npos) {
      fields.emplace_back();
      continue;
    }
    const std::size_t end = line.find(',', comma + 1);
    fields.push_back(trimmed(line.substr(comma + 1, end == std::string_view::npos ? end : end - comma - 1)));
    comma = end;
  }
}

void add_fields(std::string_view line, bool is_large, std::vector<std::string_view>& fields) {
  is_free(line) ? add_free(line, is_large, fields) : add_columns(line, is_large, fields);
}

}  // namespace

bool NastranCards::next_line(std::string_view& line) {
  while (lines_.next(line)) {
    line = line.substr(0, line.find('$'));
    if (!trimmed(line).empty()) return true;
  }
  return false;
}

std::string_view NastranCards::without_tabs(std::string_view line) {
  if (line.find('\t') == std::string_view::npos) return line;
  std::string& text = expanded_.emplace_back();
  for (const char c : line) {
    if (c == '\t')
      text.append(kSmall - text.size() % kSmall, ' ');
    else
      text.push_back(c);
  }
  return text;
}

bool NastranCards::next(NastranCard& card) {
  expanded_.clear();
  card.fields.clear();
  std::string_view line;
  if (!next_line(line)) return false;
  line = without_tabs(line);
  card.line = lines_.number();
  std::string_view name = first_field(line);
  add_fields(line, name.ends_with('*'), card.fields);
  while (name.ends_with('*')) name.remove_suffix(1);
  card.name.assign(name);
  std::transform(card.name.begin(), card.name.end(), card.name.begin(),
                 [](unsigned char c) { return std::toupper(c); });
  while (next_line(line)) {
    line = without_tabs(line);
    if (!continues(line)) {
      lines_.back();
      break;
    }
    add_fields(line, first_field(line).starts_with('*'), card.fields);
  }
  return true;
}

}  // namespace hersey::fem
