#include <algorithm>
#include <sstream>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/core/units.h"
#include "hersey/model/schema.h"
#include "schema/format.h"

namespace hersey::model {
namespace {

using Kind = Type::Kind;

constexpr std::size_t kWidth = 100;

/// A location in the format to which a key path leads.
struct KeyLocation {
  std::string path;  ///< with <name> where names are free
  const Type* type = nullptr;
  const Key* key = nullptr;  ///< null for the item of a mapping with free names
  std::string condition;     ///< "type: revolute", where only some variants have the key
  bool is_tag = false;       ///< the key that chooses the variant of `type`
};

std::string key_path(const std::string& path, const std::string& key) { return path.empty() ? key : path + "." + key; }

bool has_keys(const Type& type) { return type.kind == Kind::object || type.kind == Kind::variant; }

/// The mappings with keys that a value may be: several where it is one of alternatives.
void collect_mappings(const Type& type, std::vector<const Type*>& mappings) {
  if (has_keys(type)) mappings.push_back(&type);
  if (type.kind == Kind::any_of)
    for (const TypePtr& alternative : type.alternatives) collect_mappings(*alternative, mappings);
  if (type.kind == Kind::list) collect_mappings(*type.item, mappings);
}

std::vector<const Type*> mappings_of(const Type& type) {
  std::vector<const Type*> mappings;
  collect_mappings(type, mappings);
  return mappings;
}

bool is_item_number(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return '0' <= c && c <= '9'; });
}

/// The keys called `name` below `location`; a variant's may differ from one to the other.
std::vector<KeyLocation> step(const KeyLocation& location, const std::string& name) {
  std::vector<KeyLocation> found;
  const auto add = [&](const std::vector<Key>& keys, const std::string& condition) {
    const Key* key = find_key(keys, name);
    if (key == nullptr) return;
    for (KeyLocation& other : found) {
      if (other.type != key->type.get() || other.key->description != key->description) continue;
      if (!condition.empty()) other.condition += ", " + condition.substr(condition.find(": ") + 2);
      return;
    }
    found.push_back({key_path(location.path, name), key->type.get(), key, condition});
  };
  if (location.type->kind == Kind::named) {
    add(location.type->keys, "");
    if (!found.empty()) return found;
    const KeyLocation item{key_path(location.path, "<name>"), location.type->item.get(), nullptr, ""};
    // "bearings.supply" means that of any bearing; else the word is a name.
    std::vector<KeyLocation> below = step(item, name);
    return below.empty() ? std::vector<KeyLocation>{item} : below;
  }
  for (const Type* mapping : mappings_of(*location.type)) {
    add(mapping->keys, "");
    for (const Variant& variant : mapping->variants) add(variant.keys, mapping->tag + ": " + variant.tag);
    if (mapping->tag == name && found.empty())
      found.push_back({key_path(location.path, name), mapping, nullptr, "", true});
  }
  return found;
}

std::vector<std::string> names_below(const KeyLocation& location) {
  std::vector<std::string> names;
  for (const Type* mapping : mappings_of(*location.type)) {
    if (!mapping->tag.empty()) names.push_back(mapping->tag);
    for (const Key* key : all_keys(*mapping)) {
      if (std::find(names.begin(), names.end(), key->name) == names.end()) names.push_back(key->name);
    }
  }
  return names;
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> keys;
  std::istringstream stream(path);
  for (std::string key; std::getline(stream, key, '.');) keys.push_back(key);
  return keys;
}

std::vector<KeyLocation> find_locations(const std::string& path) {
  std::vector<KeyLocation> locations{{"", &model_format(), nullptr, ""}};
  for (const std::string& key : split(path)) {
    std::vector<KeyLocation> next;
    for (const KeyLocation& location : locations) {
      if (location.type->kind == Kind::list && is_item_number(key)) {
        next.push_back({key_path(location.path, key), location.type->item.get(), location.key, location.condition});
        continue;
      }
      for (KeyLocation& found : step(location, key)) {
        if (found.condition.empty()) found.condition = location.condition;
        next.push_back(std::move(found));
      }
    }
    if (next.empty()) {
      std::vector<std::string> names;
      for (const KeyLocation& location : locations)
        for (const std::string& name : names_below(location)) names.push_back(name);
      const std::string where = locations.front().path.empty() ? "the model" : locations.front().path;
      throw InputError(Fault{{path, 0, 0},
                             "",
                             "unknown key '" + key + "' of " + where,
                             names.empty() ? where + " has no keys" : one_of(names),
                             did_you_mean(key, names)});
    }
    locations = std::move(next);
  }
  return locations;
}

