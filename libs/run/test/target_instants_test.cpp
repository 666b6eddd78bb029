#include "time_stepping/target_instants.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace hersey::run {
namespace target_instants_test {

TEST_CASE("TargetInstants_EqualIntervals_EndWithTheRun") {
  const TargetInstants whole = TargetInstants::equal(2, 1, 0.25);
  REQUIRE(whole.size() == 4);
  CHECK(whole.front() == 2.25);
  CHECK(whole[3] == 3);
  const TargetInstants rest = TargetInstants::equal(0, 1, 0.3);
  REQUIRE(rest.size() == 4);
  CHECK(rest[2] == 3 * 0.3);
  CHECK(rest[3] == 1);
  CHECK(TargetInstants::equal(0, 1e-3, 1).size() == 1);
}

TEST_CASE("TargetInstants_RoundOffOfTheDuration_IsNoStep") {
  CHECK(TargetInstants::equal(0, 0.3, 0.1).size() == 3);
  CHECK(TargetInstants::equal(0, std::nextafter(0.3, 1), 0.1).size() == 3);
}

TEST_CASE("TargetInstants_AnyNumberOfSteps_NeedsNoMemory") {
  const TargetInstants many = TargetInstants::equal(0, 1e9, 1e-3);  // 8 TB as a list
  REQUIRE(many.size() == 1'000'000'000'000);
  CHECK(many[many.size() - 1] == 1e9);
  CHECK(many[499'999'999'999] == doctest::Approx(5e8));
}

TEST_CASE("TargetInstants_AList_IsKept") {
  const TargetInstants list({0.5, 0.7, 2});
  REQUIRE(list.size() == 3);
  CHECK(list[1] == 0.7);
  CHECK(list.front() == 0.5);
  CHECK(TargetInstants().size() == 0);
}

}  // namespace target_instants_test
}  // namespace hersey::run
