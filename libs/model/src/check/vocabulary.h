#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "check/check.h"
#include "check/schema_type.h"
#include "hersey/core/contract.h"

namespace hersey::model {

/// A word of the model file and its meaning.
template <typename T>
struct Meaning {
  T value;
  std::string_view word;
  std::string_view description;
};

/// The words of a choice or of a variant without keys of its own. Format, reading and names all follow from it.
template <typename T, std::size_t n>
using Vocabulary = std::array<Meaning<T>, n>;

template <typename T, std::size_t n>
[[nodiscard]] TypePtr choice(const Vocabulary<T, n>& words) {
  std::vector<Word> all;
  all.reserve(n);
  for (const Meaning<T>& one : words) all.push_back({std::string(one.word), std::string(one.description)});
  return choice(std::move(all));
}

/// Variants without keys of their own.
template <typename T, std::size_t n>
[[nodiscard]] std::vector<Variant> variants_of(const Vocabulary<T, n>& words) {
  std::vector<Variant> all;
  all.reserve(n);
  for (const Meaning<T>& one : words) all.push_back({std::string(one.word), std::string(one.description), {}});
  return all;
}

/// Meaning of a checked word; that of the first word if it is broken.
template <typename T, std::size_t n>
[[nodiscard]] T meaning_of(const Value& word, const Vocabulary<T, n>& words) {
  if (word.broken) return words.front().value;
  const auto found = std::find_if(words.begin(), words.end(), [&](const auto& one) { return one.word == word.text; });
  HERSEY_REQUIRE(found != words.end(), "'" + word.text + "' is a word of the format, but has no meaning");
  return found->value;
}

/// Meaning of the key `key` of `parent`; `otherwise` if it is missing.
template <typename T, std::size_t n>
[[nodiscard]] T meaning_of(const Value& parent, const std::string& key, const Vocabulary<T, n>& words, T otherwise) {
  const Value* word = parent.find(key);
  return word != nullptr ? meaning_of(*word, words) : otherwise;
}

template <typename T, std::size_t n>
[[nodiscard]] T meaning_of(const Value& parent, const std::string& key, const Vocabulary<T, n>& words) {
  return meaning_of(parent, key, words, words.front().value);
}

/// One alternative of a mapping whose tag decides what it is: its keys, and how they are read.
template <typename T>
struct Alternative {
  Variant format;
  std::function<T(const Value&)> read;
};

template <typename T>
[[nodiscard]] std::vector<Variant> variants_of(const std::vector<Alternative<T>>& alternatives) {
  std::vector<Variant> all;
  all.reserve(alternatives.size());
  for (const Alternative<T>& one : alternatives) all.push_back(one.format);
  return all;
}

/// Object described by a checked mapping.
/// @pre it is not broken
template <typename T>
[[nodiscard]] T read_alternative(const Value& value, const std::vector<Alternative<T>>& alternatives) {
  for (const Alternative<T>& one : alternatives)
    if (one.format.tag == value.text) return one.read(value);
  HERSEY_REQUIRE(false, "'" + value.text + "' is an alternative of the format that nothing reads");
}

}  // namespace hersey::model
