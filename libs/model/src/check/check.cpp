#include "check/check.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <mutex>

#include "check/bare_numbers_in.h"
#include "hersey/core/contract.h"
#include "hersey/core/quantity_formula.h"
#include "hersey/core/spelling.h"
#include "hersey/core/units.h"

namespace hersey::model {
namespace {

using Kind = Type::Kind;

bool is_scalar_kind(Kind kind) {
  return kind == Kind::text || kind == Kind::scalar || kind == Kind::integer || kind == Kind::quantity ||
         kind == Kind::choice || kind == Kind::reference || kind == Kind::scale;
}

bool is_mapping_kind(Kind kind) { return kind == Kind::object || kind == Kind::named || kind == Kind::variant; }

std::string joined(const std::string& path, const std::string& key) { return path.empty() ? key : path + "." + key; }

/// "'a' and 'b'".
std::string enumeration(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : " and '") + name + "'";
  return text;
}

bool is_word_of(const Type& type, const std::string& text) {
  return std::any_of(type.words.begin(), type.words.end(), [&](const Word& word) { return word.text == text; });
}

std::vector<std::string> words_of(const Type& type) {
  std::vector<std::string> names;
  for (const Word& word : type.words) names.push_back(word.text);
  return names;
}

/// Location and path of a value: all that a check needs besides node and type.
struct Location {
  std::string path;
  SourcePosition key_position;
};

class Checker {
 public:
  Checker(std::vector<Fault>& faults, std::map<std::string, SourcePosition>& positions)
      : faults_(faults), positions_(positions) {}

  /// Where to note numbers without unit; null: nowhere.
  void note_bare_numbers(std::vector<BareNumber>* into) { bare_ = into; }

  Value check(const Node& node, const Type& type, const Location& location) {
    Value value;
    value.type = &type;
    value.position = node.position;
    value.key_position = location.key_position;
    value.path = location.path;
    value.text_offset = node.text_offset;
    // Templates have been put in: what is left of them says nothing.
    if (node.reported || type.kind == Kind::part) {
      value.broken = true;
    } else if (is_scalar_kind(type.kind)) {
      check_scalar(node, value);
    } else if (type.kind == Kind::any_of) {
      check_any_of(node, value);
    } else if (type.kind == Kind::list) {
      check_list(node, value);
    } else {
      check_mapping(node, value);
    }
    return value;
  }

 private:
  void fault(Value& value, std::string found, std::string expected, std::string suggestion = {}) {
    fault_at(value.position, value.path, std::move(found), std::move(expected), std::move(suggestion));
    value.broken = true;
  }

  void fault_at(const SourcePosition& at, const std::string& path, std::string found, std::string expected,
                std::string suggestion = {}) {
    faults_.push_back({at, path, std::move(found), std::move(expected), std::move(suggestion)});
  }

  void check_scalar(const Node& node, Value& value) {
    const Type& type = *value.type;
    // [0, 48, 0] with units on each number is as good as "0 48 0 mm".
    if (type.kind == Kind::quantity && type.count > 1 && node.kind == Node::Kind::sequence) {
      return check_quantity_list(node, value);
    }
    if (node.kind != Node::Kind::scalar) return fault(value, description_of(node), type.expectation());
    value.text = node.text;
    value.formula = node.formula;
    switch (type.kind) {
      case Kind::integer:
        return check_integer(node, value);
      case Kind::quantity:
        return check_quantity(node, value);
      case Kind::choice:
        return check_choice(node, value);
      case Kind::reference:
        return check_reference(node, value);
      default:
        return;  // text, scalar and scale: whoever uses them knows more
    }
  }

  void check_integer(const Node& node, Value& value) {
    const std::optional<double> number = integer_of(node);
    if (!number || !value.type->range.contains(*number)) {
      return fault(value, description_of(node), value.type->expectation());
    }
    value.number = *number;
  }

  static std::optional<double> integer_of(const Node& node) {
    long number = 0;
    const char* end = node.text.data() + node.text.size();
    const auto result = std::from_chars(node.text.data(), end, number);
    if (node.formula.empty() && result.ec == std::errc{} && result.ptr == end) return static_cast<double>(number);
    if (node.origin.empty()) return std::nullopt;
    try {
      const Quantity computed = evaluate_formula(node.formula.empty() ? node.text : node.formula);
      const bool is_integer = computed.unit.empty() && computed.number == std::round(computed.number);
      return is_integer ? std::optional(computed.number) : std::nullopt;
    } catch (const QuantityError&) {
      return std::nullopt;
    }
  }

