#include "hersey/core/program_identity.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>

namespace hersey {

TEST_CASE("ProgramIdentity_BeginsWithTheBuildIdOfThisProgram") {
  const std::string identity = program_identity();
  const std::string id = identity.substr(0, identity.find(' '));
  // What linkers give is a checksum of 16 or 20 bytes, some of 8.
  CHECK(id.size() >= 16);
  CHECK(std::all_of(id.begin(), id.end(), [](unsigned char c) { return std::isxdigit(c) != 0; }));
  CHECK(program_identity() == identity);
}

}  // namespace hersey
