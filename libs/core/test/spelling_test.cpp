#include "hersey/core/spelling.h"

#include <doctest/doctest.h>

#include <vector>

namespace hersey {
namespace spelling_test {

TEST_CASE("EditDistance_CountsLettersAndSwaps") {
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("diameter", "diameter") == 0);
  CHECK(edit_distance("diamter", "diameter") == 1);
  CHECK(edit_distance("widht", "width") == 1);  // one swap, not two substitutions
  CHECK(edit_distance("Width", "width") == 0);
  CHECK(edit_distance("kitten", "sitting") == 3);  // Wagner-Fischer's standard example
  CHECK(edit_distance("ca", "abc") == 3);          // optimal string alignment; unrestricted Damerau would say 2
}

TEST_CASE("NearestName_IsFoundOnlyWhenNear") {
  const std::vector<std::string> keys = {"diameter", "width", "radial_clearance"};
  CHECK(nearest_name("diamter", keys) == "diameter");
  CHECK(nearest_name("widht", keys) == "width");
  CHECK(nearest_name("clearance", keys).empty());
  CHECK(nearest_name("colour", keys).empty());
  CHECK(nearest_name("mn", std::vector<std::string>{"m", "mm"}) == "mm");  // equally near, but as long
  CHECK(did_you_mean("diamter", keys) == "did you mean 'diameter'?");
  CHECK(did_you_mean("colour", keys).empty());
}

TEST_CASE("Alternatives_AreListedAsSentence") {
  CHECK(one_of(std::vector<std::string>{}).empty());
  CHECK(one_of(std::vector<std::string>{"a"}) == "a");
  CHECK(one_of(std::vector<std::string>{"a", "b"}) == "a or b");
  CHECK(one_of(std::vector<std::string>{"a", "b", "c"}) == "a, b or c");
}

}  // namespace spelling_test
}  // namespace hersey
