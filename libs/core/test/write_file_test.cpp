#include "hersey/core/write_file.h"

#include <doctest/doctest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "hersey/core/input_file.h"
#include "temporary_directory.h"

namespace hersey {
namespace write_file_test {

TEST_CASE("WrittenFile_IsWholeOrTheOldOne") {
  const TemporaryDirectory folder;
  const std::filesystem::path page = folder / "page.html";
  write_file(page, {"a", "bc"});
  CHECK(read_input_file(page).content == "abc");
  // If the new file cannot be opened, the old one is unchanged.
  std::filesystem::create_directory(folder / "page.html.new");
  CHECK_THROWS_WITH((write_file(page, {"other"})), "Is a directory");
  CHECK(read_input_file(page).content == "abc");
  std::filesystem::remove(folder / "page.html.new");
  write_file(page, {"other"});
  CHECK(read_input_file(page).content == "other");
  CHECK_FALSE(std::filesystem::exists(folder / "page.html.new"));
}

TEST_CASE("WrittenFile_FollowsNoLinkOfItsUnfinishedName") {
  const TemporaryDirectory folder, elsewhere;
  write_file(elsewhere / "outside.txt", {"theirs"});
  const std::filesystem::path page = folder / "page.html", unfinished = folder / "page.html.new";
  for (const std::filesystem::path& target : {elsewhere / "outside.txt", elsewhere / "none.txt"}) {
    std::filesystem::create_symlink(target, unfinished);
    write_file(page, {"own"});
    CHECK(read_input_file(page).content == "own");
    CHECK_FALSE(std::filesystem::is_symlink(page));
    CHECK_FALSE(std::filesystem::exists(std::filesystem::symlink_status(unfinished)));
  }
  CHECK(read_input_file(elsewhere / "outside.txt").content == "theirs");
  CHECK_FALSE(std::filesystem::exists(elsewhere / "none.txt"));
  // What an interrupted program has left is replaced.
  write_file(unfinished, {"a longer text that was left"});
  write_file(page, {"new"});
  CHECK(read_input_file(page).content == "new");
}

TEST_CASE("NewFile_ReplacesNothing_AndIsMadeByOneOfSeveral") {
  const TemporaryDirectory folder;
  constexpr int kMakers = 8;
  std::atomic<int> made = 0;
  for (int round = 0; round < 20; ++round) {
    const std::filesystem::path file = folder / std::to_string(round);
    std::vector<std::thread> makers;
    for (int maker = 0; maker < kMakers; ++maker)
      makers.emplace_back([&file, &made, maker] { made += write_new_file(file, std::to_string(maker)) ? 1 : 0; });
    for (std::thread& maker : makers) maker.join();
    CHECK(made == round + 1);
    CHECK(read_input_file(file).content.size() == 1);
  }
  std::filesystem::create_symlink("nowhere", folder / "link");
  CHECK_FALSE(write_new_file(folder / "link", "a"));
  CHECK_FALSE(std::filesystem::exists(folder / "nowhere"));
  CHECK_THROWS_WITH((void)write_new_file(folder / "none" / "file", "a"), "No such file or directory");
}

TEST_CASE("WrittenFile_FollowsLinksAndTakesDevices") {
  const TemporaryDirectory folder;
  write_file(folder / "page.html", {"a"});
  std::filesystem::create_symlink("page.html", folder / "link.html");
  write_file(folder / "link.html", {"b"});
  CHECK(std::filesystem::is_symlink(folder / "link.html"));
  CHECK(read_input_file(folder / "page.html").content == "b");
  CHECK_NOTHROW(write_file("/dev/null", {"b"}));
  CHECK_THROWS_WITH(write_file("/dev/full", {"b"}), "No space left on device");
  CHECK_THROWS_WITH(write_file(folder / "none" / "page.html", {"b"}), "No such file or directory");
}

}  // namespace write_file_test
}  // namespace hersey
