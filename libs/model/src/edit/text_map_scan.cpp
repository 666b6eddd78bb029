#include <algorithm>
#include <optional>
#include <utility>

#include "edit/yaml_marks.h"
#include "hersey/model/text_map.h"
#include "tree/source_tree.h"

namespace hersey::model {
namespace {

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

std::string path_to(const std::string& parent, const std::string& key) {
  return parent.empty() ? key : parent + "." + key;
}

Node tree_of(const std::string& text, const std::string& file) {
  std::vector<Fault> faults;
  std::optional<Node> root = parse_yaml(text, file, faults);
  if (!root) throw InputError(std::move(faults));
  return std::move(*root);
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
    by_key_.push_back({{entries_[i].key_at.line, entries_[i].key_at.column}, i});
    by_value_.push_back({{entries_[i].value_at.line, entries_[i].value_at.column}, i});
  }
  std::sort(by_key_.begin(), by_key_.end());
  std::sort(by_value_.begin(), by_value_.end());
}

}  // namespace hersey::model
