#include <algorithm>
#include <map>

#include "hersey/core/units.h"
#include "hersey/model/schema.h"
#include "schema/format.h"
#include "schema/reference_text.h"

namespace hersey::model {
namespace {

using Kind = Type::Kind;

std::string code(const std::string& text) { return "`" + text + "`"; }

/// Text inside a cell of a table.
std::string cell(std::string text) {
  for (auto at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, "\\");
  return text;
}

std::string words_of(const std::vector<Word>& words) {
  std::string text;
  for (const Word& word : words) text += (text.empty() ? "" : "; ") + code(word.text) + ": " + word.description;
  return text;
}

bool has_section(const Type& type) {
  if (type.kind == Kind::list) return has_section(*type.item);
  if (type.kind == Kind::any_of) {
    return std::any_of(type.alternatives.begin(), type.alternatives.end(),
                       [](const TypePtr& alternative) { return has_section(*alternative); });
  }
  if (type.kind == Kind::named) return has_section(*type.item) || !type.keys.empty();
  return type.kind == Kind::object || type.kind == Kind::variant;
}

class ReferenceWriter {
 public:
  std::string page() {
    page_ = reference_introduction;
    section("Top level", "", model_format());
    page_ += "\n## Functions\n\n" + std::string(reference_functions);
    in_functions_ = true;
    const TypePtr function = function_format({"N"}, "500 N");
    for (const TypePtr& alternative : function->alternatives) {
      if (alternative->kind == Kind::object) write_object("", *alternative, alternative->keys);
    }
    page_ += "\n## Units\n\n" + units_table();
    return page_;
  }

 private:
  /// The heading of a structured value and everything inside it.
  void section(const std::string& title, const std::string& path, const Type& type) {
    const std::string level = path.find('.') == std::string::npos ? "## " : "### ";
    page_ += "\n" + level + (path.empty() ? title : code(path)) + "\n";
    const auto [described, is_new] = described_.try_emplace(&type, path);
    if (is_new) {
      write(path, type);
    } else {
      page_ += "\nAs " + code(described->second) + ".\n";
    }
  }

  void write(const std::string& path, const Type& type) {
    if (type.kind == Kind::named) {
      write_named(path, type);
    } else if (type.kind == Kind::variant) {
      write_variant(path, type);
    } else if (type.kind == Kind::object) {
      write_object(path, type, type.keys);
    } else if (type.kind == Kind::any_of) {
      for (const TypePtr& alternative : type.alternatives) {
        if (has_section(*alternative)) write(path, *alternative);
      }
    }
  }

  void write_named(const std::string& path, const Type& type) {
    page_ += "\nA mapping from names of your choice; each value is " + type.item->title + ".\n";
    write(path + ".<name>", *type.item);
    for (const Key& key : type.keys) section("", path + "." + key.name, *key.type);
  }

  void write_object(const std::string& path, const Type& type, const std::vector<Key>& keys) {
    write_table(keys);
    write_groups(type, keys);
    write_children(path, keys);
  }

  void write_variant(const std::string& path, const Type& type) {
    page_ += "\nThe key " + code(type.tag) + " decides:\n\n";
    for (const Variant& variant : type.variants) {
      page_ += "- " + code(type.tag + ": " + variant.tag) + ": " + variant.description +
               (variant.tag == type.default_tag ? " (the default)" : "") + "\n";
    }
    if (is_shorthand_useful(type)) {
      page_ += "\nWhere nothing else is to be said, the word alone will do (" + code(type.variants.front().tag) +
               " for " + code("{" + type.tag + ": " + type.variants.front().tag + "}") + ").\n";
    }
    if (!type.keys.empty()) {
      page_ += "\nAll of them have\n";
      write_table(type.keys);
    }
    write_variants_keys(type);
    std::vector<Key> children = type.keys;
    std::vector<std::pair<std::string, Key>> others;  // of a variant, with the name of another's key
    for (const Variant& variant : type.variants) {
      for (const Key& key : variant.keys) {
        const Key* known = find_key(children, key.name);
        if (known == nullptr) {
          children.push_back(key);
        } else if (!type.default_tag.empty() && has_section(*key.type) &&
                   !have_the_same_keys(*known->type, *key.type)) {
          others.emplace_back(variant.tag, key);
        }
      }
    }
    write_children(path, children);
    for (const auto& [tag, key] : others) write_children(of_tag(path, tag), {key});
  }

  static bool have_the_same_keys(const Type& a, const Type& b) {
    if (&a == &b) return true;
    if (a.kind != b.kind || a.title != b.title) return false;
    const std::vector<const Key*> of_a = all_keys(a), of_b = all_keys(b);
    return std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                      [](const Key* x, const Key* y) { return x->name == y->name; });
  }

  /// "bearings.<plane_slider>" of "bearings.<name>": the path to keys that another variant has, too.
  static std::string of_tag(const std::string& path, const std::string& tag) {
    const std::size_t name = path.rfind("<name>");
    return name == std::string::npos ? path : path.substr(0, name) + "<" + tag + ">" + path.substr(name + 6);
  }

