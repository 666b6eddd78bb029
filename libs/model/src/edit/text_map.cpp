#include "hersey/model/text_map.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <optional>
#include <utility>

#include "tree/source_tree.h"

namespace hersey::model {
namespace {

constexpr std::string_view kSpace = " \t";

/// The mark of UTF-8 that some editors write first, which is no part of line 1 for the parser either.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::vector<std::size_t> starts_of_lines(const std::string& text) {
  std::vector<std::size_t> lines{text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0};
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') lines.push_back(i + 1);
  return lines;
}

/// Behind the quoted text that begins at `at`.
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

bool is_alphanumeric(char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9'); }

bool begins_comment(std::string_view text, std::size_t at) {
  return text[at] == '#' && (at == 0 || kSpace.find(text[at - 1]) != std::string_view::npos || text[at - 1] == '\n');
}

/// A quote opens a quoted scalar only where a scalar begins.
bool opens_quotes(std::string_view text, std::size_t at) {
  if (text[at] != '"' && text[at] != '\'') return false;
  return at == 0 || std::string_view(" \t\n[{,:").find(text[at - 1]) != std::string_view::npos;
}

/// Behind the bracket that closes the one at `at`.
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

/// Behind a plain scalar, which may go on in lines that are indented deeper than `column`, counted from 0.
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

/// Behind a block scalar, `|` or `>`, in a mapping whose keys stand in `column`, counted from 0.
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

TextEntry::Kind kind_of(const Node& node) {
  switch (node.kind) {
    case Node::Kind::scalar:
      return TextEntry::Kind::scalar;
    case Node::Kind::sequence:
      return TextEntry::Kind::list;
    case Node::Kind::mapping:
      return TextEntry::Kind::mapping;
    case Node::Kind::null:
      break;
  }
  return TextEntry::Kind::nothing;
}

/// Behind the colon of a key that ends at `at`; there itself for a key without one, as in {a, b}.
std::size_t behind_colon(std::string_view text, std::size_t at) {
  const std::size_t colon = std::min(text.find_first_not_of(kSpace, at), text.size());
  return colon < text.size() && text[colon] == ':' ? colon + 1 : at;
}

std::string path_to(const std::string& parent, const std::string& key) {
  return parent.empty() ? key : parent + "." + key;
}

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t dot = std::min(path.find('.', from), path.size());
    parts.push_back(path.substr(from, dot - from));
    from = dot + 1;
  }
  return parts;
}

/// The value of `text`, a piece of YAML in one line; none if it is not one, or holds a comment.
std::optional<Node> one_value(const std::string& text) {
  if (text.find_first_of("\n\r") != std::string::npos) return std::nullopt;
  std::vector<Fault> faults;
  std::optional<Node> node = parse_yaml("value: " + text + "\n", "", faults);
  if (!node || !faults.empty() || node->entries.size() != 1) return std::nullopt;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (begins_comment(text, i)) return std::nullopt;
  return std::move(node->entries.front().value);
}

/// Whether a key may be written as it is, in blocks and in braces.
bool is_plain_key(const std::string& key) {
  const auto is_letter = [](char c) {
    return is_alphanumeric(c) || c == '_' || c == '-' || static_cast<unsigned char>(c) >= 0x80U;
  };
  if (key.empty() || !std::all_of(key.begin(), key.end(), is_letter)) return false;
  const std::optional<Node> within = one_value("{" + key + ": 1}");  // `null` is no name
  return within && within->entries.size() == 1 && within->entries.front().key == key;
}

bool is_same(const Node& a, const Node& b) {
  if (a.kind != b.kind || a.text != b.text || a.items.size() != b.items.size() || a.entries.size() != b.entries.size())
    return false;
  for (std::size_t i = 0; i < a.items.size(); ++i)
    if (!is_same(a.items[i], b.items[i])) return false;
  for (std::size_t i = 0; i < a.entries.size(); ++i)
    if (a.entries[i].key != b.entries[i].key || !is_same(a.entries[i].value, b.entries[i].value)) return false;
  return true;
}