  void check_choice(const Node& node, Value& value) {
    if (is_word_of(*value.type, node.text)) return;
    const std::vector<std::string> names = words_of(*value.type);
    fault(value, description_of(node), one_of(names), did_you_mean(node.text, names));
  }

  void check_reference(const Node& node, Value& value) {
    const auto dot = node.text.find('.');
    const bool may_have_dot = value.type->refers == Refers::frame || value.type->refers == Refers::shape;
    const bool needs_dot = value.type->refers == Refers::shape;
    const bool well_formed = needs_dot && dot == std::string::npos ? false
                             : may_have_dot && dot != std::string::npos
                                 ? is_name(node.text.substr(0, dot)) && is_name(node.text.substr(dot + 1))
                                 : is_name(node.text);
    if (!well_formed) fault(value, description_of(node), value.type->expectation());
  }

  void check_quantity(const Node& node, Value& value) {
    const Type& type = *value.type;
    if (is_word_of(type, node.text)) return;
    value.text.clear();
    try {
      value.numbers = parse_in_first_fitting_unit(node, type, value.unit);
    } catch (const QuantityError& error) {
      if (bare_ != nullptr && is_bare(node))
        bare_->push_back({value.path, type.units.front(), parameter_of(node.origin)});
      // The origin names ${load} to the user at the location of the faulty text.
      const std::string from = node.origin.empty() ? "" : " (from " + node.origin + ")";
      const std::string hint = error.suggestion.empty() ? did_you_mean(node.text, words_of(type)) : error.suggestion;
      const bool is_about_the_number =
          error.is_about_size || error.expected == "a finite number" || error.expected == "a decimal point";
      return fault(value, error.found + from, is_about_the_number ? error.expected : type.expectation(), hint);
    }
    value.number = value.numbers.front();
    const auto allowed = [&](double x) { return type.range.contains(x); };
    if (!std::all_of(value.numbers.begin(), value.numbers.end(), allowed)) {
      fault(value, description_of(node), type.expectation());
    }
  }

  /// The first unit of the type that the text fits; a text that fits none gets the error about the first.
  static std::vector<double> parse_in_first_fitting_unit(const Node& node, const Type& type, std::string& unit) {
    std::optional<QuantityError> first_error;
    for (const std::string& candidate : type.units) {
      try {
        std::vector<double> numbers = numbers_in(candidate, node, type.count);
        unit = type.units.size() > 1 && is_bare(node) ? "" : candidate;
        return numbers;
      } catch (const QuantityError& error) {
        if (!first_error) first_error = error;
      }
    }
    throw *first_error;
  }

  /// Written out, or computed where a parameter stands; "${number} ${unit}" is no formula and read as text.
  static std::vector<double> numbers_in(const std::string& unit, const Node& node, int count) {
    const auto computed = [&](const std::string& formula) {
      std::vector<double> numbers;
      for (const Quantity& part : evaluate_formulas(formula, count)) numbers.push_back(convert_to_si(part, unit));
      return numbers;
    };
    const bool is_formula = !node.formula.empty();
    try {
      return is_formula ? computed(node.formula) : parse_quantities(node.text, unit, count);
    } catch (const QuantityError& error) {
      if (is_formula ? !node.is_pasted : node.origin.empty()) throw;
      try {
        return is_formula ? parse_quantities(node.text, unit, count) : computed(node.text);
      } catch (const QuantityError&) {
        throw error;
      }
    }
  }

  /// The name in "parameter load in line 5"; none of several parameters.
  static std::string parameter_of(const std::string& origin) {
    constexpr std::string_view kPrefix = "parameter ";
    if (!origin.starts_with(kPrefix) || origin.find(", parameter ") != std::string::npos) return "";
    return origin.substr(kPrefix.size(), origin.find(' ', kPrefix.size()) - kPrefix.size());
  }

  /// A bare number, which of several units has none.
  static bool is_bare(const Node& node) {
    try {
      return (node.formula.empty() ? split_quantity(node.text) : evaluate_formula(node.formula)).unit.empty();
    } catch (const QuantityError&) {
      return false;
    }
  }