/// Text in lines of `kWidth`, each indented by `indent` blanks; the first one follows `first`.
std::string wrapped(const std::string& first, const std::string& text, std::size_t indent) {
  std::string lines, line = first;
  line.resize(std::max(line.size(), indent), ' ');
  std::istringstream words(text);
  bool is_begun = false;
  for (std::string word; words >> word;) {
    if (is_begun && line.size() + 1 + word.size() > kWidth) {
      lines += line + "\n";
      line = std::string(indent, ' ');
      is_begun = false;
    }
    line += (is_begun ? " " : "") + word;
    is_begun = true;
  }
  return lines + line + "\n";
}

std::string plain(std::string text) {
  std::erase(text, '*');
  return text;
}

std::string default_of(const Key& key) {
  if (key.required) return "none: it has to be given";
  if (key.default_text && *key.default_text == "{}") return "that of its keys";
  if (key.default_text) return key.default_text->empty() ? "empty" : *key.default_text;
  return key.default_note.empty() ? "left out" : plain(key.default_note);
}

std::string value_of(const Type& type) {
  if (type.kind == Kind::list) return type.title + ": " + type.item->expectation();
  return type.expectation();
}

void add_words(const Type& type, std::string& text) {
  std::size_t widest = 0;
  for (const Word& word : type.words) widest = std::max(widest, word.text.size());
  for (const Word& word : type.words) text += wrapped("      " + word.text, word.description, widest + 8);
}

/// Adds the allowed words of a value, and its usual units.
void add_details(const Type& type, std::string& text) {
  add_words(type, text);
  for (const std::string& unit : type.units) {
    const Dimension& dimension = dimension_of(unit);
    if (dimension.spelled.empty()) continue;
    std::string units;
    for (const std::string& spelled : dimension.spelled) units += (units.empty() ? "" : ", ") + spelled;
    text += wrapped("  units", units, 11);
  }
  for (const TypePtr& alternative : type.alternatives)
    if (!has_keys(*alternative)) add_details(*alternative, text);
}

void add_keys(const std::vector<Key>& keys, std::string& text) {
  std::size_t widest = 0;
  for (const Key& key : keys) widest = std::max(widest, key.name.size());
  for (const Key& key : keys) {
    const std::string value = key.required ? "required; " : "default " + default_of(key) + "; ";
    text += wrapped("    " + key.name, plain(key.description) + " (" + value + value_of(*key.type) + ")", widest + 6);
  }
}

void add_mapping(const Type& type, std::string& text) {
  if (!type.keys.empty()) text += "  keys\n";
  add_keys(type.keys, text);
  for (const Variant& variant : type.variants) {
    text += wrapped("  " + type.tag + ": " + variant.tag, " - " + variant.description, 0);
    add_keys(variant.keys, text);
  }
}

std::string text_of(const KeyLocation& location) {
  std::string text = location.path + (location.condition.empty() ? "" : "   (" + location.condition + ")") + "\n";
  if (location.key != nullptr) text += wrapped("", plain(location.key->description), 2);
  text += wrapped("  value", value_of(*location.type), 11);
  if (location.key != nullptr) text += wrapped("  default", default_of(*location.key), 11);
  add_details(*location.type, text);
  const Type* of = location.type;
  if (of->kind == Kind::named) {
    text += "  a mapping from names of your choice; each has\n";
    of = of->item.get();
    if (!location.type->keys.empty()) add_mapping(*location.type, text);
  }
  for (const Type* mapping : mappings_of(*of)) add_mapping(*mapping, text);
  return text;
}

std::string kind_in_words(const Type& type) {
  switch (type.kind) {
    case Kind::text:
    case Kind::part:
      return "text";
    case Kind::scalar:
    case Kind::scale:
      return "scalar";
    case Kind::integer:
      return "integer";
    case Kind::quantity:
      return "quantity";
    case Kind::choice:
      return "choice";
    case Kind::reference:
      return "reference";
    case Kind::object:
    case Kind::variant:
      return "mapping";
    case Kind::named:
      return "named";
    case Kind::list:
      return "list";
    case Kind::any_of:
      break;
  }
  return kind_in_words(*type.alternatives.front());
}

/// Adds the words and units of a value: of each alternative that is none of keys.
void collect_words(const Type& type, KeyExplanation& into) {
  for (const Word& word : type.words) into.allowed.emplace_back(word.text, plain(word.description));
  if (type.kind == Kind::variant)
    for (const Variant& one : type.variants) into.allowed.emplace_back(one.tag, plain(one.description));
  for (const std::string& unit : type.units) {
    if (into.unit.empty() && unit != "1") into.unit = unit;
    for (const std::string& spelled : dimension_of(unit).spelled)
      if (std::find(into.units.begin(), into.units.end(), spelled) == into.units.end()) into.units.push_back(spelled);
  }
  for (const TypePtr& alternative : type.alternatives) collect_words(*alternative, into);
}

