#include "hersey/model/schema.h"

#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "hersey/model/read.h"
#include "schema/format.h"
#include "source_dir.h"

namespace hersey::model {
namespace schema_test {

std::string text_of_file(const std::string& path) {
  std::ifstream stream(path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void collect_keys(const Type& type, std::set<std::string>& keys) {
  for (const Key* key : all_keys(type)) {
    keys.insert(key->name);
    collect_keys(*key->type, keys);
  }
  if (!type.tag.empty()) keys.insert(type.tag);
  if (type.item != nullptr) collect_keys(*type.item, keys);
  for (const TypePtr& alternative : type.alternatives) collect_keys(*alternative, keys);
}

std::set<std::string> keys_of_format() {
  std::set<std::string> keys;
  collect_keys(model_format(), keys);
  return keys;
}

void collect_properties(const nlohmann::json& schema, std::set<std::string>& names) {
  if (!schema.is_structured()) return;
  if (!schema.is_object()) {
    for (const auto& child : schema) collect_properties(child, names);
    return;
  }
  for (const auto& [keyword, child] : schema.items()) {
    if (keyword != "properties") {
      collect_properties(child, names);
      continue;
    }
    for (const auto& [name, property] : child.items()) {  // one of these may be called `properties` too
      names.insert(name);
      collect_properties(property, names);
    }
  }
}

TEST_CASE("EveryKey_IsInTheReference") {
  REQUIRE(keys_of_format().size() > 80);
  const std::string page = schema_markdown();
  for (const std::string& key : keys_of_format()) {
    CAPTURE(key);
    const bool as_row = page.find("| `" + key + "` |") != std::string::npos;
    const bool as_tag = page.find("The key `" + key + "` decides") != std::string::npos;
    const bool as_section = page.find("." + key + "`\n") != std::string::npos;
    CHECK((as_row || as_tag || as_section));
  }
}

TEST_CASE("EveryKey_IsInTheJsonSchema") {
  std::set<std::string> properties;
  collect_properties(nlohmann::json::parse(schema_json()), properties);
  CHECK(properties == keys_of_format());
}

TEST_CASE("EveryReferenceInTheJsonSchema_IsDefined") {
  const nlohmann::json schema = nlohmann::json::parse(schema_json());
  const std::string text = schema.dump();
  const std::string mark = "\"$ref\":\"#/$defs/";
  int count = 0;
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1), ++count) {
    const auto start = at + mark.size();
    const std::string name = text.substr(start, text.find('"', start) - start);
    CAPTURE(name);
    CHECK(schema["$defs"].contains(name));
  }
  CHECK(count > 50);
}

TEST_CASE("EveryKey_IsDescribed") {
  const auto check = [](const auto& self, const Type& type) -> void {
    for (const Key* key : all_keys(type)) {
      CAPTURE(key->name);
      CHECK_FALSE(key->description.empty());
      CHECK((key->required || key->default_text || !key->default_note.empty() || !key->description.empty()));
      self(self, *key->type);
    }
    if (type.item != nullptr) self(self, *type.item);
    for (const TypePtr& alternative : type.alternatives) self(self, *alternative);
  };
  check(check, model_format());
}

TEST_CASE("CommittedReference_IsFresh") {
  // Made again by `hersey schema --markdown > docs/model-file.md` and `hersey schema > docs/schema/model.schema.json`.
  CHECK(text_of_file(std::string(hersey::source_dir()) + "/docs/model-file.md") == schema_markdown());
  CHECK(text_of_file(std::string(hersey::source_dir()) + "/docs/schema/model.schema.json") == schema_json());
}

TEST_CASE("ExampleOfTheReference_IsAModel") {
  const std::string page = schema_markdown();
  const std::string fence = "```yaml\n";
  const auto start = page.find(fence) + fence.size();
  const Model model = read_text(page.substr(start, page.find("```", start) - start), "reference");
  CHECK(model.bearings.size() == 1);
  CHECK(model.simulation.duration == 0.2);
}

}  // namespace schema_test
}  // namespace hersey::model
