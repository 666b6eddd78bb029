#include "hersey/core/recently_used.h"

#include <doctest/doctest.h>

namespace hersey {
namespace recently_used_test {

TEST_CASE("OfTooMany_ThatAskedForLongestAgoIsDropped") {
  constexpr std::size_t kMost = 5;
  RecentlyUsed<int> kept(kMost);
  for (int i = 0; i < 100; ++i) {
    const std::string name = std::to_string(i);
    CHECK(kept.find(name) == nullptr);
    CHECK(*kept.keep(name, std::make_shared<const int>(i)) == i);
    REQUIRE(kept.find("0") != nullptr);  // asked for again and again
    CHECK(kept.size() <= kMost);
  }
  for (int i = 1; i < 100; ++i) CHECK((kept.find(std::to_string(i)) != nullptr) == (i > 100 - static_cast<int>(kMost)));
}

TEST_CASE("ANameKeptAgain_HasTheNewValue_AndTheOldOneStaysWithItsClient") {
  RecentlyUsed<int> kept(3);
  const std::shared_ptr<const int> old = kept.keep("a", std::make_shared<const int>(1));
  kept.keep("a", std::make_shared<const int>(2));
  CHECK(kept.size() == 1);
  CHECK(*kept.find("a") == 2);
  CHECK(*old == 1);
}

}  // namespace recently_used_test
}  // namespace hersey