KeyExplanation explained(const KeyLocation& location) {
  KeyExplanation found{.path = location.path, .condition = location.condition};
  if (location.key != nullptr) {
    found.text = plain(location.key->description);
    found.default_text = default_of(*location.key);
    found.is_required = location.key->required;
  }
  found.kind = kind_in_words(*location.type);
  found.value = value_of(*location.type);
  collect_words(*location.type, found);
  if (location.is_tag) {
    found.kind = "choice";
    return found;
  }
  const Type& of = location.type->kind == Kind::named ? *location.type->item : *location.type;
  for (const Type* mapping : mappings_of(of))
    for (const Key* key : all_keys(*mapping)) {
      const auto is_same = [&](const auto& one) { return one.first == key->name; };
      if (std::none_of(found.keys.begin(), found.keys.end(), is_same))
        found.keys.emplace_back(key->name, plain(key->description));
    }
  return found;
}

/// The variant that is taken where none is chosen; else the first.
const Variant& usual_variant(const Type& type) {
  const auto usual = std::find_if(type.variants.begin(), type.variants.end(),
                                  [&](const Variant& one) { return one.tag == type.default_tag; });
  return usual == type.variants.end() ? type.variants.front() : *usual;
}

constexpr int kDeepestExample = 5;

std::string example_of(const Type& type, int depth);

/// "{duration: 1 s, step: 0.1 ms}": the keys that have to be given.
std::string example_of_keys(const Type& type, int depth) {
  std::string text;
  const auto add = [&](const std::string& name, const std::string& value) {
    text += (text.empty() ? "" : ", ") + name + ": " + value;
  };
  std::vector<const Key*> keys;
  for (const Key& key : type.keys) keys.push_back(&key);
  if (type.kind == Kind::variant) {
    const Variant& chosen = usual_variant(type);
    if (chosen.tag != type.default_tag) add(type.tag, chosen.tag);
    for (const Key& key : chosen.keys) keys.push_back(&key);
  }
  const auto is_chosen = [&](const Key& key) {
    return std::any_of(type.exactly_one.begin(), type.exactly_one.end(),
                       [&](const std::vector<std::string>& group) { return group.front() == key.name; });
  };
  for (const Key* key : keys)
    if (key->required || is_chosen(*key)) add(key->name, example_of(*key->type, depth + 1));
  return "{" + text + "}";
}

std::string example_of(const Type& type, int depth) {
  if (depth > kDeepestExample) return "{}";
  switch (type.kind) {
    case Kind::choice:
      return type.words.front().text;
    case Kind::object:
    case Kind::variant:
      return example_of_keys(type, depth);
    case Kind::named:
      return "{" + (type.example.empty() ? std::string("main") : type.example) + ": " +
             example_of(*type.item, depth + 1) + "}";
    case Kind::list: {
      std::string items = example_of(*type.item, depth + 1);
      const std::string one = items;
      for (int i = 1; i < type.count; ++i) items += ", " + one;
      return "[" + items + "]";
    }
    case Kind::any_of:
      return example_of(*type.alternatives.front(), depth);
    default:
      break;
  }
  if (type.example.empty()) return type.kind == Kind::integer ? "1" : "0";
  const bool needs_quotes = type.example.find_first_of(",:{}[]#&*!|>'\"%@`") != std::string::npos;
  return needs_quotes ? "\"" + type.example + "\"" : type.example;
}

}  // namespace

std::vector<KeyExplanation> key_explanations(const std::string& path) {
  std::vector<KeyExplanation> found;
  if (path.empty()) return found;
  for (const KeyLocation& location : find_locations(path)) found.push_back(explained(location));
  return found;
}

std::string example_value(const std::string& path) {
  const KeyLocation location = find_locations(path).front();
  return location.is_tag ? usual_variant(*location.type).tag : example_of(*location.type, 0);
}

std::string explanation(const std::string& path) {
  std::string text;
  if (path.empty()) {
    add_keys(model_format().keys, text);
    return "Sections of a model; `hersey explain bearings.X.supply` goes into them.\n" + text;
  }
  for (const KeyLocation& location : find_locations(path)) text += (text.empty() ? "" : "\n") + text_of(location);
  return text;
}

}  // namespace hersey::model