/// Text that reads as `value` within brackets too: in quotes where it has to be.
std::string fit_for_flow(const std::string& value) {
  const std::optional<Node> plain = one_value(value);
  if (value.find_first_not_of(kSpace) == std::string::npos) return "null";
  const std::optional<Node> within = one_value("[" + value + "]");
  if (plain && within && within->items.size() == 1 && is_same(*plain, within->items.front())) return value;
  std::string quoted = "\"";
  for (const char c : plain ? plain->text : value) quoted += (c == '"' || c == '\\' ? "\\" : "") + std::string(1, c);
  return quoted + "\"";
}

}  // namespace

/// Walks the tree beside the text.
struct TextMap::Scan {
  TextMap& map;

  [[nodiscard]] std::string_view text() const { return map.text_; }
  [[nodiscard]] std::size_t offset(const SourcePosition& at) const { return map.offset(at.line, at.column); }

  /// First character of the value behind anchors and tags.
  [[nodiscard]] std::size_t behind_properties(std::size_t at) const {
    while (at < text().size() && (text()[at] == '&' || text()[at] == '!')) {
      at = std::min(text().find_first_of(" \t\r\n", at), text().size());
      at = std::min(text().find_first_not_of(" \t\r\n", at), text().size());
    }
    return at;
  }

  /// Behind the scalar at `at`. @param column  of its key, from 0
  [[nodiscard]] std::size_t behind_scalar(std::size_t at, std::size_t column, bool is_in_flow) const {
    at = behind_properties(at);
    if (at >= text().size()) return at;
    if (text()[at] == '"' || text()[at] == '\'') return behind_quotes(text(), at);
    if (!is_in_flow && (text()[at] == '|' || text()[at] == '>')) return behind_block(text(), at, column);
    return behind_plain(text(), at, column, is_in_flow);
  }

  /// The first character behind `at` that is neither blank nor of a comment, on this line or a later one.
  [[nodiscard]] std::size_t next_of_text(std::size_t at) const {
    for (; at < text().size(); ++at) {
      if (begins_comment(text(), at)) at = end_of_line(text(), at);
      if (at >= text().size() || std::string_view(" \t\r\n").find(text()[at]) == std::string_view::npos) break;
    }
    return std::min(at, text().size());
  }

  /// Behind the name of an alias.
  [[nodiscard]] std::size_t behind_alias(std::size_t at) const {
    return std::min(text().find_first_of(" \t\r\n,]}", at), text().size());
  }

  /// Notes the merge key of a mapping, if that is what comes next behind `from`. @param column  of the keys, from 0, of
  /// a block; npos within braces. @returns behind it; `from` where there is none
  std::size_t visit_merge(std::size_t index, std::size_t from, std::size_t column) {
    std::size_t at = next_of_text(from);
    const bool is_flow = column == std::string::npos;
    while (is_flow && at < text().size() && (text()[at] == ',' || text()[at] == '{')) at = next_of_text(at + 1);
    if (!text().substr(at).starts_with("<<") || (!is_flow && column_of_key(at) != column)) return from;
    const std::size_t colon = behind_colon(text(), at + 2);
    const std::size_t value = next_of_text(colon);
    if (colon == at + 2 || value >= text().size()) return from;
    const bool is_bracket = text()[value] == '[' || text()[value] == '{';
    const std::size_t end = is_bracket ? behind_brackets(text(), value) : behind_alias(value);
    map.merges_[index] = {at, end};
    return end;
  }

