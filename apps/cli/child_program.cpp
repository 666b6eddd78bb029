#include "child_program.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>

namespace hersey::cli {
namespace {

constexpr int kNoSuchProgram = 127;  // as shells say it

/// In the new process: becomes the program. Calls alone that are safe after fork.
[[noreturn]] void become(char* const* words, const char* folder, int log, int nothing, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kNoSuchProgram);  // it ended before this could be asked for
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGALRM}) std::signal(signal, SIG_DFL);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  if (::chdir(folder) == 0) ::execvp(words[0], words);
  ::_exit(errno == ENOENT ? kNoSuchProgram : kNoSuchProgram - 1);
}

ChildEnd ended(int status) {
  if (WIFSIGNALED(status)) return {ChildEnd::Reason::killed, WTERMSIG(status)};
  const int code = WEXITSTATUS(status);
  return {code == kNoSuchProgram ? ChildEnd::Reason::not_found : ChildEnd::Reason::exited, code};
}

ChildEnd waited_for(pid_t child, double time_limit, const std::atomic<bool>& stop) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  while (true) {
    int status = 0;
    const pid_t done = ::waitpid(child, &status, WNOHANG);
    if (done == child) return ended(status);
    if (done < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), "waitpid");
    const bool is_late = std::chrono::duration<double>(Clock::now() - begin).count() > time_limit;
    if (stop || is_late) {
      ::kill(-child, SIGKILL);
      ::kill(child, SIGKILL);  // where it has no group of its own yet
      while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
      return {stop ? ChildEnd::Reason::interrupted : ChildEnd::Reason::took_too_long, 0};
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace

ChildEnd run_program(const std::vector<std::string>& words, const std::filesystem::path& folder,
                     const std::filesystem::path& log, double time_limit, const std::atomic<bool>& stop) {
  std::vector<std::string> copies = words;
  std::vector<char*> pointers;
  pointers.reserve(copies.size() + 1);
  for (std::string& word : copies) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int written = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  const pid_t parent = ::getpid();
  const pid_t child = nothing < 0 || written < 0 ? -1 : ::fork();
  if (child == 0) become(pointers.data(), folder.c_str(), written, nothing, parent);
  const int reason = errno;
  if (nothing >= 0) ::close(nothing);
  if (written >= 0) ::close(written);
  if (child < 0) throw std::system_error(reason, std::generic_category(), words.front());
  return waited_for(child, time_limit, stop);
}

}  // namespace hersey::cli
