#include "hersey/results/output_lock.h"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

namespace hersey::results::output_lock_test {

TEST_CASE("OutputLock_BelongsToOneRunAndLeavesNothing") {
  const std::filesystem::path file = "locked.h5";
  {
    const OutputLock lock(file);
    CHECK_THROWS_WITH_AS(OutputLock{file}, doctest::Contains("locked.h5: another run (process "), FileBusy);
    CHECK_THROWS_AS(require_idle(file), FileBusy);
    CHECK_NOTHROW(OutputLock{"beside.h5"});  // another file of the folder
  }
  CHECK_FALSE(std::filesystem::exists("locked.h5.lock"));
  CHECK_NOTHROW(require_idle(file));
  CHECK_NOTHROW(OutputLock{file});
}

TEST_CASE("OutputLock_OfAKilledRunBlocksNobody") {
  const std::filesystem::path file = "killed.h5";
  int ends[2]{};
  REQUIRE(::pipe(ends) == 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const OutputLock lock(file);
    [[maybe_unused]] const ssize_t one = ::write(ends[1], "x", 1);
    ::pause();
  }
  char ready = 0;
  REQUIRE(::read(ends[0], &ready, 1) == 1);
  CHECK_THROWS_AS(OutputLock{file}, FileBusy);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  CHECK(std::filesystem::exists("killed.h5.lock"));
  CHECK_NOTHROW(require_idle(file));
  CHECK_NOTHROW(OutputLock{file});
  CHECK_FALSE(std::filesystem::exists("killed.h5.lock"));
}

TEST_CASE("OutputLock_InAFolderThatIsNotThereIsNone") { CHECK_NOTHROW(OutputLock{"nowhere/x.h5"}); }

}  // namespace hersey::results::output_lock_test