  /// Describes a value that begins at `begin`. @returns behind it
  std::size_t visit_value(std::size_t index, const Node& node, std::size_t begin, std::size_t column, bool is_in_flow) {
    const std::size_t first = behind_properties(begin);
    std::size_t end = begin;
    bool is_flow = is_in_flow;
    if (node.kind == Node::Kind::scalar) {
      end = behind_scalar(begin, column, is_in_flow);
    } else if (node.kind != Node::Kind::null) {
      const bool has_brackets = first < text().size() && (text()[first] == '{' || text()[first] == '[');
      is_flow = is_in_flow || has_brackets;  // `a: 1` in a list in brackets is a mapping without any
      end = has_brackets ? behind_brackets(text(), first) : begin;
      end = std::max(end, visit_children(index, node, is_flow));
    }
    TextEntry& entry = map.entries_[index];
    entry.kind = kind_of(node);
    entry.is_flow = is_flow;
    entry.value_at = map.extent(begin, end);
    return end;
  }

  std::size_t visit_children(std::size_t index, const Node& node, bool is_flow) {
    std::size_t end = 0;
    const std::string path = map.entries_[index].path;
    const std::size_t first = behind_properties(map.offset_of_value_[index]);
    std::size_t from = first;  // a child stands behind the one before it, or it is not written here
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      from = visit_item(add(index, path, std::to_string(i)), node.items[i], from, is_flow);
      end = std::max(end, from);
    }
    const std::size_t column = is_flow ? std::string::npos : column_of_key(std::min(first, text().size()));
    if (node.kind == Node::Kind::mapping) from = visit_merge(index, from, column);
    for (const Entry& entry : node.entries) {
      const std::size_t at = offset(entry.position);
      if (at < from || at < map.offset_of_value_[index]) continue;  // by a merge key
      from = visit_entry(index, path, entry, at, is_flow);
      if (!map.merges_.contains(index)) from = visit_merge(index, from, column);
    }
    return node.kind == Node::Kind::mapping ? std::max(end, from) : end;
  }

  /// Behind the dash, or the comma or bracket, after which an item stands; npos where there is none.
  [[nodiscard]] std::size_t place_of_item(std::size_t from, bool is_flow) const {
    const std::size_t at = next_of_text(from);
    const std::string_view marks = is_flow ? ",[" : "-";
    return at < text().size() && marks.find(text()[at]) != std::string_view::npos ? at + 1 : std::string::npos;
  }

  /// Where the text of a value begins that is nothing, or an alias, behind `place`; npos where it has no text.
  /// @param column  of its key or dash, from 0
  [[nodiscard]] std::size_t text_of_nothing(std::size_t place, std::size_t column, bool is_flow) const {
    const std::size_t at = next_of_text(place);
    if (at >= text().size()) return std::string::npos;
    const bool is_its = is_flow ? std::string_view(",]}").find(text()[at]) == std::string_view::npos
                                : at < end_of_line(text(), place) || column_of_key(at) > column;
    return is_its ? at : std::string::npos;
  }

  /// Describes an alias, or a value that is nothing. @param place  behind its colon, dash or comma. @returns behind it
  std::size_t visit_nothing(std::size_t child, const Node& node, std::size_t place, std::size_t column, bool is_flow) {
    const std::size_t at = text_of_nothing(place, column, is_flow);
    TextEntry& entry = map.entries_[child];
    entry.is_alias = at != std::string::npos && text()[at] == '*';
    entry.kind = kind_of(node);
    entry.is_flow = is_flow;
    const std::size_t end = at == std::string::npos ? place
                            : entry.is_alias        ? behind_alias(at)
                                                    : behind_plain(text(), at, column, is_flow);  // null or ~
    entry.value_at = map.extent(end == place ? place : at, end);
    return end;
  }

  std::size_t visit_item(std::size_t child, const Node& item, std::size_t from, bool is_flow) {
    const std::size_t place = place_of_item(from, is_flow);
    TextEntry& entry = map.entries_[child];
    if (place == std::string::npos) {
      entry.is_alias = true;  // it cannot be found: neither can what it has
      return from;
    }
    map.offset_of_mark_[child] = place - 1;
    const std::size_t column = column_of_key(place - 1), begin = offset(item.position), next = next_of_text(place);
    map.offset_of_value_[child] = next;
    const bool is_here = item.kind != Node::Kind::null && begin >= place && text()[next] != '*';
    const std::size_t end = is_here ? visit_value(child, item, std::min(next, begin), column, is_flow)
                                    : visit_nothing(child, item, place, column, is_flow);
    map.entries_[child].key_at = map.entries_[child].value_at;
    return end;
  }

  std::size_t visit_entry(std::size_t index, const std::string& path, const Entry& entry, std::size_t at,
                          bool is_flow) {
    const std::size_t child = add(index, path, entry.key);
    const std::size_t first = behind_properties(at);
    const bool is_quoted = first < text().size() && (text()[first] == '"' || text()[first] == '\'');
    const std::size_t key_end = is_quoted ? behind_quotes(text(), first) : first + entry.key.size();
    const std::size_t colon = behind_colon(text(), key_end);
    map.entries_[child].key_at = map.extent(at, key_end);
    map.offset_of_value_[child] = colon;
    const std::size_t begin = offset(entry.value.position), column = column_of_key(at), next = next_of_text(colon);
    const bool is_alias = entry.value.kind != Node::Kind::null && next < text().size() && text()[next] == '*';
    if (is_alias || entry.value.kind == Node::Kind::null || begin < colon)
      return visit_nothing(child, entry.value, colon, column, is_flow);
    // A value with an anchor begins at the anchor where that stands behind the colon.
    const std::size_t own = std::min(next, begin);
    map.offset_of_value_[child] = own;
    return visit_value(child, entry.value, own, column, is_flow);
  }

  [[nodiscard]] std::size_t column_of_key(std::size_t at) const {
    return static_cast<std::size_t>(map.extent(at, at).column - 1);
  }

  std::size_t add(std::size_t parent, const std::string& path, const std::string& key) {
    const std::size_t index = map.entries_.size();
    TextEntry entry;
    entry.path = path_to(path, key);
    entry.key = key;
    entry.parent = parent;
    map.entries_.push_back(std::move(entry));
    map.offset_of_value_.push_back(0);
    map.offset_of_mark_.push_back(std::string::npos);
    map.entries_[parent].children.push_back(index);
    return index;
  }
};

