#include "hersey/core/input_file.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "temporary_directory.h"

namespace hersey {
namespace input_file_test {

TEST_CASE("InputFiles_AreFiles") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "text") << "two\nlines";
  CHECK(read_input_file(folder / "text").content == "two\nlines");
  CHECK(read_input_file(folder / "text").fault.empty());
  CHECK(read_input_file(folder / "none").fault == "no readable file");
  CHECK(read_input_file(folder.path()).fault == "a directory");
  CHECK(read_input_file("/dev/zero").fault == "a device");
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(read_input_file(folder / "pipe").fault == "a pipe");  // opened, it would be waited for
}

TEST_CASE("InputFiles_HaveASize") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "holes") << "x";
  std::filesystem::resize_file(folder / "holes", std::uintmax_t{1} << 40);
  CHECK(read_input_file(folder / "holes").fault == "a file of 1.09951e+06 MB, of at most 2147.48 MB");
  CHECK(unreadable(folder / "holes") == std::nullopt);
}

}  // namespace input_file_test
}  // namespace hersey
