#include <doctest/doctest.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

#include "hersey/model/read.h"
#include "hersey/model/text_map.h"
#include "source_dir.h"

namespace hersey::model {
namespace text_map_edit_test {

/// A document as it is written: aliases and merge keys stay what they are, and anchors belong to their values.
struct Written {
  std::string anchor, kind, text;
  std::vector<Written> parts = {};
  std::string key = {};  // items have none

  friend bool operator==(const Written& a, const Written& b) {
    return a.anchor == b.anchor && a.kind == b.kind && a.text == b.text && a.key == b.key && a.parts == b.parts;
  }
};

class WrittenBuilder final : public YAML::EventHandler {
 public:
  Written root;  ///< without a kind if there is no document

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnAnchor(const YAML::Mark&, const std::string& name) override { name_ = name; }
  void OnNull(const YAML::Mark&, YAML::anchor_t anchor) override { add({anchor_called(anchor), "null", ""}); }
  void OnAlias(const YAML::Mark&, YAML::anchor_t anchor) override { add({"", "alias", names_[anchor]}); }
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t anchor, const std::string& value) override {
    add({anchor_called(anchor), "scalar", value});
  }
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open_.push_back({{anchor_called(anchor), "list", ""}, std::nullopt});
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
    open_.push_back({{anchor_called(anchor), "mapping", ""}, std::nullopt});
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    Written value;
    std::optional<std::string> key;
  };

  std::string anchor_called(YAML::anchor_t anchor) {
    if (anchor == 0) return "";
    names_[anchor] = name_;
    return name_;
  }
  void close() {
    Written closed = std::move(open_.back().value);
    open_.pop_back();
    add(std::move(closed));
  }
  void add(Written value) {
    if (open_.empty()) {
      root = std::move(value);
    } else if (Open& parent = open_.back(); parent.value.kind == "list") {
      parent.value.parts.push_back(std::move(value));
    } else if (!parent.key) {
      parent.key = value.text;
    } else {
      value.key = *parent.key;
      parent.value.parts.push_back(std::move(value));
      parent.key.reset();
    }
  }

  std::vector<Open> open_;
  std::string name_;
  std::map<YAML::anchor_t, std::string> names_;
};

Written written(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  WrittenBuilder builder;
  parser.HandleNextDocument(builder);
  return builder.root;
}

/// The mapping or list with the part that the last word of `path` names; the parts may not be moved meanwhile.
std::pair<Written*, std::string> owner_of(Written& root, const std::string& path) {
  Written* value = &root;
  std::size_t from = 0;
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', from)) {
    const std::string key = path.substr(from, dot - from);
    if (value->kind == "list") {
      value = &value->parts.at(std::stoul(key));
    } else {
      const auto part =
          std::find_if(value->parts.begin(), value->parts.end(), [&](const auto& one) { return one.key == key; });
      REQUIRE(part != value->parts.end());
      value = &*part;
    }
    from = dot + 1;
  }
  return {value, path.substr(from)};
}

/// What a document has to be after `path` was set to `value`, or removed.
Written with_change(Written root, const std::string& path, const std::optional<std::string>& value) {
  const auto [owner, key] = owner_of(root, path);
  if (owner->kind == "null") owner->kind = "mapping";
  auto& parts = owner->parts;
  const bool is_list = owner->kind == "list";
  const std::string name = is_list ? "" : key;
  const auto part = is_list
                        ? parts.begin() + static_cast<std::ptrdiff_t>(std::min(std::stoul(key), parts.size()))
                        : std::find_if(parts.begin(), parts.end(), [&](const auto& one) { return one.key == name; });
  if (!value) {
    REQUIRE(part != parts.end());
    parts.erase(part);
    return root;
  }
  Written changed = written(*value);
  changed.key = name;
  if (part == parts.end()) {
    parts.push_back(std::move(changed));
  } else {
    changed.anchor = part->anchor;
    *part = std::move(changed);
  }
  return root;
}

/// Order of keys says nothing, and an insertion in braces comes before a merge key.
void sort_keys(Written& value) {
  for (Written& part : value.parts) sort_keys(part);
  if (value.kind == "mapping")
    std::stable_sort(value.parts.begin(), value.parts.end(),
                     [](const auto& a, const auto& b) { return a.key < b.key; });
}

struct Count {
  int made = 0, refused = 0;
};

/// Makes one change, unless it is refused: the document has to be the old one with it.
void change(const TextMap& map, const std::string& path, const std::optional<std::string>& value, Count& count) {
  CAPTURE(path);
  CAPTURE(value.value_or("removed"));
  std::string changed;
  try {
    const std::vector<TextEdit> edits = value ? map.set(path, *value) : map.remove(path);
    map.require_nothing_else(path, edits, !value);
    changed = with_edits(map.text(), edits);
  } catch (const InputError&) {
    ++count.refused;
    return;
  }
  ++count.made;
  CAPTURE(changed);
  Written found = written(changed), expected = with_change(written(map.text()), path, value);
  sort_keys(found), sort_keys(expected);
  if (expected.parts.empty() && expected.kind == "mapping" && found.kind.empty()) return;  // nothing is left
  CHECK((found == expected));
}

