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
    if (mapping->tag == name && found.empty()) found.push_back({key_path(location.path, name), mapping, nullptr, ""});
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

}  // namespace

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
