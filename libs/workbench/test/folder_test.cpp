#include "folder/folder.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "folder/watch.h"

namespace hersey::workbench {
namespace {

using Path = std::filesystem::path;

/// A folder of the test's own, removed at its end.
class OwnFolder {
 public:
  OwnFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "hersey-folder-test-XXXXXX").string();
    REQUIRE(::mkdtemp(pattern.data()) != nullptr);
    path = pattern;
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  ~OwnFolder() { std::filesystem::remove_all(path); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(path / name) << text; }
  [[nodiscard]] std::string content(const std::string& name) const {
    std::ifstream file(path / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  Path path;
};

int status_of_path(const Folder& folder, const std::string& relative) {
  try {
    (void)folder.resolve(relative);
    return 200;
  } catch (const Refused& refused) {
    return refused.status;
  }
}

TEST_CASE("Paths_StayInTheFolder") {
  const OwnFolder own;
  std::filesystem::create_directory(own.path / "inner");
  std::filesystem::create_directory(own.path / "inner" / "sub");
  own.write("secret", "");
  own.write("inner/model.yaml", "");
  std::filesystem::create_symlink("../secret", own.path / "inner" / "out");
  std::filesystem::create_symlink("..", own.path / "inner" / "up");
  std::filesystem::create_symlink("model.yaml", own.path / "inner" / "in");
  std::filesystem::create_symlink("sub", own.path / "inner" / "down");
  // A folder whose name begins like this one's is another one.
  std::filesystem::create_directory(own.path / "inner2");
  std::filesystem::create_symlink("../inner2", own.path / "inner" / "beside");
  const Folder folder(own.path / "inner");
  for (const char* good : {"model.yaml", "new.yaml", "sub/new.yaml", "no/such/folder.yaml", "in", "down/x.yaml", "a..b",
                           "\xe0\xa0\x80", "\xed\x9f\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"})
    CHECK_MESSAGE(status_of_path(folder, good) == 200, good);
  for (const char* bad : {"",
                          ".",
                          "..",
                          "...",
                          "/",
                          "/etc/passwd",
                          "../secret",
                          "sub/../../secret",
                          "sub/..",
                          "out",
                          "up",
                          "up/secret",
                          "beside/x",
                          "a//b",
                          "a/",
                          ".hidden",
                          "a/.hidden",
                          "a\nb",
                          "a\x7f",
                          "\xff",
                          "\xc0\xae\xc0\xae/secret",
                          "\xed\xa0",
                          "\xed\xa0\x80.yaml",
                          "\xe0\x80\xaf.yaml",
                          "\xf0\x80\x80\xaf.yaml",
                          "\xf4\x90\x80\x80.yaml"})
    CHECK_MESSAGE(status_of_path(folder, bad) == 403, bad);
  CHECK(status_of_path(folder, std::string("model.yaml\0x", 12)) == 403);
}

TEST_CASE("Writes_NeedTheTextThatTheyReplace") {
  const OwnFolder own;
  Folder folder(own.path);
  const std::string first = folder.create("a.yaml", "one");
  CHECK(folder.read("a.yaml").etag == first);
  CHECK_THROWS_AS(folder.create("a.yaml", "two"), ChangedFile);
  const std::string second = folder.replace("a.yaml", "two", first);
  CHECK(second != first);
  CHECK_THROWS_AS(folder.replace("a.yaml", "three", first), ChangedFile);
  CHECK(own.content("a.yaml") == "two");
  own.write("a.yaml", "theirs");
  CHECK_THROWS_AS(folder.replace("a.yaml", "mine", second), ChangedFile);
  CHECK(own.content("a.yaml") == "theirs");
  CHECK(folder.replace("a.yaml", "one", folder.read("a.yaml").etag) == first);
  CHECK_THROWS_AS(folder.replace("b.yaml", "", first), Refused);
}

TEST_CASE("Watch_ReportsWhatIsNewChangedAndGone") {
  const OwnFolder own;
  own.write("a.yaml", "one");
  std::filesystem::create_directories(own.path / "runs" / "a-001");
  own.write("runs/a-001/log.txt", "1");
  const Folder folder(own.path);
  Watch watch(folder);
  using Paths = std::vector<std::string>;
  CHECK(watch.changes().empty());
  own.write("a.yaml", "other");
  own.write("b.csv", "");
  own.write("runs/a-001/log.txt", "12");
  CHECK(watch.changes() == Paths{"a.yaml", "b.csv"});
  CHECK(watch.changes().empty());
  std::filesystem::remove(own.path / "b.csv");
  own.write("runs/a-001/report.html", "");
  CHECK(watch.changes() == Paths{"runs/a-001/report.html", "b.csv"});
}

TEST_CASE("Folder_ThatIsNoneIsRefused") {
  const OwnFolder own;
  own.write("file", "");
  CHECK_THROWS_AS(Folder(own.path / "file"), std::runtime_error);
  CHECK_THROWS_AS(Folder(own.path / "missing"), std::runtime_error);
}

}  // namespace
}  // namespace hersey::workbench
