#include "crash.h"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstring>

#include "exit_code.h"
#include "hersey/core/untrusted_file.h"

namespace hersey::cli {
namespace {

void write(const char* text) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, std::strlen(text));
}

// Calls alone that are safe in signal handlers.
extern "C" void on_crash(int signal) {
  if (const char* const file = untrusted_file(); file != nullptr) {
    for (const char* const text : {"hersey: ", file, ": damaged: its structure cannot be read\n"}) write(text);
    ::_exit(kWrongInput);
  }
  if (const char* const file = foreign_code(); file != nullptr) {
    for (const char* const text : {"hersey: ", file, ": its library has crashed; what was written stays readable\n"})
      write(text);
    ::_exit(kFailed);
  }
  // The handler is gone by SA_RESETHAND: this is the crash that it would have been.
  ::raise(signal);
}

}  // namespace

void report_crashes_of_damaged_files() {
  static std::array<char, 65536> stack;  // the crash may be a stack that is full
  stack_t other{};
  other.ss_sp = stack.data();
  other.ss_size = stack.size();
  ::sigaltstack(&other, nullptr);
  struct sigaction action {};
  action.sa_handler = on_crash;
  action.sa_flags = static_cast<int>(SA_ONSTACK | SA_RESETHAND);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT}) ::sigaction(signal, &action, nullptr);
}

}  // namespace hersey::cli