namespace {

Node tree_of(const std::string& text, const std::string& file) {
  std::vector<Fault> faults;
  std::optional<Node> root = parse_yaml(text, file, faults);
  if (!root) throw InputError(std::move(faults));
  return std::move(*root);
}

}  // namespace

TextMap::TextMap(const std::string& text, const std::string& file) : TextMap(text, file, tree_of(text, file)) {}

TextMap::TextMap(std::string text, std::string file, const Node& root)
    : text_(std::move(text)), file_(std::move(file)), lines_(starts_of_lines(text_)) {
  entries_.emplace_back();
  offset_of_value_.push_back(0);
  offset_of_mark_.push_back(std::string::npos);
  if (root.kind == Node::Kind::null) {
    entries_.front().value_at = extent(text_.size(), text_.size());
    entries_.front().kind = TextEntry::Kind::mapping;
  } else {
    const std::size_t begin = offset(root.position.line, root.position.column);
    offset_of_value_.front() = begin;
    Scan{*this}.visit_value(0, root, begin, 0, false);
  }
  for (std::size_t i = 1; i < entries_.size(); ++i) {
    if (entries_[i].value_at.line == 0) continue;
    by_key_.try_emplace({entries_[i].key_at.line, entries_[i].key_at.column}, i);
    by_value_.try_emplace({entries_[i].value_at.line, entries_[i].value_at.column}, i);
  }
}

std::size_t TextMap::offset(int line, int column) const {
  if (line < 1) return lines_.front();
  const auto index = static_cast<std::size_t>(line - 1);
  if (index >= lines_.size()) return text_.size();
  return std::min(lines_[index] + static_cast<std::size_t>(std::max(column, 1) - 1), end_of_line(text_, lines_[index]));
}

