#include "answers/repairs.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "hersey/core/units.h"
#include "hersey/model/convert.h"
#include "hersey/model/schema.h"

namespace hersey::workbench {
namespace {

using model::TextEdit;
using model::TextEntry;
using model::TextExtent;
using model::TextMap;

constexpr std::size_t kMostUnits = 4;
constexpr std::string_view kMarkOfUtf8 = "\xEF\xBB\xBF";  // columns of a TextMap begin behind it

/// The texts in single quotes, in their order.
std::vector<std::string> words_in_quotes(std::string_view text) {
  std::vector<std::string> found;
  for (std::size_t at = text.find('\''); at != std::string_view::npos; at = text.find('\'', at + 1)) {
    const std::size_t end = text.find('\'', at + 1);
    if (end == std::string_view::npos) break;
    found.emplace_back(text.substr(at + 1, end - at - 1));
    at = end;
  }
  return found;
}

/// "mass" of "did you mean 'mass'?".
std::string meant(const std::string& suggestion) {
  if (!suggestion.starts_with("did you mean '")) return "";
  const std::vector<std::string> names = words_in_quotes(suggestion);
  return names.empty() ? "" : names.front();
}

bool is_of_word(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '_';
}

/// Where `word` stands by itself in `at`; an empty extent where it does not.
TextExtent find_word(const TextMap& map, const TextExtent& at, const std::string& word) {
  const std::string& text = map.text();
  const std::size_t begin = map.offset(at.line, at.column), end = map.offset(at.end_line, at.end_column);
  if (word.empty()) return {};
  for (std::size_t i = text.find(word, begin); i != std::string::npos && i + word.size() <= end;
       i = text.find(word, i + 1)) {
    const bool begins = i == 0 || !is_of_word(text[i - 1]) || !is_of_word(word.front());
    const std::size_t behind = i + word.size();
    const bool ends = behind >= text.size() || !is_of_word(text[behind]) || !is_of_word(word.back());
    if (!begins || !ends) continue;
    const auto from = text.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto lines = std::count(from, from + static_cast<std::ptrdiff_t>(i - begin), '\n');
    const int line = at.line + static_cast<int>(lines);
    const int column = lines == 0 ? at.column + static_cast<int>(i - begin) : static_cast<int>(i - text.rfind('\n', i));
    return {line, column, line, column + static_cast<int>(word.size())};
  }
  return {};
}

/// The mapping that a fault about its keys is of: its key or its value begins at the fault.
const TextEntry* mapping_at(const Fault& fault, const TextMap& map) {
  if (fault.path.empty()) return &map.entries().front();
  if (const TextEntry* entry = map.at(fault.position.line, fault.position.column))
    if (entry->kind == TextEntry::Kind::mapping || entry->kind == TextEntry::Kind::nothing) return entry;
  return map.find(fault.path);
}

/// The first name in a section of the text, for a reference to one of its parts.
std::string first_name(const TextMap& map, const std::string& section) {
  const TextEntry* entry = map.find(section);
  return entry == nullptr || entry->children.empty() ? "" : map.entries()[entry->children.front()].key;
}

/// The first parameter of the text with the value that it has, for a study: `{load: [2500 N]}`.
std::string first_parameter(const TextMap& map) {
  const std::string name = first_name(map, "parameters");
  const TextEntry* entry = name.empty() ? nullptr : map.find("parameters." + name);
  if (entry == nullptr || entry->kind != TextEntry::Kind::scalar) return "";
  const std::size_t begin = map.offset(entry->value_at.line, entry->value_at.column);
  const std::size_t end = map.offset(entry->value_at.end_line, entry->value_at.end_column);
  return "{" + name + ": [" + map.text().substr(begin, end - begin) + "]}";
}

/// Value for a key that is missing: a name of the model where a name is wanted, else the format's example.
std::string value_for(const TextMap& map, const std::string& path, const std::string& expected) {
  static const std::array<std::pair<const char*, const char*>, 3> sections{
      {{"a lubricant", "lubricants"}, {"a joint", "joints"}, {"a body", "bodies"}}};
  for (const auto& [words, section] : sections)
    if (expected.starts_with(words))
      if (std::string name = first_name(map, section); !name.empty()) return name;
  if (path == "study.parameters")
    if (std::string parameter = first_parameter(map); !parameter.empty()) return parameter;
  try {
    return model::example_value(path);
  } catch (const InputError&) {
    return "";
  }
}

Repair adding(const TextMap& map, const TextEntry& to, const std::string& path, const std::string& key,
              const std::string& expected) {
  const std::string value = value_for(map, (path.empty() ? "" : path + ".") + key, expected);
  if (value.empty()) return {};
  const std::string target = (to.path.empty() ? "" : to.path + ".") + key;
  return {"Add '" + key + ": " + value + "'", map.set(target, value)};
}

class Repairs {
 public:
  Repairs(const Fault& fault, const TextMap& map) : fault_(fault), map_(map) {}

