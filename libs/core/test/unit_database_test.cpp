#include "hersey/core/unit_database.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>

#include "hersey/core/units.h"

namespace hersey::unit_database_test {

TEST_CASE("UnitDatabase_IsReadOnceAndHangsOnNoFolderAfterwards") {
  namespace fs = std::filesystem;
  REQUIRE(parse_quantity("45 mm", "m") == doctest::Approx(0.045).epsilon(1e-15));  // round-off
  const fs::path read = unit_database();
  REQUIRE(fs::exists(read));
  const fs::path copy = fs::absolute("own_units");
  fs::create_directories(copy);
  for (const auto& entry : fs::directory_iterator(read.parent_path()))
    fs::copy_file(entry.path(), copy / entry.path().filename(), fs::copy_options::overwrite_existing);
  use_unit_database(copy / read.filename());
  CHECK(unit_database() == read);  // one of them serves the whole process
  fs::remove_all(copy);
  CHECK(parse_quantity("1 lbf", "N") > 4.4);
  CHECK(unit_database() == read);
}

TEST_CASE("UnitDatabase_LeavesTheEnvironmentAlone") {
  const char* before = std::getenv("UDUNITS2_XML_PATH");
  use_unit_database("nowhere/udunits2.xml");
  (void)parse_quantity("1 mm", "m");
  CHECK(std::getenv("UDUNITS2_XML_PATH") == before);
}

}  // namespace hersey::unit_database_test
