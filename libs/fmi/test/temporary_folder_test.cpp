#include "temporary_folder.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "temporary_directory.h"

namespace hersey::fmi {
namespace temporary_folder_test {

/// Makes everything in a folder some minutes older.
void age(const std::filesystem::path& folder) {
  const auto earlier = std::filesystem::file_time_type::clock::now() - std::chrono::minutes(5);
  std::filesystem::last_write_time(folder, earlier);
}

/// A process with a folder that never removes it, and its number.
pid_t hold_a_folder(const std::filesystem::path& names) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "resources");
  std::filesystem::create_directory_symlink(folder.path(), names);
  ::pause();
  ::_exit(0);
}

// Whoever is killed leaves its folder; the next one tidies it up, and not that of a process that lives.
TEST_CASE("FoldersOfTheDead_AreRemovedByTheNext") {
  const TemporaryDirectory scratch;
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  REQUIRE(::setenv("TMPDIR", (scratch / "").c_str(), 1) == 0);
  const std::filesystem::path names[] = {scratch / "name_of_dead", scratch / "name_of_living"};
  const pid_t dead = hold_a_folder(names[0]), living = hold_a_folder(names[1]);
  for (const auto& link : names)
    while (!std::filesystem::is_symlink(std::filesystem::symlink_status(link))) ::usleep(1000);
  ::kill(dead, SIGKILL);
  ::waitpid(dead, nullptr, 0);
  const auto of_dead = std::filesystem::read_symlink(names[0]), of_living = std::filesystem::read_symlink(names[1]);
  const std::filesystem::path stranger = scratch / "hersey-fmu-mine";  // without a lock
  std::filesystem::create_directory(stranger);
  {
    const TemporaryFolder soon;
    CHECK(std::filesystem::exists(of_dead));  // it may have been made just now
  }
  for (const auto& folder : {of_dead, of_living, stranger}) age(folder);
  {
    const TemporaryFolder next;
    CHECK(!std::filesystem::exists(of_dead));
    CHECK(std::filesystem::exists(of_living / "resources"));
    CHECK(std::filesystem::exists(stranger));
    CHECK(std::filesystem::exists(next.path()));
  }
  ::kill(living, SIGKILL);
  ::waitpid(living, nullptr, 0);
  { const TemporaryFolder last; }
  CHECK(!std::filesystem::exists(of_living));
  if (before == nullptr)
    ::unsetenv("TMPDIR");
  else
    ::setenv("TMPDIR", kept.c_str(), 1);
}

}  // namespace temporary_folder_test
}  // namespace hersey::fmi
