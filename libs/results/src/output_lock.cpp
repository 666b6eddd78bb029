#include "hersey/results/output_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>

namespace hersey::results {
namespace {

std::filesystem::path lock_of(const std::filesystem::path& results) {
  std::filesystem::path path = results;
  path += ".lock";
  return path;
}

/// "process 4711 on engine-room", as written by the process that has the lock.
std::string holder(int fd) {
  std::array<char, 256> text{};
  const ssize_t length = ::pread(fd, text.data(), text.size() - 1, 0);
  std::string name(text.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
  return name.empty() ? "" : " (" + name + ")";
}

void sign(int fd) {
  std::array<char, 128> host{};
  const bool is_known = ::gethostname(host.data(), host.size() - 1) == 0;
  const std::string name =
      "process " + std::to_string(::getpid()) + (is_known ? " on " + std::string(host.data()) : "");
  if (::ftruncate(fd, 0) == 0) [[maybe_unused]]
    const ssize_t written = ::pwrite(fd, name.data(), name.size(), 0);  // for the message only
}

[[noreturn]] void refuse(const std::filesystem::path& results, int fd) {
  const std::string who = holder(fd);
  ::close(fd);
  throw FileBusy(results, "another run" + who + " is writing this file: wait for its end, or write elsewhere");
}

/// True if the name still belongs to the open file: the end of a run removes the name.
bool has_name(int fd, const std::filesystem::path& path) {
  struct stat opened {
  }, named{};
  return ::fstat(fd, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

}  // namespace

OutputLock::OutputLock(const std::filesystem::path& results) : lock_(lock_of(results)) {
  while (!results.empty()) {
    // An error that prevents the lock also prevents the results from being written, and is reported then.
    const int fd = ::open(lock_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0) return;
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
      if (errno == EWOULDBLOCK) refuse(results, fd);
      ::close(fd);
      ::unlink(lock_.c_str());
      return;
    }
    if (has_name(fd, lock_)) {
      sign(fd);
      fd_ = fd;
      return;
    }
    ::close(fd);
  }
}

OutputLock::~OutputLock() {
  if (fd_ < 0) return;
  ::unlink(lock_.c_str());
  ::close(fd_);
}

void require_idle(const std::filesystem::path& results) {
  const int fd = ::open(lock_of(results).c_str(), O_RDWR | O_CLOEXEC);
  if (fd < 0) return;
  if (::flock(fd, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK) refuse(results, fd);
  ::close(fd);
}

}  // namespace hersey::results