TextExtent TextMap::extent(std::size_t begin, std::size_t end) const {
  const auto place = [&](std::size_t offset) {
    const std::size_t at = std::max(offset, lines_.front());
    const auto line = std::upper_bound(lines_.begin(), lines_.end(), at) - 1;
    return std::pair(static_cast<int>(line - lines_.begin()) + 1, static_cast<int>(at - *line) + 1);
  };
  const auto [line, column] = place(begin);
  const auto [end_line, end_column] = place(std::max(begin, end));
  return {line, column, end_line, end_column};
}

const TextEntry* TextMap::find(std::string_view path) const {
  std::size_t index = 0;
  for (std::size_t from = 0; from < path.size();) {
    const std::size_t dot = std::min(path.find('.', from), path.size());
    const std::string_view key = path.substr(from, dot - from);
    const auto& children = entries_[index].children;
    const auto child =
        std::find_if(children.begin(), children.end(), [&](std::size_t i) { return entries_[i].key == key; });
    if (child == children.end()) return nullptr;
    index = *child;
    from = dot + 1;
  }
  return &entries_[index];
}

const TextEntry* TextMap::at(int line, int column) const {
  for (const auto* entries : {&by_key_, &by_value_})
    if (const auto found = entries->find({line, column}); found != entries->end()) return &entries_[found->second];
  return nullptr;
}

TextExtent TextMap::word_at(int line, int column) const {
  const std::size_t begin = offset(line, column);
  if (const TextEntry* entry = at(line, column)) {
    const bool is_key = entry->key_at.line == line && entry->key_at.column == column;
    const TextExtent& all = is_key ? entry->key_at : entry->value_at;
    const bool is_one_line = all.line == all.end_line && all.end_column > all.column;
    if (is_one_line) return all;
  }
  std::size_t end = begin;
  while (end < text_.size() && std::string_view(" \t\r\n,:[]{}\"'").find(text_[end]) == std::string_view::npos) ++end;
  if (end == begin && end < end_of_line(text_, begin)) ++end;
  return extent(begin, end);
}

Fault TextMap::fault(const TextEntry& at, const std::string& path, std::string found, std::string expected) const {
  return {{file_, at.key_at.line, at.key_at.column}, path, std::move(found), std::move(expected), ""};
}

// Column, from 1, in which the keys or dashes of a block stand, or would.
int TextMap::column_of_children(const TextEntry& entry) const {
  const std::vector<Piece> pieces = pieces_of(entry);
  if (!pieces.empty()) return extent(pieces.front().first, pieces.front().first).column;
  if (&entry == &entries_.front()) return 1;
  // Steps of the first block in the file.
  int step = 2;
  for (const TextEntry& one : entries_) {
    if (one.parent != 0 || one.path.empty() || one.kind != TextEntry::Kind::mapping || one.is_flow ||
        one.children.empty())
      continue;
    step = std::max(1, entries_[one.children.front()].key_at.column - one.key_at.column);
    break;
  }
  return entry.key_at.column + step;
}

std::size_t TextMap::end_of_content(const TextEntry& entry) const {
  return offset(entry.value_at.end_line, entry.value_at.end_column);
}

std::size_t TextMap::index_of(const TextEntry& entry) const {
  return static_cast<std::size_t>(&entry - entries_.data());
}

