#include "temporary_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <string>
#include <system_error>

namespace hersey::fmi {
namespace {

constexpr const char* kPrefix = "hersey-fmu-";
constexpr const char* kLock = ".lock";

// A folder that has just been made may not be locked yet [s].
constexpr std::time_t kYoung = 60;

/// True for a folder, no link to one, of this user that has not been made just now.
bool may_be_stale(const std::filesystem::path& folder) {
  struct stat status {};
  return ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::geteuid() &&
         std::time(nullptr) - status.st_mtime > kYoung;
}

/// Removes a folder whose program has ended: nothing holds its lock.
void remove_if_stale(const std::filesystem::path& folder) {
  if (!may_be_stale(folder)) return;
  const int lock = ::open((folder / kLock).c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
  if (lock < 0) return;
  std::error_code ignored;
  if (::flock(lock, LOCK_EX | LOCK_NB) == 0) std::filesystem::remove_all(folder, ignored);
  ::close(lock);
}

void remove_stale_folders(const std::filesystem::path& where) {
  std::error_code error;
  std::filesystem::directory_iterator folder(where, error), end;
  while (!error && folder != end) {
    if (folder->path().filename().string().starts_with(kPrefix)) remove_if_stale(folder->path());
    folder.increment(error);
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  const std::filesystem::path where = std::filesystem::temp_directory_path();
  remove_stale_folders(where);
  std::string path = (where / (std::string(kPrefix) + "XXXXXX")).string();
  if (::mkdtemp(path.data()) == nullptr)
    throw std::filesystem::filesystem_error("a temporary folder", path,
                                            std::error_code(errno, std::generic_category()));
  path_ = path;
  // Without a lock, as on some network drives, the folder is only not tidied up after a crash.
  lock_ = ::open((path_ / kLock).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) != 0) std::filesystem::remove(path_ / kLock);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;  // what cannot be removed is left to the system's own tidying of the temporary folder
  std::filesystem::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace hersey::fmi
