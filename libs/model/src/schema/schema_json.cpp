#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "hersey/model/schema.h"
#include "schema/format.h"

namespace hersey::model {
namespace {

using Json = nlohmann::ordered_json;
using Kind = Type::Kind;

// A number in the reader's format, and a ${parameter}, which may replace any scalar.
const std::string number_pattern = R"([-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?)";
const std::string name_pattern = "^[A-Za-z][A-Za-z0-9_]*$";

std::string repeated(const std::string& text, int count, const std::string& between) {
  std::string result = text;
  for (int i = 1; i < count; ++i) result += between + text;
  return result;
}

class SchemaWriter {
 public:
  Json document() {
    Json root = schema_of(model_format());
    Json document = {
        {"$schema", "https://json-schema.org/draft/2020-12/schema"},
        {"title", "hersey model file"},
        {"description", "An oil-film bearing simulation: bodies, joints, bearings and how to run them."},
    };
    document.update(root);
    definitions_["parameter"] = {{"type", "string"}, {"pattern", R"(\$\{[A-Za-z][A-Za-z0-9_]*\})"}};
    document["$defs"] = definitions_;
    return document;
  }

 private:
  Json schema_of(const Type& type) {
    if (type.id.empty()) return inline_schema_of(type);
    const std::string id = identifier(type.id);
    if (!definitions_.contains(id)) {
      definitions_[id] = Json();  // keeps its position in the order of first use
      definitions_[id] = inline_schema_of(type);
    }
    return {{"$ref", "#/$defs/" + id}};
  }

  static std::string identifier(const std::string& text) {
    std::string id;
    for (const char c : text) id += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    return id;
  }

  Json inline_schema_of(const Type& type) {
    switch (type.kind) {
      case Kind::text:
      case Kind::scalar:
      case Kind::scale:
        return {{"type", {"string", "number", "boolean"}}};
      case Kind::integer:
        return or_parameter(Json::array({integer_schema(type)}));
      case Kind::quantity:
        return or_parameter(quantity_schemas(type));
      case Kind::choice:
        return or_parameter(word_schemas(type));
      case Kind::reference:
        return reference_schema(type);
      case Kind::list:
        return list_schema(type);
      case Kind::named:
        return named_schema(type);
      case Kind::object:
        return object_schema(type, type.keys, Json::object());
      case Kind::variant:
        return variant_schema(type);
      case Kind::part:
        return {{"type", {"object", "string", "array"}}, {"description", type.title}};
      case Kind::any_of:
        break;
    }
    Json alternatives = Json::array();
    for (const TypePtr& alternative : type.alternatives) alternatives.push_back(schema_of(*alternative));
    return {{"anyOf", alternatives}};
  }

  static Json or_parameter(Json alternatives) {
    alternatives.push_back({{"$ref", "#/$defs/parameter"}});
    return {{"anyOf", alternatives}};
  }