// The children of a mapping or list as they stand in the text, those of a block list from their dashes, and the merge
// key of a mapping.
std::vector<TextMap::Piece> TextMap::pieces_of(const TextEntry& entry) const {
  std::vector<Piece> pieces;
  const bool has_dashes = entry.kind == TextEntry::Kind::list && !entry.is_flow;
  for (const std::size_t child : entry.children) {
    const TextEntry& part = entries_[child];
    pieces.emplace_back(has_dashes ? offset_of_mark_[child] : offset(part.key_at.line, part.key_at.column),
                        end_of_content(part));
  }
  if (const auto merge = merges_.find(index_of(entry)); merge != merges_.end()) pieces.push_back(merge->second);
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

// The words before a value that name it for aliases, with a blank behind.
std::string TextMap::anchor_of(const TextEntry& entry) const {
  std::string anchor;
  const std::size_t end = end_of_content(entry);
  for (std::size_t at = offset(entry.value_at.line, entry.value_at.column);
       at < end && (text_[at] == '&' || text_[at] == '!');) {
    const std::size_t behind = std::min(text_.find_first_of(" \t\r\n,]}", at), end);
    if (text_[at] == '&') anchor += text_.substr(at, behind - at) + " ";
    at = std::min(text_.find_first_not_of(" \t\r\n", behind), end);
  }
  return anchor;
}

void TextMap::require_found(const TextEntry& entry, const std::string& path) const {
  const TextEntry& parent = entries_[entry.parent];
  const bool is_lost = std::any_of(parent.children.begin(), parent.children.end(),
                                   [&](std::size_t child) { return entries_[child].value_at.line == 0; });
  if (is_lost) throw InputError(fault(parent, path, "an item whose place is not known", "a list in its usual form"));
}

// Gives an entry the value `text`.
TextEdit TextMap::replacement(const TextEntry& entry, const std::string& text) const {
  const std::size_t begin = offset(entry.value_at.line, entry.value_at.column), end = end_of_content(entry);
  const TextEntry& parent = entries_[entry.parent];
  const std::string whole = anchor_of(entry) + text;
  if (parent.kind == TextEntry::Kind::list) {
    const bool is_behind_mark = begin == offset_of_mark_[index_of(entry)] + 1 && begin == end;
    return {entry.value_at, (is_behind_mark ? " " : "") + whole};
  }
  const std::size_t behind_key = behind_colon(text_, offset(entry.key_at.end_line, entry.key_at.end_column));
  const bool is_block = (entry.kind == TextEntry::Kind::list || entry.kind == TextEntry::Kind::mapping) &&
                        !entry.is_flow && !entry.is_alias;
  if (begin > behind_key && !is_block) return {entry.value_at, whole};
  const std::string colon = text_[behind_key - 1] == ':' ? "" : ":";
  return {extent(behind_key, end), colon + " " + whole};
}

// The edit alone, unless it takes away an anchor that the text behind it names.
std::vector<TextEdit> TextMap::with_anchors(const std::string& path, TextEdit edit) const {
  const std::size_t begin = offset(edit.at.line, edit.at.column), end = offset(edit.at.end_line, edit.at.end_column);
  for (std::size_t at = text_.find('&', begin); at < end; at = text_.find('&', at + 1)) {
    const std::string name = text_.substr(at + 1, std::min(text_.find_first_of(" \t\r\n,]}", at), end) - at - 1);
    const bool begins = at == 0 || std::string_view(" \t\n[{,:-").find(text_[at - 1]) != std::string_view::npos;
    const bool stays = (edit.text + " ").find("&" + name + " ") != std::string::npos;
    if (begins && !stays && !name.empty() && text_.find("*" + name, end) != std::string::npos)
      throw InputError(fault(entries_.front(), path, "the anchor '&" + name + "', which aliases name",
                             "a value without it: change the aliases first"));
  }
  return {std::move(edit)};
}

// The key `key` behind all others of `into`, or the item behind all others of a list.
TextEdit TextMap::insertion(const TextEntry& into, const std::string& key, const std::string& value) const {
  const bool is_list = into.kind == TextEntry::Kind::list;
  const std::size_t end = end_of_content(into);
  const std::vector<Piece> pieces = pieces_of(into);
  if (into.is_flow) {
    const std::size_t closing = end - 1;
    if (text_[closing] != ']' && text_[closing] != '}')
      throw InputError(fault(into, into.path, "a mapping without braces in a list", "braces around it"));
    const std::string piece = is_list ? fit_for_flow(value) : key + ": " + fit_for_flow(value);
    if (pieces.empty()) return {extent(closing, closing), piece};
    const std::size_t behind = pieces.back().second;
    return {extent(behind, behind), ", " + piece};
  }
  const std::string indent(static_cast<std::size_t>(column_of_children(into) - 1), ' ');
  const std::string line = indent + (is_list ? "- " : key + ": ") + value;
  const std::size_t line_end = end_of_line(text_, end);
  if (text_.empty() || (line_end == text_.size() && text_.back() == '\n' && end == text_.size()))
    return {extent(text_.size(), text_.size()), line + "\n"};
  const bool has_return = line_end > 0 && text_[line_end - 1] == '\r';
  const std::size_t at = has_return ? line_end - 1 : line_end;
  return {extent(at, at), (has_return ? "\r\n" : "\n") + line};
}

std::vector<TextEdit> TextMap::set(const std::string& path, const std::string& value) const {
  if (!one_value(value))
    throw InputError(fault(entries_.front(), path, "'" + value + "'", "a value of YAML in one line"));
  const std::vector<std::string> keys = parts_of(path);
  const TextEntry* entry = &entries_.front();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (entry->is_alias)
      throw InputError(fault(*entry, path, "an alias for '" + entry->path + "'",
                             "a value that stands here: change it where its anchor is"));
    const auto child = std::find_if(entry->children.begin(), entry->children.end(),
                                    [&](std::size_t k) { return entries_[k].key == keys[i]; });
    if (child != entry->children.end()) {
      entry = &entries_[*child];
      require_found(*entry, path);
      continue;
    }
    const bool is_list = entry->kind == TextEntry::Kind::list;
    if (entry->kind == TextEntry::Kind::scalar || (is_list && keys[i] != std::to_string(entry->children.size())))
      throw InputError(fault(*entry, path,
                             is_list ? "a list without item " + keys[i] : "no mapping for '" + keys[i] + "'",
                             is_list ? "an item, or the next one" : "a mapping with keys"));
    for (std::size_t k = is_list ? i + 1 : i; k < keys.size(); ++k)
      if (!is_plain_key(keys[k]))
        throw InputError(fault(*entry, path, "the new key '" + keys[k] + "'", "letters, digits, '_' and '-'"));
    if (is_list && !entry->children.empty()) require_found(entries_[entry->children.back()], path);
    std::string inner = value;
    for (std::size_t k = keys.size() - 1; k > i; --k) inner = "{" + keys[k] + ": " + fit_for_flow(inner) + "}";
    if (entry->kind != TextEntry::Kind::nothing) return {insertion(*entry, keys[i], inner)};
    return {replacement(*entry, "{" + keys[i] + ": " + fit_for_flow(inner) + "}")};  // `key:` with nothing behind it
  }
  if (entry == &entries_.front()) throw InputError(fault(*entry, path, "no key path", "such as simulation.duration"));
  return with_anchors(path, replacement(*entry, entries_[entry->parent].is_flow ? fit_for_flow(value) : value));
}