  /// Variants with the same keys share a table.
  void write_variants_keys(const Type& type) {
    for (std::size_t i = 0; i < type.variants.size(); ++i) {
      const Variant& variant = type.variants[i];
      if (variant.keys.empty() || repeats_earlier(type, i)) continue;
      std::string tags = code(variant.tag);
      for (std::size_t j = i + 1; j < type.variants.size(); ++j) {
        if (same_names(variant, type.variants[j])) tags += ", " + code(type.variants[j].tag);
      }
      page_ += "\n**" + type.tag + "** " + tags + "\n";
      write_table(variant.keys);
      write_groups(type, variant.keys);
      write_initial(variant.keys);
    }
  }

  /// A joint's initial values differ from type to type: they follow their type's table at once.
  void write_initial(const std::vector<Key>& keys) {
    const Key* initial = find_key(keys, "initial");
    if (initial == nullptr) return;
    page_ += "\nKeys of " + code("initial") + ":\n";
    write_table(initial->type->keys);
  }

  static bool same_names(const Variant& a, const Variant& b) {
    return std::equal(a.keys.begin(), a.keys.end(), b.keys.begin(), b.keys.end(), [](const Key& x, const Key& y) {
      return x.name == y.name && !has_section(*x.type) && x.type->units == y.type->units;
    });
  }

  static bool repeats_earlier(const Type& type, std::size_t i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (same_names(type.variants[j], type.variants[i])) return true;
    }
    return false;
  }

  static bool is_shorthand_useful(const Type& type) {
    const auto is_required = [](const Key& key) { return key.required; };
    return std::none_of(type.keys.begin(), type.keys.end(), is_required) &&
           std::none_of(type.variants.front().keys.begin(), type.variants.front().keys.end(), is_required);
  }

  void write_table(const std::vector<Key>& keys) {
    page_ += "\n| key | value | default | meaning |\n|---|---|---|---|\n";
    for (const Key& key : keys) {
      page_ += "| " + code(key.name) + " | " + cell(value_text(*key.type)) + " | " + cell(default_text(key)) + " | " +
               cell(key.description) + " |\n";
    }
  }

  void write_groups(const Type& type, const std::vector<Key>& keys) {
    const auto sentence = [&](const std::vector<std::string>& group, const std::string& rule) {
      if (find_key(keys, group.front()) == nullptr) return;
      std::string names;
      for (const std::string& name : group) names += (names.empty() ? "" : " and ") + code(name);
      page_ += "\nOf " + names + ", " + rule + ".\n";
    };
    for (const auto& group : type.exactly_one) sentence(group, "exactly one is given");
    for (const auto& group : type.together) sentence(group, "both are given or neither");
  }

  void write_children(const std::string& path, const std::vector<Key>& keys) {
    for (const Key& key : keys) {
      if (is_function(*key.type) || !has_section(*key.type) || key.name == "initial") continue;
      const Type& type = key.type->kind == Kind::list ? *key.type->item : *key.type;
      if (is_function(type)) continue;
      if (in_functions_) {
        page_ += "\n" + code(key.name) + " is one of\n";
        write("", type);
      } else {
        section("", path.empty() ? key.name : path + "." + key.name, type);
      }
    }
  }

  static bool is_function(const Type& type) { return type.id.starts_with("function"); }

  static std::string value_text(const Type& type) {
    if (is_function(type)) return "[function](#functions), such as " + code(type.alternatives.front()->example);
    switch (type.kind) {
      case Kind::choice:
        return words_of(type.words);
      case Kind::list:
        return type.title + (type.count > 0 ? "" : ", any number of them") + ": " + value_text(*type.item);
      case Kind::any_of:
      case Kind::object:
      case Kind::named:
      case Kind::variant:
        return type.title;
      default:
        break;
    }
    if (type.example.empty()) return type.expectation();
    const std::string expectation = type.expectation();
    return expectation.substr(0, expectation.size() - type.example.size()) + code(type.example);
  }

  static std::string default_text(const Key& key) {
    if (key.required) return "**required**";
    if (key.default_text && *key.default_text == "{}") return "as below";
    if (key.default_text && !key.default_text->empty()) return code(*key.default_text);
    return key.default_note.empty() ? "-" : key.default_note;
  }

  static std::string units_table() {
    std::string table = "| quantity | units, among others | example |\n|---|---|---|\n";
    for (const Dimension& dimension : dimensions()) {
      if (dimension.spelled.empty()) continue;
      std::string units;
      for (const std::string& unit : dimension.spelled) units += (units.empty() ? "" : ", ") + code(unit);
      table += "| " + dimension.name + " | " + units + " | " + code(dimension.example) + " |\n";
    }
    return table;
  }

  std::string page_;
  std::map<const Type*, std::string> described_;  ///< descriptions of types used several times
  bool in_functions_ = false;
};

}  // namespace

std::string schema_markdown() { return ReferenceWriter().page(); }

}  // namespace hersey::model