  std::vector<Repair> find() {
    replace_by_nearest();
    write_decimal_point();
    add_unit();
    add_missing();
    choose_one();
    remove_unknown();
    return std::move(repairs_);
  }

 private:
  [[nodiscard]] const TextEntry* entry() const { return map_.at(fault_.position.line, fault_.position.column); }

  /// The value that the fault is of, or the key.
  [[nodiscard]] TextExtent extent() const {
    if (const TextEntry* at = entry(); at != nullptr && !is_about_key() && at->kind == TextEntry::Kind::scalar)
      return at->value_at;
    return map_.word_at(fault_.position.line, fault_.position.column);
  }
  [[nodiscard]] bool is_about_key() const {
    return fault_.found.starts_with("unknown key") || fault_.found.starts_with("key '") ||
           fault_.found.starts_with("duplicate key");
  }

  void replace_by_nearest() {
    const std::string name = meant(fault_.suggestion);
    const std::vector<std::string> words = words_in_quotes(fault_.found);
    if (name.empty() || words.empty()) return;
    const TextExtent at = find_word(map_, extent(), words.front());
    if (at.line == 0) return;
    repairs_.push_back({"Replace '" + words.front() + "' by '" + name + "'", {{at, name}}});
  }

  void write_decimal_point() {
    if (!fault_.suggestion.starts_with("write ") || fault_.expected != "a decimal point") return;
    const std::string better = fault_.suggestion.substr(6);
    const std::vector<std::string> words = words_in_quotes(fault_.found);
    const TextExtent at = words.empty() ? TextExtent{} : find_word(map_, extent(), words.front());
    if (at.line > 0) repairs_.push_back({"Write " + better, {{at, better}}});
  }

  void add_unit() {
    if (!fault_.found.starts_with("a number without unit")) return;
    const std::string such_as = ", such as ";
    const std::size_t example = fault_.expected.rfind(such_as);
    const TextExtent at = extent();
    if (example == std::string::npos || at.line != at.end_line) return;
    std::string unit;
    try {
      unit = split_quantity(std::string_view(fault_.expected).substr(example + such_as.size())).unit;
    } catch (const QuantityError&) {
      return;
    }
    const std::size_t last = unit.rfind(' ');  // of "0 48 0 mm"
    if (last != std::string::npos) unit = unit.substr(last + 1);
    std::vector<std::string> units{unit};
    for (const Dimension& dimension : dimensions()) {
      const auto& spelled = dimension.spelled;
      if (std::find(spelled.begin(), spelled.end(), unit) == spelled.end()) continue;
      for (const std::string& other : spelled)
        if (other != unit && units.size() < kMostUnits) units.push_back(other);
      break;
    }
    const std::string& text = map_.text();
    const std::size_t begin = map_.offset(at.line, at.column), end = map_.offset(at.end_line, at.end_column);
    const std::string number = text.substr(begin, end - begin);
    if (number.empty() || number.find_first_not_of("0123456789.eE+- ") != std::string::npos) return;  // a ${parameter}
    for (const std::string& one : units) {
      const std::string whole = number + " " + one;
      repairs_.push_back({"Write " + whole, {{at, whole}}});
    }
  }

  void add_missing() {
    if (!fault_.found.starts_with("missing key '")) return;
    const TextEntry* mapping = mapping_at(fault_, map_);
    if (mapping == nullptr) return;
    push(adding(map_, *mapping, fault_.path, words_in_quotes(fault_.found).front(), fault_.expected));
  }

