#include "hersey/core/packer.h"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

namespace hersey {
namespace packer_test {

Archive::Content content() {
  Archive::Content content;
  content.numbers["film/pressure"] = {{2, 3}, {1, -0.0, 3.5, std::numeric_limits<double>::infinity(), 1e-300, 6}};
  content.numbers["none"] = {{0}, {}};
  content.texts["model"] = std::string("a\0b", 3);
  return content;
}

std::vector<unsigned char> packed() {
  Packer packer;
  packer.put(7);
  packer.put(std::string("two"));
  packer.put(std::vector<double>{1, 2});
  packer.put(content());
  return packer.take();
}

void take_all(const std::vector<unsigned char>& bytes) {
  Unpacker unpacker(bytes.data(), bytes.size());
  CHECK(unpacker.number<int>() == 7);
  CHECK(unpacker.text() == "two");
  CHECK(unpacker.list<double>() == std::vector<double>{1, 2});
  const Archive::Content taken = unpacker.content();
  CHECK(taken.numbers == content().numbers);
  CHECK(taken.texts == content().texts);
  unpacker.require_end();
}

TEST_CASE("WhatIsPacked_IsTakenOutAgain") { take_all(packed()); }

TEST_CASE("BytesThatAreCutOffOrGoOn_AreRefused") {
  const std::vector<unsigned char> whole = packed();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    Unpacker unpacker(whole.data(), size);
    const auto all = [&] {
      (void)unpacker.number<int>();
      (void)unpacker.text();
      (void)unpacker.list<double>();
      (void)unpacker.content();
    };
    CHECK_THROWS_AS(all(), std::runtime_error);
  }
  std::vector<unsigned char> longer = whole;
  longer.push_back(0);
  CHECK_THROWS_AS(take_all(longer), std::runtime_error);
}

TEST_CASE("ADamagedLength_AsksForNoMemory") {
  Packer packer;
  packer.put(std::numeric_limits<std::uint64_t>::max());
  const std::vector<unsigned char> bytes = packer.take();
  CHECK_THROWS_AS((void)Unpacker(bytes.data(), bytes.size()).text(), std::runtime_error);
  CHECK_THROWS_AS((void)Unpacker(bytes.data(), bytes.size()).list<double>(), std::runtime_error);
}

}  // namespace packer_test
}  // namespace hersey
