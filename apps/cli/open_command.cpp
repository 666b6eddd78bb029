#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "command_line.h"
#include "commands.h"
#include "exit_code.h"
#include "hersey/core/input_error.h"
#include "hersey/core/write_file.h"
#include "hersey/workbench/server.h"
#include "standard_streams.h"

namespace hersey::cli {
namespace {

using Path = std::filesystem::path;

std::atomic<bool> ends_open{false};

/// The first Ctrl-C ends it in order, which requests in progress delay; the second one at once.
extern "C" void end_open(int signal) {
  ends_open = true;
  std::signal(signal, SIG_DFL);
}

Path running_program(const Path& named) {
  std::error_code error;
  const Path self = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? named : self;
}

bool has_display() {
  const auto is_set = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}

/// A page that only this user can read, which leads to the address: arguments of programs can be read by everyone on
/// the machine, and the address contains the token. It is removed with its folder at the end.
class LeadingPage {
 public:
  explicit LeadingPage(const std::string& address) {
    const char* runtime = std::getenv("XDG_RUNTIME_DIR");
    std::error_code error;
    Path base = runtime != nullptr ? Path(runtime) : Path();
    if (base.empty() || !std::filesystem::is_directory(base, error)) base = std::filesystem::temp_directory_path();
    std::string pattern = (base / "hersey-open-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) return;
    folder_ = pattern;
    write_file(file(), {"<!doctype html><title>hersey</title><meta name=\"referrer\" content=\"no-referrer\">"
                        "<meta http-equiv=\"refresh\" content=\"0;url=",
                        address, "\">"});
  }
  LeadingPage(const LeadingPage&) = delete;
  LeadingPage& operator=(const LeadingPage&) = delete;
  ~LeadingPage() {
    std::error_code ignored;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
  }
  [[nodiscard]] Path file() const { return folder_ / "open.html"; }
  [[nodiscard]] bool exists() const { return !folder_.empty(); }

 private:
  Path folder_;
};

/// Starts the desktop's browser and does not wait for it: twice forked, it belongs to no one.
void open_browser(const Path& page) {
  const std::string file = page.string();
  const pid_t child = ::fork();
  if (child == 0) {
    ::setsid();
    if (::fork() != 0) ::_exit(0);
    const int nothing = ::open("/dev/null", O_RDWR);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nothing, stream);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_DFL);
    ::execlp("xdg-open", "xdg-open", file.c_str(), static_cast<char*>(nullptr));
    ::_exit(1);
  }
  if (child > 0) ::waitpid(child, nullptr, 0);
}

workbench::ServerOptions options_of(const OpenArguments& arguments) {
  workbench::ServerOptions options;
  const Path given = arguments.path.empty() ? Path(".") : arguments.path;
  std::error_code error;
  const Path path = std::filesystem::canonical(given, error);
  if (error)
    throw InputError(Fault{{given.string(), 0, 0}, "", "no such file or folder", "a model file, or a folder", ""});
  if (std::filesystem::is_directory(path)) {
    options.folder = path;
  } else {
    options.folder = path.parent_path();
    options.open = path.filename().string();
  }
  options.port = arguments.port;
  options.program = running_program(arguments.program);
  options.log = [](const std::string& line) { say("hersey: {}\n", line); };
  return options;
}

}  // namespace

int open_command(const OpenArguments& arguments) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, end_open);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is an error of the write that meets it
  workbench::Server server(options_of(arguments));
  fmt::print("{}\n", server.address());
  std::fflush(stdout);
  say("The workbench is at this address, for who has it, until Ctrl-C; runs go on afterwards.\n"
      "From another machine: ssh -L {0}:127.0.0.1:{0} THIS_MACHINE, then open it there.\n",
      server.port());
  std::unique_ptr<LeadingPage> page;
  if (!arguments.no_browser && has_display()) {
    page = std::make_unique<LeadingPage>(server.address());
    if (page->exists()) open_browser(page->file());
  }
  server.serve(ends_open);
  return kOk;
}

void add_open_command(CLI::App& app, Commands& commands, const std::string& program) {
  const auto open = std::make_shared<OpenArguments>();
  open->program = program;
  CLI::App* command =
      app.add_subcommand("open", "Open the workbench: write, see and run models in the browser, until Ctrl-C");
  command->add_option("PATH", open->path, "A model file, or a folder of models (default: the present folder)")
      ->type_name("MODEL|FOLDER");
  command->add_option("--port", open->port, "Port on the loopback address (default: the first free one from 8437 on)")
      ->check(CLI::Range(1, 65535))
      ->type_name("N");
  command->add_flag("--no-browser", open->no_browser, "Print the address only");
  commands.push_back({command, [open] { return open_command(*open); }});
}

}  // namespace hersey::cli
