#include <doctest/doctest.h>

#include "interpret/context/interpret.h"
#include "schema/film_vocabulary.h"
#include "schema/machine_vocabulary.h"
#include "schema/oil_laws.h"
#include "tree/source_tree.h"

// Words of the model file: format and reading are one table.
namespace hersey::model {
namespace vocabulary_test {

/// `text`, checked against `type`.
Value checked(const Type& type, const std::string& text) {
  Node node;
  node.kind = Node::Kind::scalar;
  node.text = text;
  std::vector<Fault> faults;
  std::map<std::string, SourcePosition> positions;
  return check(node, type, faults, positions);
}

TEST_CASE("Words_OfTheFormatHaveTheirMeaning") {
  const TypePtr type = choice(analysis_words);
  REQUIRE(type->words.size() == analysis_words.size());
  for (const auto& one : analysis_words)
    CHECK(meaning_of(checked(*type, std::string(one.word)), analysis_words) == one.value);
  CHECK(meaning_of(checked(*type, "statics"), analysis_words) ==
        Analysis::dynamics);  // reported as a fault; the first word replaces it
}

TEST_CASE("Words_WithoutMeaningAreAMistakeInTheCode") {
  const TypePtr type = choice({{"newton", "known"}, {"secant", "in the format, read by nobody"}});
  const Value word = checked(*type, "secant");
  REQUIRE_FALSE(word.broken);
  CHECK_THROWS_AS((void)meaning_of(word, film_solver_words), ContractError);
}

TEST_CASE("Alternatives_EachIsReadByItsOwnTag") {
  for (const auto& law : viscosity_laws()) {
    Value value;
    value.text = law.format.tag;
    CHECK_NOTHROW((void)read_alternative(value, viscosity_laws()));
  }
  Value unknown;
  unknown.text = "houpert";
  CHECK_THROWS_AS((void)read_alternative(unknown, viscosity_laws()), ContractError);
}

TEST_CASE("Keys_ThatTheFormatDoesNotHaveAreAMistakeInTheCode") {
  const TypePtr type = object("a thing", {optional("mass", quantity("kg", "1 kg"), "Its mass.")});
  Value value;
  value.type = type.get();
  CHECK(number_of(value, "mass") == 0);  // missing, which the file may leave it
  CHECK_THROWS_AS((void)number_of(value, "masss"), ContractError);
  CHECK_FALSE(value.has("masss"));
}

}  // namespace vocabulary_test
}  // namespace hersey::model
