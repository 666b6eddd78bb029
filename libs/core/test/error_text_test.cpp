#include "hersey/core/error_text.h"

#include <doctest/doctest.h>

#include <functional>
#include <map>
#include <new>
#include <stdexcept>
#include <string>

#include "edited.h"
#include "hersey/core/contract.h"

namespace hersey {
namespace error_text_test {

void divide(int by) { HERSEY_REQUIRE(by != 0, "a divisor"); }

std::string text_of(const std::function<void()>& what) {
  try {
    what();
  } catch (const std::exception& error) {
    return error_text(error);
  }
  return "";
}

TEST_CASE("ErrorText_OfABugIsARequestAndALocationOnItsOwnLine") {
  const std::string text = text_of([] { divide(0); });
  const std::size_t end = text.find('\n');
  REQUIRE(end != std::string::npos);
  CHECK(text.substr(0, end) == "internal error, please report it with the model and the next line");
  CHECK(text.substr(end + 1).starts_with("  at divide, libs/core/test/error_text_test.cpp:"));
  CHECK_FALSE(contains(text, "by != 0"));
  CHECK_FALSE(contains(text, "does not hold"));
}

TEST_CASE("ErrorText_OfTheStandardLibrarysComplaintsIsOfABugToo") {
  const std::map<int, int> none;
  CHECK(text_of([&] { (void)none.at(3); }).starts_with("internal error, please report it"));
  CHECK(text_of([] { throw std::bad_function_call(); }).starts_with("internal error, please report it"));
}

TEST_CASE("ErrorText_OfWhatIsKnownToGoWrongIsItsOwn") {
  CHECK(text_of([] { throw std::runtime_error("no convergence"); }) == "no convergence");
  CHECK(text_of([] { throw std::bad_alloc(); }) == "the machine's memory does not suffice");
}

}  // namespace error_text_test
}  // namespace hersey