  static void add_range(Json& schema, const Range& range) {
    if (std::isfinite(range.low)) schema[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
    if (std::isfinite(range.high)) schema[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high;
  }

  static Json integer_schema(const Type& type) {
    Json schema = {{"type", "integer"}};
    add_range(schema, type.range);
    return schema;
  }

  static Json word_schemas(const Type& type) {
    Json schemas = Json::array();
    for (const Word& word : type.words) schemas.push_back({{"const", word.text}, {"description", word.description}});
    return schemas;
  }

  Json quantity_schemas(const Type& type) {
    Json schemas = word_schemas(type);
    const bool is_bare = type.units.front() == "1";
    const std::string numbers = repeated(number_pattern, type.count, R"(\s+)");
    const std::string unit = is_bare ? R"(\s*%?)" : R"((\s*[^\s\d].*|\s+1/.*))";
    schemas.push_back({{"type", "string"},
                       {"pattern", "^\\s*" + numbers + unit + "$"},
                       {"description", type.expectation()},
                       {"examples", {type.example}}});
    if (type.count > 1) {
      schemas.push_back({{"type", "string"}, {"pattern", "^\\s*" + repeated("0", type.count, "\\s+") + "\\s*$"}});
      Type one = type;
      one.count = 1;
      one.words.clear();
      schemas.push_back({{"type", "array"},
                         {"items", or_parameter(quantity_schemas(one))},
                         {"minItems", type.count},
                         {"maxItems", type.count}});
    } else if (is_bare) {
      Json number = {{"type", "number"}};
      add_range(number, type.range);
      schemas.push_back(number);
    } else if (type.range.contains(0)) {
      schemas.push_back({{"const", 0}});
    }
    return schemas;
  }

  static Json reference_schema(const Type& type) {
    const std::string second = "(\\.[A-Za-z][A-Za-z0-9_]*)";
    const std::string pattern = type.refers == Refers::frame   ? "^[A-Za-z][A-Za-z0-9_]*" + second + "?$"
                                : type.refers == Refers::shape ? "^[A-Za-z][A-Za-z0-9_]*" + second + "$"
                                                               : name_pattern;
    return or_parameter({{{"type", "string"}, {"pattern", pattern}, {"description", type.expectation()}}});
  }

  Json list_schema(const Type& type) {
    Json schema = {{"type", "array"}, {"items", schema_of(*type.item)}, {"minItems", std::max(1, type.count)}};
    if (type.count > 0) schema["maxItems"] = type.count;
    return schema;
  }

  Json named_schema(const Type& type) {
    Json schema = {{"type", {"object", "null"}}};
    if (!type.free_names)
      schema["properties"] = properties_of(type.keys), schema["properties"]["use"] = schema_of(*use_);
    if (!type.free_names) schema["propertyNames"] = {{"pattern", name_pattern}};
    schema["additionalProperties"] = schema_of(*type.item);
    return schema;
  }

  Json properties_of(const std::vector<Key>& keys) {
    Json properties = Json::object();
    for (const Key& key : keys) {
      Json property = schema_of(*key.type);
      property["description"] = key.description;
      if (key.default_text && !key.default_text->empty()) property["default"] = *key.default_text;
      properties[key.name] = std::move(property);
    }
    return properties;
  }

  /// A mapping with the given keys, and `first` before them among the properties.
  Json object_schema(const Type& type, const std::vector<Key>& keys, Json first, bool is_first_required = true) {
    Json required = Json::array();
    for (const auto& [name, schema] : first.items())
      if (is_first_required) required.push_back(name);
    for (const Key& key : keys) {
      if (key.required) required.push_back(key.name);
    }
    Json schema = {{"type", required.empty() ? Json{"object", "null"} : Json("object")}};
    first.update(properties_of(keys));
    first["use"] = schema_of(*use_);
    schema["properties"] = std::move(first);
    schema["additionalProperties"] = false;
    // Required keys may come from a template.
    Json whole = Json::object();
    if (!required.empty()) whole["required"] = std::move(required);
    add_groups(whole, type, keys);
    if (whole.empty()) return schema;
    schema["if"] = {{"not", {{"required", {"use"}}}}};
    schema["then"] = std::move(whole);
    return schema;
  }

  static void add_groups(Json& schema, const Type& type, const std::vector<Key>& keys) {
    for (const auto& group : type.exactly_one) {
      if (find_key(keys, group.front()) == nullptr) continue;
      Json choices = Json::array();
      for (const std::string& name : group) choices.push_back({{"required", {name}}});
      schema["oneOf"] = std::move(choices);
    }
    for (const auto& group : type.together) {
      if (find_key(keys, group.front()) == nullptr) continue;
      for (const std::string& name : group) {
        Json others = Json::array();
        for (const std::string& other : group) {
          if (other != name) others.push_back(other);
        }
        schema["dependentRequired"][name] = std::move(others);
      }
    }
  }

  Json variant_schema(const Type& type) {
    Json alternatives = Json::array();
    for (const Variant& variant : type.variants) {
      std::vector<Key> keys = type.keys;
      keys.insert(keys.end(), variant.keys.begin(), variant.keys.end());
      const Json tag = {{"const", variant.tag}, {"description", variant.description}};
      const bool stands_alone = std::none_of(keys.begin(), keys.end(), [](const Key& key) { return key.required; });
      if (stands_alone) alternatives.push_back(tag);
      Json schema = object_schema(type, keys, {{type.tag, tag}}, variant.tag != type.default_tag);
      schema["description"] = variant.description;
      alternatives.push_back(std::move(schema));
    }
    return {{"anyOf", alternatives}};
  }

  Json definitions_ = Json::object();
  TypePtr use_ = use_format();
};

}  // namespace

std::string schema_json() { return SchemaWriter().document().dump(2) + "\n"; }

}  // namespace hersey::model
