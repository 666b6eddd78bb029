#include "mesh/nastran_cards.h"

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

// The tenth field (of large fields the sixth) names the continuation.
std::string_view continuation_mark(std::string_view line, bool is_large) {
  if (!is_free(line)) return line.size() > kDataEnd ? trimmed(line.substr(kDataEnd, kSmall)) : std::string_view();
  const int last = is_large ? 5 : 9;
  for (int field = 0; field < last; ++field) {
    const std::size_t comma = line.find(',');
    if (comma == std::string_view::npos) return {};
    line.remove_prefix(comma + 1);
  }
  return trimmed(line);
}

// "+A" and "*A" name the same continuation.
std::string_view without_sign(std::string_view mark) {
  if (!mark.empty() && (mark.front() == '+' || mark.front() == '*')) mark.remove_prefix(1);
  return trimmed(mark);
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

void NastranCards::add_line(std::string_view line, NastranCard& card) {
  const std::string_view first = first_field(line);
  const bool is_first = card.fields.empty();
  const bool is_large = is_first ? first.ends_with('*') : first.starts_with('*');
  const auto note = [&](const char* mistake) {
    if (card.mistake.empty()) card.mistake = mistake, card.line_of_mistake = lines_.number();
  };
  const std::string_view named = without_sign(mark_), own = is_first ? std::string_view() : without_sign(first);
  // The first letter of a name is replaced by the sign: "P51" and "+51" are the same.
  const bool is_the_one =
      equal_ignoring_case(named, own) || equal_ignoring_case(named.substr(std::min<std::size_t>(1, named.size())), own);
  if (!named.empty() && !own.empty() && !is_the_one) note("a continuation that is not the one its entry names");
  add_fields(line, is_large, card.fields);
  mark_ = continuation_mark(line, is_large);
  if (is_free(line) && mark_.find(',') != std::string_view::npos) {
    if (!trimmed(mark_.substr(mark_.find(',') + 1)).empty()) note("more fields than a line has");
    mark_ = trimmed(mark_.substr(0, mark_.find(',')));
  }
}

bool NastranCards::next(NastranCard& card) {
  expanded_.clear();
  card.fields.clear();
  card.mistake.clear();
  mark_ = {};
  bool is_written_so = replication_.repeat(card, expanded_);
  if (!is_written_so) {
    std::string_view line;
    if (!next_line(line)) return false;
    read(without_tabs(line), card);
    is_written_so = NastranReplication::is_written_so(card);
    if (is_written_so) replication_.replace(card, expanded_);
  }
  replication_.keep(card, is_written_so);
  return true;
}

void NastranCards::read(std::string_view line, NastranCard& card) {
  card.line = lines_.number();
  std::string_view name = first_field(line);
  add_line(line, card);
  while (name.ends_with('*')) name.remove_suffix(1);
  card.name.assign(trimmed(name));
  std::transform(card.name.begin(), card.name.end(), card.name.begin(),
                 [](unsigned char c) { return std::toupper(c); });
  while (next_line(line)) {
    line = without_tabs(line);
    if (!continues(line)) {
      lines_.back();
      break;
    }
    add_line(line, card);
  }
}

}  // namespace hersey::fem
