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

std::vector<std::size_t> starts_of_lines(const std::string& text) {
  std::vector<std::size_t> lines{0};
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
  for (std::size_t line = end + 1; line < text.size();) {
    const std::size_t stop = end_of_line(text, line);
    const bool is_empty = without_trailing_space(text, line, stop) == line;
    if (!is_empty && indentation(text, line) <= column) break;
    if (!is_empty) end = stop;
    line = stop + 1;
  }
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
  for (std::size_t i = 1; i < text.size(); ++i)
    if (begins_comment(text, i)) return std::nullopt;
  return std::move(node->entries.front().value);
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

  /// The first character behind `at` that is no space, on the same line; npos where there is none.
  [[nodiscard]] std::size_t next_on_line(std::size_t at) const {
    const std::size_t next = text().find_first_not_of(kSpace, at);
    const bool is_none = next == std::string_view::npos || text()[next] == '\n' || text()[next] == '\r' ||
                         (text()[next] == '#' && next > at);
    return is_none ? std::string_view::npos : next;
  }

  /// Describes a value that begins at `begin`. @returns behind it
  std::size_t visit_value(std::size_t index, const Node& node, std::size_t begin, std::size_t column, bool is_in_flow) {
    const std::size_t first = behind_properties(begin);
    std::size_t end = begin;
    bool is_flow = is_in_flow;
    if (node.kind == Node::Kind::scalar) {
      end = behind_scalar(begin, column, is_in_flow);
    } else if (node.kind != Node::Kind::null) {
      is_flow = first < text().size() && (text()[first] == '{' || text()[first] == '[');
      end = is_flow ? behind_brackets(text(), first) : begin;
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
    std::size_t from = 0;  // a child stands behind the one before it, or it is not written here
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const Node& item = node.items[i];
      const std::size_t begin = offset(item.position);
      const std::size_t child = add(index, path, std::to_string(i));
      const bool is_here = begin >= from && item.position.line > 0 && item.kind != Node::Kind::null &&
                           begin >= map.offset_of_value_[index];
      map.offset_of_value_[child] = begin;
      if (!is_here) {
        map.entries_[child].is_alias = true;
        map.entries_[child].value_at = map.entries_[child].key_at = map.extent(from, from);
        continue;
      }
      const std::size_t behind = visit_value(child, item, begin, column_of_item(begin), is_flow);
      map.entries_[child].key_at = map.entries_[child].value_at;
      end = std::max(end, behind);
      from = behind;
    }
    for (const Entry& entry : node.entries) {
      const std::size_t at = offset(entry.position);
      if (at < from || at < map.offset_of_value_[index]) continue;  // by a merge key
      const std::size_t behind = visit_entry(index, path, entry, at, is_flow);
      end = std::max(end, behind);
      from = behind;
    }
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
    const std::size_t begin = offset(entry.value.position);
    const std::size_t next = next_on_line(colon);
    if (next != std::string_view::npos && text()[next] == '*') {
      const std::size_t end = std::min(text().find_first_of(" \t\r\n,]}", next), text().size());
      TextEntry& alias = map.entries_[child];
      alias.is_alias = true;
      alias.kind = kind_of(entry.value);
      alias.value_at = map.extent(next, end);
      return end;
    }
    if (entry.value.kind == Node::Kind::null || begin < colon) {
      const std::size_t end =
          next == std::string_view::npos || std::string_view(",}]").find(text()[next]) != std::string_view::npos
              ? colon
              : behind_plain(text(), next, 0, true);  // null or ~
      map.entries_[child].value_at = map.extent(end == colon ? colon : next, end);
      map.entries_[child].is_flow = is_flow;
      return end;
    }
    // A value with an anchor begins at the anchor where that stands behind the colon.
    const std::size_t own = next != std::string_view::npos && next < begin ? next : begin;
    return visit_value(child, entry.value, own, column_of_key(at), is_flow);
  }

  [[nodiscard]] std::size_t column_of_key(std::size_t at) const {
    return static_cast<std::size_t>(map.extent(at, at).column - 1);
  }

  /// Column of the dash before an item; that of the item where there is none on its line.
  [[nodiscard]] std::size_t column_of_item(std::size_t at) const {
    std::size_t dash = at;
    while (dash > 0 && kSpace.find(text()[dash - 1]) != std::string_view::npos) --dash;
    return column_of_key(dash > 0 && text()[dash - 1] == '-' ? dash - 1 : at);
  }

  std::size_t add(std::size_t parent, const std::string& path, const std::string& key) {
    const std::size_t index = map.entries_.size();
    TextEntry entry;
    entry.path = path_to(path, key);
    entry.key = key;
    entry.parent = parent;
    map.entries_.push_back(std::move(entry));
    map.offset_of_value_.push_back(0);
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

TextMap::TextMap(std::string text, std::string file) : TextMap(text, file, tree_of(text, file)) {}

TextMap::TextMap(std::string text, std::string file, const Node& root)
    : text_(std::move(text)), file_(std::move(file)), lines_(starts_of_lines(text_)) {
  entries_.emplace_back();
  offset_of_value_.push_back(0);
  if (root.kind == Node::Kind::null) {
    entries_.front().value_at = extent(text_.size(), text_.size());
    entries_.front().kind = TextEntry::Kind::mapping;
  } else {
    Scan{*this}.visit_value(0, root, offset(root.position.line, root.position.column), 0, false);
  }
  for (std::size_t i = 1; i < entries_.size(); ++i) {
    by_key_.try_emplace({entries_[i].key_at.line, entries_[i].key_at.column}, i);
    by_value_.try_emplace({entries_[i].value_at.line, entries_[i].value_at.column}, i);
  }
}

std::size_t TextMap::offset(int line, int column) const {
  if (line < 1) return 0;
  const auto index = static_cast<std::size_t>(line - 1);
  if (index >= lines_.size()) return text_.size();
  return std::min(lines_[index] + static_cast<std::size_t>(std::max(column, 1) - 1), end_of_line(text_, lines_[index]));
}

TextExtent TextMap::extent(std::size_t begin, std::size_t end) const {
  const auto place = [&](std::size_t at) {
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
  if (&entry == &entries_.front()) return entry.children.empty() ? 1 : entries_[entry.children.front()].key_at.column;
  for (const std::size_t child : entry.children) {
    const TextExtent& key = entries_[child].key_at;
    if (entry.kind == TextEntry::Kind::mapping) return key.column;
    std::size_t dash = offset(key.line, key.column);
    while (dash > 0 && text_[dash] != '-' && text_[dash] != '\n') --dash;
    if (text_[dash] == '-') return extent(dash, dash).column;
  }
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

// The key `key` behind all others of `into`, or the item behind all others of a list.
TextEdit TextMap::insertion(const TextEntry& into, const std::string& key, const std::string& value) const {
  const bool is_list = into.kind == TextEntry::Kind::list;
  const std::size_t end = end_of_content(into);
  if (into.is_flow) {
    const std::size_t closing = end - 1;
    const std::string piece = is_list ? fit_for_flow(value) : key + ": " + fit_for_flow(value);
    if (into.children.empty()) return {extent(closing, closing), piece};
    const std::size_t behind = end_of_content(entries_[into.children.back()]);
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
      continue;
    }
    const bool is_list = entry->kind == TextEntry::Kind::list;
    if (entry->kind == TextEntry::Kind::scalar || (is_list && keys[i] != std::to_string(entry->children.size())))
      throw InputError(fault(*entry, path,
                             is_list ? "a list without item " + keys[i] : "no mapping for '" + keys[i] + "'",
                             is_list ? "an item, or the next one" : "a mapping with keys"));
    std::string inner = value;
    for (std::size_t k = keys.size() - 1; k > i; --k) inner = "{" + keys[k] + ": " + fit_for_flow(inner) + "}";
    if (entry->kind != TextEntry::Kind::nothing) return {insertion(*entry, keys[i], inner)};
    // `key:` with nothing behind it
    const std::string all = "{" + keys[i] + ": " + fit_for_flow(inner) + "}";
    const std::size_t behind = offset(entry->value_at.line, entry->value_at.column);
    return {{entry->value_at, (behind > 0 && text_[behind - 1] == ':' ? " " : ": ") + all}};
  }
  if (entry == &entries_.front()) throw InputError(fault(*entry, path, "no key path", "such as simulation.duration"));
  const TextEntry& parent = entries_[entry->parent];
  const std::string text = parent.is_flow ? fit_for_flow(value) : value;
  const std::size_t begin = offset(entry->value_at.line, entry->value_at.column);
  const bool is_item = parent.kind == TextEntry::Kind::list;
  const std::size_t behind_key =
      is_item ? begin : behind_colon(text_, offset(entry->key_at.end_line, entry->key_at.end_column));
  const bool is_block = (entry->kind == TextEntry::Kind::list || entry->kind == TextEntry::Kind::mapping) &&
                        !entry->is_flow && !entry->is_alias;
  const bool is_there = begin > behind_key && !is_block;
  if (is_item || is_there) return {{entry->value_at, text}};
  const std::string colon = text_[behind_key - 1] == ':' ? "" : ":";
  return {{extent(behind_key, end_of_content(*entry)), colon + " " + text}};
}

std::vector<TextEdit> TextMap::remove(const std::string& path) const {
  const TextEntry* entry = find(path);
  if (entry == nullptr || entry == &entries_.front())
    throw InputError(fault(entries_.front(), path, "no such key", "a key of the text"));
  const TextEntry& parent = entries_[entry->parent];
  const bool is_item = parent.kind == TextEntry::Kind::list;
  std::size_t begin = offset(entry->key_at.line, entry->key_at.column), end = end_of_content(*entry);
  if (parent.children.size() == 1 && entry->parent != 0) {
    const std::size_t first = offset(parent.value_at.line, parent.value_at.column);
    const std::size_t colon = behind_colon(text_, offset(parent.key_at.end_line, parent.key_at.end_column));
    const bool is_behind_key = entries_[parent.parent].kind == TextEntry::Kind::mapping && !parent.is_flow;
    return {{extent(is_behind_key ? colon : first, end_of_content(parent)),
             (is_behind_key ? " " : "") + std::string(is_item ? "[]" : "{}")}};
  }
  if (parent.is_flow) {
    const auto self = std::find_if(parent.children.begin(), parent.children.end(),
                                   [&](std::size_t k) { return &entries_[k] == entry; });
    if (self != parent.children.begin()) {
      begin = end_of_content(entries_[*(self - 1)]);
    } else {
      const TextEntry& next = entries_[*(self + 1)];
      end = offset(next.key_at.line, next.key_at.column);
    }
    return {{extent(begin, end), ""}};
  }
  if (is_item) {
    while (begin > 0 && text_[begin] != '-') --begin;
  }
  // Whole lines, with a comment behind the value, where nothing else stands before.
  const std::size_t line = lines_[static_cast<std::size_t>(extent(begin, begin).line - 1)];
  if (text_.find_first_not_of(kSpace, line) == begin) {
    const std::size_t line_end = end_of_line(text_, end);
    return {{extent(line, std::min(line_end + 1, text_.size())), ""}};
  }
  // `- a: 1` of a mapping in a list: the next key takes its place.
  const auto self = std::find_if(parent.children.begin(), parent.children.end(),
                                 [&](std::size_t k) { return &entries_[k] == entry; });
  if (self + 1 == parent.children.end()) return {{extent(begin, end), ""}};
  const TextEntry& next = entries_[*(self + 1)];
  return {{extent(begin, offset(next.key_at.line, next.key_at.column)), ""}};
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
