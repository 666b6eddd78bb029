#include "hersey/model/text_map.h"

#include <doctest/doctest.h>

#include <filesystem>

#include "hersey/model/read.h"
#include "hersey/model/schema.h"
#include "source_dir.h"

namespace hersey::model {
namespace text_map_test {

std::string piece(const TextMap& map, const TextExtent& at) {
  const std::size_t begin = map.offset(at.line, at.column), end = map.offset(at.end_line, at.end_column);
  return map.text().substr(begin, end - begin);
}

std::vector<std::string> model_files() {
  std::vector<std::string> files;
  const std::string root = source_dir();
  for (const std::string& folder : {root + "/examples", root + "/libs/session/starting_models"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      // Names of quantities are keys with dots there, which a path cannot tell from keys below keys.
      if (entry.path().extension() == ".yaml" && entry.path().parent_path().filename() != "parts")
        files.push_back(entry.path().string());
  return files;
}

TEST_CASE("EveryValueOfEveryExample_SetToItself_LeavesTheText") {
  std::size_t values = 0;
  for (const std::string& file : model_files()) {
    CAPTURE(file);
    const TextMap map(file_text(file), file);
    for (const TextEntry& entry : map.entries()) {
      if (entry.path.empty() || entry.is_alias || entry.kind == TextEntry::Kind::nothing) continue;
      CAPTURE(entry.path);
      const bool is_item = map.entries()[entry.parent].kind == TextEntry::Kind::list;
      if (!is_item) CHECK(piece(map, entry.key_at).find(entry.key) <= 1);  // within quotes
      if (entry.value_at.line != entry.value_at.end_line) continue;
      if (!entry.is_flow && entry.kind != TextEntry::Kind::scalar) continue;
      const std::string text = piece(map, entry.value_at);
      const bool is_flow = entry.kind != TextEntry::Kind::scalar;
      if (is_flow) CHECK((text.ends_with("}") || text.ends_with("]")));
      CHECK(with_edits(map.text(), map.set(entry.path, text)) == map.text());
      ++values;
    }
  }
  CHECK(values > 3000);
}

TEST_CASE("ExtentsOfChildren_LieInTheirParents") {
  for (const std::string& file : model_files()) {
    CAPTURE(file);
    const TextMap map(file_text(file), file);
    for (const TextEntry& entry : map.entries()) {
      if (entry.path.empty() || entry.is_alias) continue;
      const TextExtent& of = map.entries()[entry.parent].value_at;
      CHECK(map.offset(entry.key_at.line, entry.key_at.column) >= map.offset(of.line, of.column));
      CHECK(map.offset(entry.value_at.end_line, entry.value_at.end_column) <= map.offset(of.end_line, of.end_column));
    }
  }
}

TEST_CASE("AliasesAndMergeKeys_AreChangedAtTheirOrigin") {
  const std::string text =
      "a: &first {x: 1, y: 2}\nb: *first\nc: {<<: *first, z: 3}\nd:\n  <<: *first\n  x: 5\ne: [*first, 2]\n";
  const TextMap map(text, "a.yaml");
  REQUIRE(map.find("b") != nullptr);
  CHECK(map.find("b")->is_alias);
  CHECK(map.find("b.x") == nullptr);
  CHECK(map.find("c.x") == nullptr);
  CHECK(map.find("e.0")->is_alias);
  CHECK(with_edits(text, map.set("c.z", "4")).find("z: 4}") != std::string::npos);
  CHECK(with_edits(text, map.set("d.x", "6")).find("  x: 6\n") != std::string::npos);
  CHECK(with_edits(text, map.set("a.x", "7")).starts_with("a: &first {x: 7, y: 2}\n"));
  CHECK(with_edits(text, map.set("b", "8")).find("\nb: 8\n") != std::string::npos);
  CHECK_THROWS_AS((void)map.set("b.x", "9"), InputError);
}

TEST_CASE("TextsOfSeveralLines_AreOneValue") {
  const std::string text = "a: |\n  one\n  two\nb: plain\n  goes on\nc: \"quoted # and\n  on\"\nd: 'it''s'   # it is\n";
  const TextMap map(text, "a.yaml");
  CHECK(piece(map, map.find("a")->value_at) == "|\n  one\n  two");
  CHECK(piece(map, map.find("b")->value_at) == "plain\n  goes on");
  CHECK(piece(map, map.find("c")->value_at) == "\"quoted # and\n  on\"");
  CHECK(piece(map, map.find("d")->value_at) == "'it''s'");
  CHECK(with_edits(text, map.set("a", "1")).starts_with("a: 1\nb: plain\n"));
}

TEST_CASE("ExamplesOfKeys_AreTakenByTheReader") {
  // Each is a good value of its key: its type at least has no fault.
  for (const std::string path : {"bearings.main.diameter", "bearings.main.supply", "bearings.main.grid",
                                 "bodies.a.inertia", "simulation", "joints.a.type", "bearings.main.kind"}) {
    CAPTURE(path);
    const std::string text = "hersey: 1\n";
    const TextMap map(text, "a.yaml");
    const std::string changed = with_edits(text, map.set(path, example_value(path)));
    try {
      (void)read_text(changed, "a.yaml");
    } catch (const InputError& error) {
      for (const Fault& fault : error.faults()) CHECK_FALSE(fault.path.starts_with(path + "."));
      for (const Fault& fault : error.faults())
        if (fault.path == path) CHECK(fault.found.find("missing key") != std::string::npos);
    }
  }
}

}  // namespace text_map_test
}  // namespace hersey::model
