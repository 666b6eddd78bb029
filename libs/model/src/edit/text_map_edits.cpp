#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "edit/yaml_marks.h"
#include "hersey/model/text_map.h"
#include "tree/source_tree.h"

namespace hersey::model {
namespace {

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t dot = std::min(path.find('.', from), path.size());
    parts.push_back(path.substr(from, dot - from));
    from = dot + 1;
  }
  return parts;
}

bool is_alphanumeric(char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9'); }

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
