#include "check/schema_type.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hersey/core/spelling.h"
#include "hersey/core/units.h"

namespace hersey::model {
namespace {

std::string short_number(double x) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%g", x);
  return buffer.data();
}

std::string name_of(Refers refers) {
  switch (refers) {
    case Refers::body:
      return "a body";
    case Refers::frame:
      return "a body or body.frame";
    case Refers::shape:
      return "a shape, body.shape";
    case Refers::joint:
      return "a joint";
    case Refers::coordinate:
      return "a coordinate of the joint";
    case Refers::lubricant:
      return "a lubricant";
    case Refers::thermal_node:
      break;
  }
  return "a node of `thermal`";
}

/// The dimension's name without its article.
std::string bare_name_of(const std::string& si_unit) {
  const std::string& name = dimension_of(si_unit).name;
  return name.substr(name.find(' ') + 1);
}

std::vector<std::string> texts_of(const std::vector<Word>& words) {
  std::vector<std::string> texts;
  texts.reserve(words.size());
  for (const Word& word : words) texts.push_back(word.text);
  return texts;
}

/// "a length > 0": what a quantity is, without its example.
std::string quantity_title(const Type& type) {
  std::vector<std::string> names = texts_of(type.words);
  if (type.count == 1) {
    if (!type.title.empty()) return type.title + type.range.text();
    for (const std::string& unit : type.units) names.push_back(dimension_of(unit).name);
    return one_of(names) + type.range.text();
  }
  std::string numbers = std::to_string(type.count) + " numbers";
  if (type.units.front() != "1") numbers += " and a unit of " + bare_name_of(type.units.front());
  names.push_back(numbers);
  return one_of(names);
}

std::shared_ptr<Type> make(Type::Kind kind, std::string title, std::string example = {}) {
  auto type = std::make_shared<Type>();
  type->kind = kind;
  type->title = std::move(title);
  type->example = std::move(example);
  return type;
}

std::shared_ptr<Type> copy_of(const TypePtr& type) { return std::make_shared<Type>(*type); }

}  // namespace

bool Range::contains(double x) const { return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high); }

std::string Range::text() const {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  std::string text;
  if (has_low) text += (low_open ? " > " : " >= ") + short_number(low);
  if (has_low && has_high) text += " and";
  if (has_high) text += (high_open ? " < " : " <= ") + short_number(high);
  return text;
}

std::string Type::expectation() const {
  const std::string such_as = example.empty() ? "" : ", such as " + example;
  switch (kind) {
    case Kind::quantity:
      return quantity_title(*this) + such_as;
    case Kind::integer:
      if (range.low == range.high) return short_number(range.low);
      return "a whole number" + range.text() + such_as;
    case Kind::choice:
      return one_of(texts_of(words));
    case Kind::reference:
      return name_of(refers) + such_as;
    default:
      return title + such_as;
  }
}

TypePtr text(std::string title, std::string example) {
  return make(Type::Kind::text, std::move(title), std::move(example));
}

TypePtr scalar(std::string title, std::string example) {
  return make(Type::Kind::scalar, std::move(title), std::move(example));
}

TypePtr integer(int example, Range range) {
  auto type = make(Type::Kind::integer, "a whole number", std::to_string(example));
  type->range = range;
  return type;
}

TypePtr quantity_in(std::vector<std::string> si_units, std::string example, Range range) {
  auto type = make(Type::Kind::quantity, "", std::move(example));
  type->units = std::move(si_units);
  type->range = range;
  return type;
}

TypePtr quantity(std::string si_unit, std::string example, Range range) {
  return quantity_in({std::move(si_unit)}, std::move(example), range);
}

TypePtr called(const TypePtr& quantity, std::string title) {
  auto type = copy_of(quantity);
  type->title = std::move(title);
  return type;
}

TypePtr number(std::string example, Range range) { return quantity("1", std::move(example), range); }

TypePtr vector(std::string si_unit, std::string example) {
  auto type = copy_of(quantity(std::move(si_unit), std::move(example)));
  type->count = 3;
  return type;
}

TypePtr choice(std::vector<Word> words) {
  auto type = make(Type::Kind::choice, "a word");
  type->words = std::move(words);
  return type;
}

TypePtr or_word(const TypePtr& quantity, std::vector<Word> words) {
  auto type = copy_of(quantity);
  type->words = std::move(words);
  return type;
}

TypePtr reference(Refers refers, std::string example) {
  auto type = make(Type::Kind::reference, "", std::move(example));
  type->refers = refers;
  return type;
}

TypePtr scale_factor(std::string example) {
  return make(Type::Kind::scale, "a number with a unit", std::move(example));
}

TypePtr object(std::string title, std::vector<Key> keys) {
  auto type = make(Type::Kind::object, std::move(title));
  type->keys = std::move(keys);
  return type;
}

TypePtr named(std::string title, TypePtr item, std::vector<Key> special) {
  auto type = make(Type::Kind::named, std::move(title));
  type->item = std::move(item);
  type->keys = std::move(special);
  return type;
}

TypePtr list(std::string title, TypePtr item, int count) {
  auto type = make(Type::Kind::list, std::move(title));
  type->item = std::move(item);
  type->count = count;
  return type;
}

TypePtr variant(std::string title, std::string tag, std::vector<Key> common, std::vector<Variant> variants) {
  auto type = make(Type::Kind::variant, std::move(title));
  type->tag = std::move(tag);
  type->keys = std::move(common);
  type->variants = std::move(variants);
  return type;
}

TypePtr any_of(std::string title, std::vector<TypePtr> alternatives) {
  auto type = make(Type::Kind::any_of, std::move(title));
  type->alternatives = std::move(alternatives);
  return type;
}

TypePtr part(std::string title, std::string example, std::string id) {
  return with_id(make(Type::Kind::part, std::move(title), std::move(example)), std::move(id));
}

TypePtr with_id(const TypePtr& type, std::string id) {
  auto copy = copy_of(type);
  copy->id = std::move(id);
  return copy;
}

TypePtr with_default_tag(const TypePtr& type, std::string tag) {
  auto copy = copy_of(type);
  copy->default_tag = std::move(tag);
  return copy;
}

TypePtr with_exactly_one(const TypePtr& type, std::vector<std::string> keys) {
  auto copy = copy_of(type);
  copy->exactly_one.push_back(std::move(keys));
  return copy;
}

TypePtr with_together(const TypePtr& type, std::vector<std::string> keys) {
  auto copy = copy_of(type);
  copy->together.push_back(std::move(keys));
  return copy;
}

Key required(std::string name, TypePtr type, std::string description) {
  return {.name = std::move(name), .type = std::move(type), .description = std::move(description), .required = true};
}

Key optional(std::string name, TypePtr type, std::string description, std::string note) {
  return {.name = std::move(name),
          .type = std::move(type),
          .description = std::move(description),
          .default_note = std::move(note)};
}

Key defaulted(std::string name, TypePtr type, std::string default_text, std::string description) {
  return {.name = std::move(name),
          .type = std::move(type),
          .description = std::move(description),
          .default_text = std::move(default_text)};
}

std::vector<const Key*> all_keys(const Type& type) {
  std::vector<const Key*> keys;
  for (const Key& key : type.keys) keys.push_back(&key);
  for (const Variant& variant : type.variants) {
    for (const Key& key : variant.keys) keys.push_back(&key);
  }
  return keys;
}

const Key* find_key(const std::vector<Key>& keys, const std::string& name) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return key.name == name; });
  return found == keys.end() ? nullptr : &*found;
}

}  // namespace hersey::model
