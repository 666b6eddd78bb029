#include "hersey/model/text_map.h"

#include <algorithm>
#include <utility>

#include "edit/yaml_marks.h"

namespace hersey::model {

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
  const std::pair<int, int> place{line, column};
  for (const auto* places : {&by_key_, &by_value_}) {
    const auto found = std::lower_bound(places->begin(), places->end(), std::pair{place, std::size_t{0}});
    if (found != places->end() && found->first == place) return &entries_[found->second];
  }
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

std::size_t TextMap::end_of_content(const TextEntry& entry) const {
  return offset(entry.value_at.end_line, entry.value_at.end_column);
}

std::size_t TextMap::index_of(const TextEntry& entry) const {
  return static_cast<std::size_t>(&entry - entries_.data());
}

}  // namespace hersey::model