/// Changes number `kind` of the five there are for a key or item.
void change_entry(const TextMap& map, const TextEntry& entry, std::size_t kind, Count& count) {
  if (kind == 0) change(map, entry.path, "7 mm", count);
  if (kind == 1) change(map, entry.path, "[1, {a: b}]", count);
  if (kind == 2) change(map, entry.path, std::nullopt, count);
  if (entry.is_alias) return;
  const bool is_list = entry.kind == TextEntry::Kind::list;
  const bool takes = is_list || entry.kind == TextEntry::Kind::mapping || entry.kind == TextEntry::Kind::nothing;
  const std::string added = entry.path + "." + (is_list ? std::to_string(entry.children.size()) : "new_key");
  if (kind == 3 && takes) change(map, added, "one, {two}", count);
  if (kind == 4 && takes) change(map, added, "-5", count);
}

TEST_CASE("OfEveryExample_OnlyWhatIsChangedChanges") {
  Count count;
  const std::string root = source_dir();
  for (const std::string& folder : {root + "/examples", root + "/libs/session/starting_models"}) {
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder)) {
      if (file.path().extension() != ".yaml") continue;
      CAPTURE(file.path().string());
      const TextMap map(file_text(file.path().string()), file.path().string());
      const std::size_t step = 11;  // every eleventh key, each by another kind of change
      for (std::size_t i = 1; i < map.entries().size(); i += step)
        change_entry(map, map.entries()[i], (i / step) % 5, count);
    }
  }
  MESSAGE("changes made: ", count.made, ", refused: ", count.refused);
  CHECK(count.made > 400);
  CHECK(count.refused < 5);  // anchors that aliases name
}

/// Texts in forms that few people write.
const std::vector<std::string> kUnusual{
    "a: &first {x: 1, y: 2}\nb: *first\nc: {<<: *first, z: 3}\nd:\n  <<: *first\n  x: 5\ne: [*first, 2]\n",
    "d: &d 3\nl:\n  - *d\n  - 2\n  - *d\nm: 1\n",
    "d: &d {q: 1}\nm: {<<: *d}\nn:\n    <<: *d\no: {x: 1, <<: *d, y: 2}\np:\n  x: 1\n  <<: [*d,\n    *d]\n  y: 2\n",
    "d: &d {q: 1}\nl:\n  - a: 1\n    <<: *d\n  - <<: *d\n    a: 1\n  - a: 1\n    b: 2\n",
    "l:\n- -1\n- -2.5\n-   -3\nm:\n  - - -1\n    - -2\n  - - -3\n",
    "l: [-1, -2, ~, 0]\n",
    "x: &x 1\nl: [-1, ~, *x, 'it''s', \"q, ]\"]\nm: {a: , b: ~, c, d: *x}\n",
    "l:\n  -\n  - ~\n  - null\n  -   # nothing\n  - 5   # five\n  -\n    deep: 1\n",
    "a:\n  ~\nb:\n  &v 5\nc:\n  *v\nd:   # nothing\ne: &n\nf: *n\n",
    "a: &a 1   # one\nb: &b\n  c: 2\n  d: &d\n    - 1\n    - 2\ne: &e [1, 2]\nf: *d\ng: !!str 5\nh: &h !!str 6\n",
    "hersey: 1\r\na:\r\n  b: 1   # one\r\n  # between\r\n  c: [1,\r\n    2]\r\nd:\r\n  - 1\r\n  - x: 1\r\n    y: 2\r\n",
    "# head\n\na: 1   # of a\n\n# before b\nb:\n  # in b\n  c: 'x # y'   # of c\n\n  d: \"z\"\n# tail\n",
    "a: {b: 1,   # one\n    c: 2,   # two\n    d: [1,   # three\n        2]}   # four\ne: 1\n",
    "a: |\n  one\n  # no comment\n\n  two\nb: >-\n  folded\n  text\nc: plain\n  goes on\nd: 'a\n  b'\ne:\n  - |\n    "
    "x\n  - y\n",
    "a: |+\n  keeps\n\n\nb: 1\nc:\n  d: |+\n    end\n\n",
    "\xEF\xBB\xBF"
    "a: {b: 1, c: 2}\nd:\n  e: 3\n",
    "\xEF\xBB\xBF"
    "a: 1",
    "{a: 1, b: {c: [1, 2]}}\n",
    "a: {}\nb: []\nc:\n  {d: 1}\ne:\n  [1,\n   2]\n",
    "---\na: 1\nb: {\"c\":1, 'd': 2}\n\"e f\": 3\n",
    "l: [a: 1, {b: 2}, c: 3]\n",
    "? a\n: 1\n? b\n: c: 2\n",
    "a: http://x.y/z#w\nb: x:y\nc: [a:b, c#d]\nd: it is 5\" wide\n",
    "a:   \n  b:\t1\n  c: 2 \t \n",
};

TEST_CASE("OfUnusualTexts_OnlyWhatIsChangedChanges_OrTheChangeIsRefused") {
  Count count;
  for (const std::string& text : kUnusual) {
    CAPTURE(text);
    std::optional<TextMap> map;
    try {
      map.emplace(text, "a.yaml");
    } catch (const InputError&) {
      continue;  // no YAML for the parser
    }
    for (const TextEntry& entry : map->entries())
      for (std::size_t kind = 0; kind < 5 && !entry.path.empty(); ++kind) change_entry(*map, entry, kind, count);
    const bool has_item = map->entries().front().kind == TextEntry::Kind::mapping;
    if (has_item) change(*map, "new_key", "7 mm", count);
  }
  MESSAGE("changes made: ", count.made, ", refused: ", count.refused);
  CHECK(count.made > 500);
  CHECK(count.refused < 45);
}

}  // namespace text_map_edit_test
}  // namespace hersey::model
