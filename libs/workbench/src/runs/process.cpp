#include "runs/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <future>
#include <iterator>
#include <sstream>
#include <system_error>
#include <thread>
#include <utility>

namespace hersey::workbench {
namespace {

/// What a new program is called with, made before the fork: after it only calls that are safe in signal handlers may
/// follow.
class Arguments {
 public:
  explicit Arguments(const std::vector<std::string>& words) : copies_(words) {
    pointers_.reserve(copies_.size() + 1);
    for (std::string& word : copies_) pointers_.push_back(word.data());
    pointers_.push_back(nullptr);
  }
  [[nodiscard]] char* const* words() const { return pointers_.data(); }

 private:
  std::vector<std::string> copies_;
  std::vector<char*> pointers_;
};

/// In the new process: becomes the program. The descriptors 0 to 2 are replaced, all others close as it begins.
[[noreturn]] void become_program(const Arguments& arguments, const char* folder, int output) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ, SIGCHLD}) std::signal(signal, SIG_DFL);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  if (::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC) != 0) ::close_range(STDERR_FILENO + 1, ~0U, 0);
  if (::chdir(folder) == 0) ::execv(arguments.words()[0], arguments.words());
  ::_exit(127);
}

[[noreturn]] void no_process(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what + " cannot be started");
}

std::string content_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// State and start of a process; the state is 'Z' if it has ended and nobody has asked for its exit code.
struct ProcessStatus {
  char state = 'X';
  std::uint64_t start = 0;
};

ProcessStatus status_of(int pid) {
  const std::string text = content_of(fmt::format("/proc/{}/stat", pid));
  const std::size_t end_of_name = text.rfind(')');  // the name may contain anything
  if (end_of_name == std::string::npos) return {};
  std::istringstream rest(text.substr(end_of_name + 1));
  ProcessStatus status;
  rest >> status.state;
  constexpr int kFieldsBetween = 18;  // from the fourth to the 21st
  std::string skipped;
  for (int i = 0; i < kFieldsBetween; ++i) rest >> skipped;
  rest >> status.start;
  return status;
}

bool has_argument(int pid, const std::string& argument) {
  const std::string text = content_of(fmt::format("/proc/{}/cmdline", pid));
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, '\0');)
    if (word == argument) return true;
  return false;
}

}  // namespace

ProcessId start_detached(const std::vector<std::string>& words, const std::filesystem::path& folder,
                         const std::filesystem::path& log) {
  const Arguments arguments(words);
  const std::string in_folder = folder.string();
  const int output = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (output < 0) no_process(words.front());
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) {
    ::close(output);
    no_process(words.front());
  }
  const pid_t child = ::fork();
  if (child == 0) {
    const pid_t program = ::fork();
    if (program == 0 && ::setsid() > 0) become_program(arguments, in_folder.c_str(), output);
    [[maybe_unused]] const ssize_t said = ::write(pipe[1], &program, sizeof program);
    ::_exit(0);
  }
  const int error = errno;
  ::close(output);
  ::close(pipe[1]);
  pid_t program = -1;
  if (child > 0) {
    ssize_t got = 0;
    do got = ::read(pipe[0], &program, sizeof program);
    while (got < 0 && errno == EINTR);
    // The pipe ends as the program begins: who stops it knows it by its arguments.
    char nothing = 0;
    while (::read(pipe[0], &nothing, 1) < 0 && errno == EINTR) continue;
    while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) continue;
  }
  ::close(pipe[0]);
  errno = error;
  if (program <= 0) no_process(words.front());
  return {program, status_of(program).start};
}

ProcessId start_attached(const std::vector<std::string>& words, const std::filesystem::path& folder,
                         const std::filesystem::path& log) {
  std::promise<ProcessId> starting;
  std::future<ProcessId> started = starting.get_future();
  // The system takes the end of the thread that has started a program for that of its parent: this one waits for it.
  std::thread([words, folder = folder.string(), log, starting = std::move(starting)]() mutable {
    const Arguments arguments(words);
    const int output = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    std::array<int, 2> pipe{-1, -1};
    const pid_t parent = ::getpid();
    const pid_t child = output < 0 || ::pipe2(pipe.data(), O_CLOEXEC) != 0 ? -1 : ::fork();
    if (child == 0) {
      ::setsid();
      ::prctl(PR_SET_PDEATHSIG, SIGINT);
      if (::getppid() != parent) ::_exit(127);  // it ended before this could be asked for
      become_program(arguments, folder.c_str(), output);
    }
    const int error = errno;
    for (const int descriptor : {output, pipe[1]})
      if (descriptor >= 0) ::close(descriptor);
    // The pipe ends as the program begins: who stops it knows it by its arguments.
    char nothing = 0;
    while (child > 0 && ::read(pipe[0], &nothing, 1) < 0 && errno == EINTR) continue;
    if (pipe[0] >= 0) ::close(pipe[0]);
    if (child < 0) {
      const auto what = words.front() + " cannot be started";
      return starting.set_exception(std::make_exception_ptr(std::system_error(error, std::generic_category(), what)));
    }
    starting.set_value({child, status_of(child).start});
    while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) continue;
  }).detach();
  return started.get();
}

bool is_running(const ProcessId& process) {
  if (process.pid <= 1) return false;
  const ProcessStatus status = status_of(process.pid);
  return status.state != 'X' && status.state != 'Z' && status.start == process.start;
}

bool interrupt(const ProcessId& process, const std::string& argument) {
  return is_running(process) && has_argument(process.pid, argument) && ::kill(-process.pid, SIGINT) == 0;
}

int run_to_end(const std::vector<std::string>& words, const std::filesystem::path& folder, double most_seconds,
               std::string& output) {
  using Monotonic = std::chrono::steady_clock;
  const Arguments arguments(words);
  const std::string in_folder = folder.string();
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) no_process(words.front());
  const pid_t child = ::fork();
  if (child == 0) {
    ::setsid();
    become_program(arguments, in_folder.c_str(), pipe[1]);
  }
  const int error = errno;
  ::close(pipe[1]);
  if (child < 0) {
    ::close(pipe[0]);
    errno = error;
    no_process(words.front());
  }
  constexpr std::size_t kMostOutput = 65536;
  const Monotonic::time_point end =
      Monotonic::now() + std::chrono::duration_cast<Monotonic::duration>(std::chrono::duration<double>(most_seconds));
  bool is_late = false;
  while (true) {
    pollfd entry{pipe[0], POLLIN, 0};
    const auto rest = std::chrono::duration_cast<std::chrono::milliseconds>(end - Monotonic::now()).count();
    const int ready = rest > 0 ? ::poll(&entry, 1, static_cast<int>(rest)) : 0;
    if (ready < 0 && errno == EINTR) continue;
    is_late = ready <= 0;
    if (is_late) break;
    std::array<char, 4096> part{};
    const ssize_t got = ::read(pipe[0], part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    output.append(part.data(),
                  std::min(static_cast<std::size_t>(got), kMostOutput - std::min(kMostOutput, output.size())));
  }
  ::close(pipe[0]);
  if (is_late) ::kill(-child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return !is_late && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace hersey::workbench