  void choose_one() {
    if (fault_.found.starts_with("none of the keys ")) {
      const TextEntry* mapping = mapping_at(fault_, map_);
      if (mapping == nullptr) return;
      for (const std::string& key : words_in_quotes(fault_.found)) push(adding(map_, *mapping, fault_.path, key, ""));
    } else if (fault_.found.starts_with("keys '") && fault_.found.ends_with(" together")) {
      for (const std::string& key : words_in_quotes(fault_.found)) {
        const std::string path = (fault_.path.empty() ? "" : fault_.path + ".") + key;
        if (map_.find(path) != nullptr) repairs_.push_back({"Remove '" + key + "'", map_.remove(path)});
      }
    } else if (fault_.found.starts_with("key '") && fault_.found.find("' without '") != std::string::npos) {
      const TextEntry* mapping = map_.find(fault_.path);
      if (mapping != nullptr) push(adding(map_, *mapping, fault_.path, words_in_quotes(fault_.found).back(), ""));
    }
  }

  void remove_unknown() {
    const bool is_of_other = fault_.found.starts_with("key '") && fault_.found.ends_with(" does not have");
    if (!fault_.found.starts_with("unknown key") && !is_of_other) return;
    const TextEntry* at = entry();
    if (at == nullptr || at->key_at.column != fault_.position.column || at->path.empty()) return;
    if (map_.find(at->path) == at) repairs_.push_back({"Remove '" + at->key + "'", map_.remove(at->path)});
  }

  void push(Repair repair) {
    if (!repair.edits.empty()) repairs_.push_back(std::move(repair));
  }

