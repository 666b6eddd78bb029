#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hersey/core/input_error.h"

namespace hersey::model {

struct Node;

/// A stretch of a text. Lines and columns count from 1, columns in bytes; the end lies behind the last character.
struct TextExtent {
  int line = 0, column = 0, end_line = 0, end_column = 0;

  friend bool operator==(const TextExtent&, const TextExtent&) = default;
};

/// Replacement of a stretch of a text; an empty stretch inserts.
struct TextEdit {
  TextExtent at;
  std::string text;
};

/// One `key: value` of a model's text, or an item of a list.
struct TextEntry {
  enum class Kind { nothing, scalar, list, mapping };
  std::string path;     ///< "bearings.big_end.features.0"
  std::string key;      ///< last part of the path
  TextExtent key_at;    ///< of the key; of an item: that of its value
  TextExtent value_at;  ///< of the value; empty, behind the colon, where there is none
  Kind kind = Kind::nothing;
  bool is_flow = false;    ///< the value stands in brackets or braces
  bool is_alias = false;   ///< the value is `*anchor`: what it has stands elsewhere; or its place is not known
  std::size_t parent = 0;  ///< index of the mapping or list it stands in; the root is entry 0
  std::vector<std::size_t> children;
};

/// Where everything stands in the text of a model, so that single values can be changed while comments, order and
/// layout of all the rest stay. Columns of line 1 count from behind a byte order mark. Keys that aliases, merge keys or
/// templates bring in stand at their origin only.
/// @verified_by text_map_test.cpp, text_map_edit_test.cpp
class TextMap {
 public:
  /// @param file  names the text in faults
  /// @throws InputError where the text is not YAML
  TextMap(const std::string& text, const std::string& file);
  /// Of a text that has been read. @param root  its tree
  TextMap(std::string text, std::string file, const Node& root);

  /// The text as it was given.
  [[nodiscard]] const std::string& text() const { return text_; }
  /// The root first; then every key and item in the order of the text, each behind its parent.
  [[nodiscard]] const std::vector<TextEntry>& entries() const { return entries_; }
  /// The entry at a key path; null if the text has none.
  [[nodiscard]] const TextEntry* find(std::string_view path) const;
  /// The entry whose key, or else whose value, begins at this position; null if there is none.
  [[nodiscard]] const TextEntry* at(int line, int column) const;

  /// The edits that give the key at `path` the value `value`, a piece of YAML in one line: the value is replaced, or
  /// the key inserted behind the last one of its mapping, with mappings around it that are missing.
  /// An anchor before the value stays.
  /// @throws InputError if `value` is not YAML in one line, if a part of `path` is no mapping, no plain word where it
  /// is new, or stands in an alias, and if aliases name an anchor in the old value
  [[nodiscard]] std::vector<TextEdit> set(const std::string& path, const std::string& value) const;
  /// The edits that remove the key or item at `path`, with its line if nothing else is on it.
  /// @throws InputError if there is none, and if aliases name an anchor in it
  [[nodiscard]] std::vector<TextEdit> remove(const std::string& path) const;
  /// Makes sure that `edits`, which set or remove what is at `path`, leave everything else that the text says: reads
  /// the text with them.
  /// @throws InputError if they do not: then the text is written in a way that TextMap does not know
  void require_nothing_else(const std::string& path, const std::vector<TextEdit>& edits, bool is_removed) const;

  /// Byte offset of a position, at most that of its line's end.
  [[nodiscard]] std::size_t offset(int line, int column) const;
  /// End of the word that stands at a position, for marking it: of a key or value that begins there, else of the
  /// characters up to a blank or a mark of YAML.
  [[nodiscard]] TextExtent word_at(int line, int column) const;

 private:
  struct Scan;
  /// Two offsets: of the first character, and behind the last.
  using Piece = std::pair<std::size_t, std::size_t>;
  [[nodiscard]] TextExtent extent(std::size_t begin, std::size_t end) const;
  [[nodiscard]] int column_of_children(const TextEntry& entry) const;
  [[nodiscard]] std::size_t end_of_content(const TextEntry& entry) const;
  [[nodiscard]] std::size_t index_of(const TextEntry& entry) const;
  [[nodiscard]] std::vector<Piece> pieces_of(const TextEntry& entry) const;
  [[nodiscard]] std::string anchor_of(const TextEntry& entry) const;
  [[nodiscard]] TextEdit replacement(const TextEntry& entry, const std::string& text) const;
  [[nodiscard]] TextEdit removal(const TextEntry& entry) const;
  [[nodiscard]] std::vector<TextEdit> with_anchors(const std::string& path, TextEdit edit) const;
  [[nodiscard]] std::vector<std::string> said_beside(const std::string& path, bool has_path) const;
  void require_found(const TextEntry& entry, const std::string& path) const;
  [[nodiscard]] TextEdit insertion(const TextEntry& into, const std::string& key, const std::string& value) const;
  [[nodiscard]] Fault fault(const TextEntry& at, const std::string& path, std::string found,
                            std::string expected) const;

  std::string text_, file_;
  std::vector<std::size_t> lines_;            // where each begins
  std::vector<std::size_t> offset_of_value_;  // of each entry: a value that begins before stands elsewhere
  std::vector<std::size_t> offset_of_mark_;   // of each item: its dash, or the comma or bracket before it
  std::map<std::size_t, Piece> merges_;       // `<<: *anchor` of mappings that have one
  std::vector<TextEntry> entries_;
  // Entries by line and column of their beginning, sorted; of several the first.
  std::vector<std::pair<std::pair<int, int>, std::size_t>> by_key_, by_value_;
};

/// The text with the edits made. @pre no two of them overlap
[[nodiscard]] std::string with_edits(const std::string& text, const std::vector<TextEdit>& edits);

}  // namespace hersey::model
