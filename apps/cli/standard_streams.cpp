#include "standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace hersey::cli {

void open_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest free descriptor is the one asked for: those below it are open by now.
    if (::open("/dev/null", O_RDWR) != descriptor)
      throw std::system_error(errno, std::generic_category(),
                              "a standard stream is closed and /dev/null cannot be opened");
  }
}

bool finish_standard_output() {
  if (std::fflush(stdout) == 0 || errno == EPIPE) return true;
  say("hersey: the output was lost: {}\n", std::strerror(errno));
  return false;
}

}  // namespace hersey::cli