  void check_quantity_list(const Node& node, Value& value) {
    Type one = *value.type;
    one.count = 1;
    one.words.clear();
    if (static_cast<int>(node.items.size()) != value.type->count) {
      return fault(value, "a list of " + std::to_string(node.items.size()), value.type->expectation());
    }
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const Node& item = node.items[i];
      const Value checked = check(item, one, {joined(value.path, std::to_string(i)), item.position});
      value.broken = value.broken || checked.broken;
      value.numbers.push_back(checked.number);
    }
  }

  void check_list(const Node& node, Value& value) {
    const Type& type = *value.type;
    const bool right_count = type.count == 0 ? !node.items.empty() : static_cast<int>(node.items.size()) == type.count;
    if (node.kind != Node::Kind::sequence || !right_count) {
      const std::string found =
          node.kind == Node::Kind::sequence ? "a list of " + std::to_string(node.items.size()) : description_of(node);
      const std::string such_as = type.count == 0 ? ", such as [" : " in brackets, such as [";
      std::string example = type.item->example;
      for (int i = 1; i < type.count; ++i) example += ", " + type.item->example;
      return fault(value, found, type.title + (type.item->example.empty() ? "" : such_as + example + "]"));
    }
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const std::string index = std::to_string(i);
      const Node& item = node.items[i];
      value.members.push_back({index, check(item, *type.item, {joined(value.path, index), item.position})});
    }
  }

  void check_any_of(const Node& node, Value& value) {
    const auto& alternatives = value.type->alternatives;
    std::vector<std::size_t> fitting;
    for (std::size_t i = 0; i < alternatives.size(); ++i) {
      const Kind kind = alternatives[i]->kind;
      const bool fits = node.kind == Node::Kind::scalar     ? is_scalar_kind(kind)
                        : node.kind == Node::Kind::sequence ? kind == Kind::list
                        : node.kind == Node::Kind::mapping  ? is_mapping_kind(kind)
                                                            : false;
      if (fits) fitting.push_back(i);
    }
    if (fitting.empty()) return fault(value, description_of(node), value.type->title);
    value.alternative = fitting.front();
    if (fitting.size() > 1 && !choose_by_first_key(node, fitting, value)) return;
    value.members.push_back({"", check(node, *alternatives[value.alternative], {value.path, value.key_position})});
    value.broken = value.members.front().value.broken;
  }

  /// Chooses, among several mappings, the one that has the first key, else the one whose keys are nearest to those
  /// given.
  bool choose_by_first_key(const Node& node, const std::vector<std::size_t>& fitting, Value& value) {
    std::vector<std::string> first_keys;
    for (const std::size_t i : fitting) {
      first_keys.push_back(value.type->alternatives[i]->keys.front().name);
      if (node.find(first_keys.back()) == nullptr) continue;
      value.alternative = i;
      return true;
    }
    for (const Entry& entry : node.entries) {
      const std::string near = nearest_name(entry.key, first_keys);
      if (near.empty()) continue;
      fault_at(entry.position, value.path, "unknown key '" + entry.key + "'", one_of(first_keys),
               "did you mean '" + near + "'?");
      value.broken = true;
      return false;
    }
    fault(value, "a mapping without any of the keys " + one_of(first_keys), value.type->title);
    return false;
  }

  void check_mapping(const Node& node, Value& value) {
    const Type& type = *value.type;
    if (type.kind == Kind::variant && node.kind == Node::Kind::scalar) return check_shorthand(node, value);
    // A mapping whose keys are all commented out reads as nothing; its missing keys are reported below.
    if (node.kind != Node::Kind::mapping && node.kind != Node::Kind::null) {
      std::string expected = type.title;
      if (is_mapping_kind(type.kind) && !expected.starts_with("a mapping")) expected += " {key: value, ...}";
      return fault(value, description_of(node), expected);
    }
    if (type.kind == Kind::named) return check_named(node, value);
    std::vector<const Key*> keys;
    for (const Key& key : type.keys) keys.push_back(&key);
    if (type.kind == Kind::variant && !choose_variant(node, value, keys)) return;
    check_keys(node, value, keys);
    check_groups(node, value, keys);
  }

  /// "compliance: rigid" is short for "compliance: {model: rigid}".
  void check_shorthand(const Node& node, Value& value) {
    Node mapping{.kind = Node::Kind::mapping, .position = node.position};
    mapping.entries.push_back({value.type->tag, node.position, node});
    check_mapping(mapping, value);
  }

  /// Finds the variant its tag names and adds the variant's keys; false where the tag is missing or unknown.
  bool choose_variant(const Node& node, Value& value, std::vector<const Key*>& keys) {
    const Type& type = *value.type;
    std::vector<std::string> tags;
    for (const Variant& variant : type.variants) tags.push_back(variant.tag);
    const Node* tag = node.find(type.tag);
    const Node usual{.kind = Node::Kind::scalar, .position = node.position, .text = type.default_tag};
    if (tag == nullptr && !type.default_tag.empty()) tag = &usual;
    if (tag == nullptr) {
      report_missing(value, type.tag, one_of(tags));
      return false;
    }
    const auto chosen = std::find(tags.begin(), tags.end(), tag->text);
    if (tag->kind != Node::Kind::scalar || chosen == tags.end()) {
      fault_at(tag->position, joined(value.path, type.tag), description_of(*tag), one_of(tags),
               did_you_mean(tag->text, tags));
      value.broken = true;
      return false;
    }
    value.text = *chosen;
    std::vector<const Key*> own;
    for (const Key& key : type.variants[static_cast<std::size_t>(chosen - tags.begin())].keys) own.push_back(&key);
    // Where a tag may be left out, the keys of the variant say more of it than those that all have.
    keys.insert(type.default_tag.empty() ? keys.end() : keys.begin(), own.begin(), own.end());
    return true;
  }

  void check_keys(const Node& node, Value& value, const std::vector<const Key*>& keys) {
    for (const Entry& entry : node.entries) {
      positions_[joined(value.path, entry.key)] = entry.position;
      const auto is_called = [&](const Key* key) { return key->name == entry.key; };
      const bool is_tag = has_tag(*value.type) && entry.key == value.type->tag;
      if (!is_tag && std::none_of(keys.begin(), keys.end(), is_called))
        report_unknown_key(entry, value, names_of(*value.type, keys));
    }
    for (const Key* key : keys) {
      const auto location = [&] {
        return Location{joined(value.path, key->name), position_of(node, key->name, value)};
      };
      const Node* child = node.find(key->name);
      if (child != nullptr) {
        value.members.push_back({key->name, check(*child, *key->type, location())});
      } else if (key->required) {
        report_missing(value, key->name, key->type->expectation());
      } else if (key->default_text) {
        value.members.push_back({key->name, default_value(*key, location())});
      }
    }
  }

  static bool has_tag(const Type& type) { return type.kind == Kind::variant || !type.default_tag.empty(); }

  /// Of all keys that a mapping may have; a tag that may be left out comes last.
  static std::vector<std::string> names_of(const Type& type, const std::vector<const Key*>& keys) {
    std::vector<std::string> names;
    const bool is_tag_required = type.default_tag.empty();
    if (has_tag(type) && is_tag_required) names.push_back(type.tag);
    for (const Key* key : keys) names.push_back(key->name);
    if (!is_tag_required) names.push_back(type.tag);
    return names;
  }

  void report_unknown_key(const Entry& entry, const Value& value, const std::vector<std::string>& names) {
    // A key of another variant deserves its own remark.
    for (const Variant& variant : value.type->variants) {
      if (find_key(variant.keys, entry.key) == nullptr) continue;
      const std::string owner = value.type->tag + " " + value.text;
      return fault_at(entry.position, value.path, "key '" + entry.key + "', which " + owner + " does not have",
                      one_of(names), "'" + entry.key + "' belongs to " + value.type->tag + " " + variant.tag);
    }
    fault_at(entry.position, value.path, "unknown key '" + entry.key + "'", one_of(names),
             did_you_mean(entry.key, names));
  }

  void report_missing(Value& value, const std::string& key, std::string expected) {
    fault_at(value.key_position, value.path, "missing key '" + key + "'", std::move(expected));
    value.broken = true;
  }

  static SourcePosition position_of(const Node& node, const std::string& key, const Value& value) {
    for (const Entry& entry : node.entries) {
      if (entry.key == key) return entry.position;
    }
    return value.key_position;
  }

  /// The tree of a default. A model of many parts leaves the same few keys out thousands of times.
  static Node default_node(const std::string& text) {
    static std::mutex mutex;
    static std::map<std::string, Node> known;
    if (text.empty()) return Node{.kind = Node::Kind::scalar};
    const std::lock_guard lock(mutex);
    const auto [entry, is_new] = known.try_emplace(text);
    std::vector<Fault> faults;
    if (is_new) entry->second = parse_yaml(text, "", faults).value_or(Node{});
    HERSEY_REQUIRE(faults.empty(), "defaults are good YAML");
    return entry->second;
  }

  /// The value of a key that was left out; its faults, if any, would be ours.
  Value default_value(const Key& key, const Location& location) {
    Node node = default_node(*key.default_text);
    move_to(node, location.key_position);
    std::map<std::string, SourcePosition> ignored;
    Value value = Checker(faults_, ignored).check(node, *key.type, location);
    value.given = false;
    return value;
  }

  void check_groups(const Node& node, Value& value, const std::vector<const Key*>& keys) {
    const auto has_key = [&](const std::string& name) {
      return std::any_of(keys.begin(), keys.end(), [&](const Key* key) { return key->name == name; });
    };
    for (const auto& group : value.type->exactly_one) {
      if (!has_key(group.front())) continue;  // another variant's group
      std::vector<std::string> given;
      for (const std::string& name : group) {
        if (node.find(name) != nullptr) given.push_back(name);
      }
      if (given.empty()) {
        fault_at(value.key_position, value.path, "none of the keys " + enumeration(group), "exactly one of them");
      } else if (given.size() > 1) {
        fault_at(position_of(node, group.back(), value), value.path, "keys " + enumeration(group) + " together",
                 "exactly one of them");
      }
    }
    for (const auto& group : value.type->together) {
      for (const std::string& present : group) {
        if (!has_key(present) || node.find(present) == nullptr) continue;
        for (const std::string& absent : group) {
          if (node.find(absent) != nullptr) continue;
          fault_at(position_of(node, present, value), value.path, "key '" + present + "' without '" + absent + "'",
                   "both or neither");
        }
      }
    }
  }

  void check_named(const Node& node, Value& value) {
    for (const Entry& entry : node.entries) {
      const std::string path = joined(value.path, entry.key);
      positions_[path] = entry.position;
      if (!value.type->free_names && !is_name(entry.key)) {
        fault_at(entry.position, value.path, "name '" + entry.key + "'",
                 "letters, digits and _, beginning with a letter");
        continue;
      }
      const Key* special = find_key(value.type->keys, entry.key);
      const Type& type = special != nullptr ? *special->type : *value.type->item;
      value.members.push_back({entry.key, check(entry.value, type, {path, entry.position})});
    }
  }

  std::vector<Fault>& faults_;
  std::map<std::string, SourcePosition>& positions_;
  std::vector<BareNumber>* bare_ = nullptr;
};

