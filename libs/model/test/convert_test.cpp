#include "hersey/model/convert.h"

#include <doctest/doctest.h>

#include "model_text.h"

namespace hersey::model {
namespace convert_test {

std::string text_of(const std::string& old) { return converted(old, "m.yaml").text; }

TEST_CASE("Grades_AreSpelledAsNow") {
  const Conversion conversion = converted(
      "parameters: {which: 'sae_10w_40'}  # stays\n"
      "lubricants:\n"
      "  sae_5w_30: {grade: sae_5w_30}\n"
      "  other: {grade: \"${which}\"}\n"
      "bearings: {main: {lubricant: sae_5w_30}}\n",
      "m.yaml");
  CHECK(conversion.text ==
        "parameters: {which: 'sae_10w40'}  # stays\n"
        "lubricants:\n"
        "  sae_5w_30: {grade: sae_5w30}\n"
        "  other: {grade: \"${which}\"}\n"
        "bearings: {main: {lubricant: sae_5w_30}}\n");
  REQUIRE(conversion.changes.size() == 2);
  CHECK(conversion.changes[1].position.line == 3);
  CHECK(conversion.changes[1].position.column == 22);
  CHECK(conversion.changes[1].path == "lubricants.sae_5w_30.grade");
  CHECK(conversion.changes[1].what == "sae_5w_30 is written sae_5w30");
}

TEST_CASE("CouplingTolerance_IsRemovedWithItsLineOrItsComma") {
  CHECK(text_of("a:\n  coupling:\n    scheme: partitioned\n    tolerance: 1e-6  # why\n  b: 1\n") ==
        "a:\n  coupling:\n    scheme: partitioned\n  b: 1\n");
  CHECK(text_of("a:\n  coupling:\n    scheme: partitioned\n    tolerance: '1e-6'") ==
        "a:\n  coupling:\n    scheme: partitioned\n");
  CHECK(text_of("a: {coupling: {scheme: partitioned, tolerance: 1e-6}, b: 1}\n") ==
        "a: {coupling: {scheme: partitioned}, b: 1}\n");
  CHECK(text_of("a: {coupling: {tolerance: \"1e-6\", scheme: partitioned}}\n") ==
        "a: {coupling: {scheme: partitioned}}\n");
  CHECK(text_of("a: {coupling: {scheme: partitioned,\n  tolerance: \"${t}\" }}\n") ==
        "a: {coupling: {scheme: partitioned }}\n");
}

TEST_CASE("AliasedText_IsChangedOnce") {
  CHECK(text_of("a: &one\n  coupling: {scheme: partitioned, tolerance: 1e-6}\nb: *one\nc: {d: *one}\n") ==
        "a: &one\n  coupling: {scheme: partitioned}\nb: *one\nc: {d: *one}\n");
}

TEST_CASE("OldModel_IsReadAfterConversion") {
  const std::string old = edited(edited(good_model, "    diameter: 45 mm\n",
                                        "    diameter: 45 mm\n    coupling: {scheme: partitioned, tolerance: 1e-6}\n"),
                                 "lubricants:\n", "lubricants:\n  engine: {grade: sae_0w_20}\n");
  const std::string faults = faults_of(old);
  const std::size_t tolerance = faults.find("unknown key 'tolerance'");
  REQUIRE(tolerance != std::string::npos);
  const std::string hint = "`hersey convert` brings this file up to date";
  CHECK(faults.find(hint, faults.find("'sae_0w_20'")) != std::string::npos);
  CHECK(faults.find(hint, tolerance) != std::string::npos);
  CHECK(faults_of(text_of(old)) == "no fault");
}

TEST_CASE("ModelOfThisVersion_IsUnchanged") {
  const Conversion conversion = converted(good_model, "m.yaml");
  CHECK(conversion.text == good_model);
  CHECK(conversion.changes.empty());
  CHECK_THROWS_AS((void)converted("a: [1", "m.yaml"), InputError);
}

}  // namespace convert_test
}  // namespace hersey::model