  const Fault& fault_;
  const TextMap& map_;
  std::vector<Repair> repairs_;
};

/// Tabs before a line's text, which YAML does not take.
std::vector<Repair> without_tabs(const Fault& fault, const std::string& text) {
  if (fault.suggestion != "indent with spaces, not tabs" || fault.position.line < 1) return {};
  std::size_t begin = text.starts_with(kMarkOfUtf8) ? kMarkOfUtf8.size() : 0;
  for (int line = 1; line < fault.position.line && begin != std::string::npos; ++line) {
    begin = text.find('\n', begin);
    if (begin != std::string::npos) ++begin;
  }
  if (begin == std::string::npos) return {};
  const std::size_t end = std::min(text.find_first_not_of(" \t", begin), text.size());
  std::string spaces;
  for (std::size_t i = begin; i < end; ++i) spaces += text[i] == '\t' ? "  " : " ";
  const TextExtent at{fault.position.line, 1, fault.position.line, static_cast<int>(end - begin) + 1};
  return {{"Indent with spaces", {{at, spaces}}}};
}

/// Depths that a line may have, of a fault of its indentation: "4 spaces, as 'mass' in line 4, or no spaces, as ...".
std::vector<Repair> indented(const Fault& fault) {
  if (fault.found.find("' indented by ") == std::string::npos || fault.position.line < 1) return {};
  std::vector<Repair> repairs;
  const std::string& allowed = fault.expected;
  for (std::size_t at = 0; at != std::string::npos;) {
    const std::size_t end = allowed.find(" space", at), name = allowed.find(", as '", at);
    if (end == std::string::npos || name == std::string::npos) break;
    const std::string count = allowed.substr(at, end - at);
    const std::vector<std::string> as = words_in_quotes(std::string_view(allowed).substr(name));
    constexpr std::size_t kDeepest = 1000;  // [columns]
    const std::size_t spaces =
        count == "no" ? 0 : std::min<std::size_t>(std::strtoul(count.c_str(), nullptr, 10), kDeepest);
    if (!as.empty())
      repairs.push_back(
          {"Indent as '" + as.front() + "'",
           {{{fault.position.line, 1, fault.position.line, fault.position.column}, std::string(spaces, ' ')}}});
    const std::string next = ", or ";
    at = allowed.find(next, name);
    if (at != std::string::npos) at += next.size();
  }
  return repairs;
}

/// The whole text as this version writes it.
std::vector<Repair> brought_up_to_date(const Fault& fault, const std::string& text) {
  if (fault.expected.find("`hersey convert` brings this file up to date") == std::string::npos) return {};
  const int lines = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
  const std::size_t mark = text.starts_with(kMarkOfUtf8) ? kMarkOfUtf8.size() : 0;
  const std::size_t last = text.rfind('\n') == std::string::npos ? mark : text.rfind('\n') + 1;
  return {{"Bring the file up to date",
           {{{1, 1, lines, static_cast<int>(text.size() - last) + 1}, model::converted(text.substr(mark), "").text}}}};
}

std::string relative_to(const std::string& folder, const std::string& file) {
  const std::string prefix = folder + "/";
  return file.starts_with(prefix) ? file.substr(prefix.size()) : file;
}

}  // namespace

std::vector<Repair> repairs_of(const Fault& fault, const std::string& text, const TextMap* map) {
  if (map == nullptr) {
    std::vector<Repair> repairs = without_tabs(fault, text);
    for (Repair& repair : indented(fault)) repairs.push_back(std::move(repair));
    return repairs;
  }
  std::vector<Repair> repairs = brought_up_to_date(fault, text);
  if (fault.position.line < 1) return repairs;
  try {
    for (Repair& repair : Repairs(fault, *map).find()) repairs.push_back(std::move(repair));
  } catch (const InputError&) {
    return repairs;  // the text stands in an alias or a template: it cannot be changed at this place
  }
  return repairs;
}

TextColumns::TextColumns(std::string_view text) : text_(text), lines_{0} {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') lines_.push_back(i + 1);
}

int TextColumns::utf16(int line, int column) const {
  if (line < 1 || column < 1 || static_cast<std::size_t>(line) > lines_.size()) return column;
  const bool has_mark = line == 1 && text_.starts_with(kMarkOfUtf8);  // one unit of its own
  const std::size_t begin = has_mark ? kMarkOfUtf8.size() : lines_[static_cast<std::size_t>(line - 1)];
  const std::size_t end = std::min(begin + static_cast<std::size_t>(column - 1), text_.size());
  int units = static_cast<int>(column - 1 - static_cast<int>(end - begin));
  for (std::size_t i = begin; i < end; ++i) {
    const auto byte = static_cast<unsigned char>(text_[i]);
    if ((byte & 0xC0U) == 0x80U) continue;  // goes on a character
    units += byte >= 0xF0U ? 2 : 1;         // beyond the basic plane: a pair
  }
  return units + 1 + (has_mark ? 1 : 0);
}

Json json_of(const TextEdit& edit, const TextColumns& columns) {
  const TextExtent& at = edit.at;
  return {{"line", at.line},
          {"column", columns.utf16(at.line, at.column)},
          {"endLine", at.end_line},
          {"endColumn", columns.utf16(at.end_line, at.end_column)},
          {"text", edit.text}};
}

Json json_of(const std::vector<TextEdit>& edits, const TextColumns& columns) {
  Json list = Json::array();
  for (const TextEdit& edit : edits) list.push_back(json_of(edit, columns));
  return list;
}

Json json_of(const Fault& fault, const std::string& text, const TextMap* map, const TextColumns& columns,
             const std::string& file, const std::string& folder) {
  const bool is_here = fault.position.file == file;
  int line = fault.position.line, column = fault.position.column, end_line = line, end_column = column;
  Json repairs = Json::array();
  if (is_here && line > 0) {
    if (map != nullptr) {
      const TextExtent word = map->word_at(line, column);
      end_line = word.end_line, end_column = word.end_column;
    } else {
      ++end_column;
    }
    for (const Repair& repair : repairs_of(fault, text, map))
      repairs.push_back({{"label", repair.label}, {"edits", json_of(repair.edits, columns)}});
    end_column = columns.utf16(end_line, end_column);
    column = columns.utf16(line, column);
  }
  return {{"line", line},
          {"column", column},
          {"endLine", end_line},
          {"endColumn", end_column},
          {"file", relative_to(folder, fault.position.file)},
          {"path", fault.path},
          {"message", Fault{{}, "", fault.found, fault.expected, fault.suggestion}.text()},
          {"found", fault.found},
          {"expected", fault.expected},
          {"suggestion", fault.suggestion},
          {"repairs", std::move(repairs)}};
}

}  // namespace hersey::workbench