std::vector<TextEdit> TextMap::remove(const std::string& path) const {
  const TextEntry* entry = find(path);
  if (entry == nullptr || entry == &entries_.front())
    throw InputError(fault(entries_.front(), path, "no such key", "a key of the text"));
  require_found(*entry, path);
  return with_anchors(path, removal(*entry));
}

TextEdit TextMap::removal(const TextEntry& entry) const {
  const TextEntry& parent = entries_[entry.parent];
  const std::vector<Piece> pieces = pieces_of(parent);
  if (pieces.size() == 1 && entry.parent != 0)
    return replacement(parent, parent.kind == TextEntry::Kind::list ? "[]" : "{}");
  const bool has_dash = parent.kind == TextEntry::Kind::list && !parent.is_flow;
  std::size_t begin = has_dash ? offset_of_mark_[index_of(entry)] : offset(entry.key_at.line, entry.key_at.column);
  std::size_t end = end_of_content(entry);
  const auto self = std::find(pieces.begin(), pieces.end(), Piece{begin, end});
  const bool is_last = self == pieces.end() || self + 1 == pieces.end();
  if (parent.is_flow) {
    if (self != pieces.begin() && self != pieces.end())
      begin = (self - 1)->second;
    else if (!is_last)
      end = (self + 1)->first;
    return {extent(begin, end), ""};
  }
  // Whole lines, with a comment behind the value, where nothing else stands before.
  const std::size_t line = lines_[static_cast<std::size_t>(extent(begin, begin).line - 1)];
  if (text_.find_first_not_of(kSpace, line) == begin) {
    const std::size_t line_end = end_of_line(text_, end);
    return {extent(line, std::min(line_end + 1, text_.size())), ""};
  }
  // `- a: 1` of a mapping in a list: the next key takes its place.
  return {extent(begin, is_last ? end : (self + 1)->first), ""};
}

