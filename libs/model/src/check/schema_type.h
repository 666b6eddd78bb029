#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hersey::model {

/// Values a number may take.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< `low` itself is excluded
  bool high_open = false;  ///< `high` itself is excluded

  [[nodiscard]] bool contains(double x) const;
  [[nodiscard]] std::string text() const;  ///< " > 0", " of at least 3", " from 0 to 1"; empty without bounds

  static Range any() { return {}; }
  static Range positive() { return {.low = 0, .low_open = true}; }
  static Range not_negative() { return {.low = 0}; }
};

struct Type;
using TypePtr = std::shared_ptr<const Type>;

/// One word of a choice.
struct Word {
  std::string text;
  std::string description;
};

/// One key of a mapping.
struct Key {
  std::string name;
  TypePtr type;
  std::string description;  ///< a sentence
  bool required = false;
  std::optional<std::string> default_text = {};  ///< YAML, read where the key is missing
  std::string default_note = {};                 ///< the value if the key is missing and no fixed default can be given
};

/// One alternative of a variant.
struct Variant {
  std::string tag;  ///< value of the tag key
  std::string description;
  std::vector<Key> keys;
};

/// Kind of object that a reference names.
enum class Refers { body, frame, shape, joint, coordinate, lubricant, thermal_node };

/// Type of a value in the model file: the one source of the reader's checks, the JSON Schema and the reference page.
struct Type {
  enum class Kind {
    text,       ///< free text
    scalar,     ///< any scalar, kept as text (parameters)
    integer,    ///< whole number
    quantity,   ///< `count` numbers with a unit, or one of `words`
    choice,     ///< one of `words`
    reference,  ///< name of something in the model
    scale,      ///< number with a unit of any kind
    object,     ///< mapping with fixed keys
    named,      ///< mapping from free names to `item`
    list,       ///< `count` items (0: any number, at least one)
    variant,    ///< mapping whose `tag` key decides which other keys it has
    part,       ///< a part of a model, checked where a template puts it in; or the use of one
    any_of,     ///< one of `alternatives`: at most one scalar, one list, and mappings distinguished by their first key
  };
  Kind kind = Kind::text;
  std::string id;     ///< name of a type that is described once and used often; else empty
  std::string title;  ///< description of the value, with article; a quantity without it is named by its dimension
  std::vector<std::string> units;  ///< SI units of a quantity; the first one that fits is taken
  std::string example;
  Range range;
  int count = 1;
  std::vector<Word> words;
  Refers refers = Refers::body;
  std::vector<Key> keys;    ///< object; variant: keys common to all variants; named: names with a type of their own
  TypePtr item;             ///< named, list
  bool free_names = false;  ///< named: names may be key paths
  std::vector<std::vector<std::string>> exactly_one;  ///< object, variant: groups of keys of which one is given
  std::vector<std::vector<std::string>> together;     ///< groups of keys given all or not at all
  std::string tag;                                    ///< variant
  std::vector<Variant> variants;                      ///< variant
  std::string default_tag;                            ///< variant: where the tag is left out; empty: it is required
  std::vector<TypePtr> alternatives;                  ///< any_of

  /// Description of the expected value, for messages: "a length > 0, such as 45 mm".
  [[nodiscard]] std::string expectation() const;
};

// The vocabulary the schema is written in.
[[nodiscard]] TypePtr text(std::string title, std::string example);
[[nodiscard]] TypePtr scalar(std::string title, std::string example);
[[nodiscard]] TypePtr integer(int example, Range range);
[[nodiscard]] TypePtr quantity(std::string si_unit, std::string example, Range range = {});
[[nodiscard]] TypePtr quantity_in(std::vector<std::string> si_units, std::string example, Range range = {});
[[nodiscard]] TypePtr called(const TypePtr& quantity, std::string title);
[[nodiscard]] TypePtr number(std::string example, Range range = {});
[[nodiscard]] TypePtr vector(std::string si_unit, std::string example);
[[nodiscard]] TypePtr choice(std::vector<Word> words);
[[nodiscard]] TypePtr or_word(const TypePtr& quantity, std::vector<Word> words);
[[nodiscard]] TypePtr reference(Refers refers, std::string example);
[[nodiscard]] TypePtr scale_factor(std::string example);
[[nodiscard]] TypePtr object(std::string title, std::vector<Key> keys);
[[nodiscard]] TypePtr named(std::string title, TypePtr item, std::vector<Key> special = {});
[[nodiscard]] TypePtr list(std::string title, TypePtr item, int count = 0);
[[nodiscard]] TypePtr variant(std::string title, std::string tag, std::vector<Key> common,
                              std::vector<Variant> variants);
[[nodiscard]] TypePtr any_of(std::string title, std::vector<TypePtr> alternatives);
[[nodiscard]] TypePtr part(std::string title, std::string example, std::string id);
[[nodiscard]] TypePtr with_id(const TypePtr& type, std::string id);
/// A variant whose tag may be left out.
[[nodiscard]] TypePtr with_default_tag(const TypePtr& type, std::string tag);
[[nodiscard]] TypePtr with_exactly_one(const TypePtr& type, std::vector<std::string> keys);
[[nodiscard]] TypePtr with_together(const TypePtr& type, std::vector<std::string> keys);

[[nodiscard]] Key required(std::string name, TypePtr type, std::string description);
[[nodiscard]] Key optional(std::string name, TypePtr type, std::string description, std::string note = {});
[[nodiscard]] Key defaulted(std::string name, TypePtr type, std::string default_text, std::string description);

/// All keys a mapping of `type` may have; of a variant, those of all variants.
[[nodiscard]] std::vector<const Key*> all_keys(const Type& type);

/// The key called `name` among `keys`; null if there is none.
[[nodiscard]] const Key* find_key(const std::vector<Key>& keys, const std::string& name);

}  // namespace hersey::model