/// True if the format has such a key, or leaves the names free.
bool may_have(const Type* type, const std::string& key) {
  if (type == nullptr || (type->kind != Kind::object && type->kind != Kind::variant)) return true;
  const std::vector<const Key*> keys = all_keys(*type);
  return std::any_of(keys.begin(), keys.end(), [&](const Key* one) { return one->name == key; });
}

}  // namespace

bool Value::has(const std::string& key) const {
  return std::any_of(members.begin(), members.end(), [&](const Member& member) { return member.key == key; });
}

const Value* Value::find(const std::string& key) const {
  for (const auto& [name, value] : members) {
    if (name == key) return &value;
  }
  HERSEY_REQUIRE(may_have(type, key), "the format knows no key '" + key + "' of " + path);
  return nullptr;
}

Value check(const Node& node, const Type& type, std::vector<Fault>& faults,
            std::map<std::string, SourcePosition>& positions) {
  return Checker(faults, positions).check(node, type, {"", node.position});
}

std::vector<BareNumber> bare_numbers_in(const Node& node, const Type& type) {
  std::vector<Fault> ignored;
  std::map<std::string, SourcePosition> positions;
  std::vector<BareNumber> found;
  Checker checker(ignored, positions);
  checker.note_bare_numbers(&found);
  (void)checker.check(node, type, {"", node.position});
  return found;
}

bool is_name(const std::string& text) {
  const auto letter = [](char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); };
  const auto other = [](char c) { return ('0' <= c && c <= '9') || c == '_'; };
  return !text.empty() && letter(text.front()) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return letter(c) || other(c); });
}

}  // namespace hersey::model