// What the text says besides the value at `path`, in its order: items without their numbers, which change where one is
// removed.
std::vector<std::string> TextMap::said_beside(const std::string& path, bool has_path) const {
  std::vector<std::string> said;
  const auto piece = [&](std::size_t begin, std::size_t end) { return text_.substr(begin, end - begin); };
  const std::string below = path + ".";
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const TextEntry& entry = entries_[i];
    const bool is_within = entry.path == path || entry.path.starts_with(below);
    if (const auto merge = merges_.find(i); merge != merges_.end() && !(has_path && is_within))
      said.push_back("<<" + piece(merge->second.first, merge->second.second));
    const bool is_around = i == 0 || below.starts_with(entry.path + ".");
    if (is_around && (entry.path != path || has_path)) continue;
    if (has_path && is_within) continue;
    const bool is_item = entries_[entry.parent].kind == TextEntry::Kind::list;
    const std::string value = entry.children.empty()
                                  ? piece(offset(entry.value_at.line, entry.value_at.column), end_of_content(entry))
                                  : anchor_of(entry);
    const auto depth = std::count(entry.path.begin(), entry.path.end(), '.');
    said.push_back(std::to_string(depth) + (is_item ? "-" : entry.key) + (entry.is_alias ? "*" : ":") + value);
  }
  return said;
}

void TextMap::require_nothing_else(const std::string& path, const std::vector<TextEdit>& edits, bool is_removed) const {
  const std::string changed = with_edits(text_, edits);
  std::vector<Fault> faults, faults_before;
  const std::optional<Node> root = parse_yaml(changed, file_, faults);
  if (root && !faults.empty()) (void)parse_yaml(text_, file_, faults_before);
  bool is_good = root.has_value() && faults.size() <= faults_before.size();
  if (is_good) {
    const TextMap after(changed, file_, *root);
    is_good =
        (is_removed || after.find(path) != nullptr) && said_beside(path, true) == after.said_beside(path, !is_removed);
  }
  if (is_good) return;
  throw InputError(fault(entries_.front(), path, "a text in which this key cannot be changed by itself",
                         "the usual form of YAML: change it by hand"));
}

std::string with_edits(const std::string& text, const std::vector<TextEdit>& edits) {
  const std::vector<std::size_t> lines = starts_of_lines(text);
  const auto offset = [&](int line, int column) {
    const auto index = static_cast<std::size_t>(std::max(line, 1) - 1);
    return index >= lines.size()
               ? text.size()
               : std::min(lines[index] + static_cast<std::size_t>(std::max(column, 1) - 1), text.size());
  };
  std::vector<std::size_t> order(edits.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return offset(edits[a].at.line, edits[a].at.column) < offset(edits[b].at.line, edits[b].at.column);
  });
  std::string result;
  std::size_t from = 0;
  for (const std::size_t i : order) {
    const TextExtent& at = edits[i].at;
    const std::size_t begin = std::max(from, offset(at.line, at.column));
    result.append(text, from, begin - from).append(edits[i].text);
    from = std::max(begin, offset(at.end_line, at.end_column));
  }
  return result.append(text, from, std::string::npos);
}

}  // namespace hersey::model
