#include "interrupt.h"

#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <ctime>
#include <string_view>

#include "exit_code.h"

namespace hersey::cli {
namespace {

// Signals that come so soon after the first are the same one: a terminal sends it to the program and to a wrapper
// around it, which passes it on [ns].
constexpr std::int64_t kTogether = 300'000'000;

// longest time without a check of the flag [us]
constexpr suseconds_t kPatience = 500'000;
constexpr time_t kPatienceSeconds = 1;

std::atomic<bool> interrupted{false};
std::atomic<bool> heeded{false};
std::atomic<std::int64_t> first{0};  // when [ns]

// Steps so short have no checkpoint behind each [ns]; how often they are waited for.
constexpr std::int64_t kShortStep = 500'000'000;
constexpr int kMostAlarms = 6;

std::atomic<std::int64_t> last_step_end{0}, last_step{0};  // [ns]; 0 before there is one

std::int64_t now_in_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

void set_alarm() {
  itimerval once{};
  once.it_value.tv_sec = kPatienceSeconds;
  once.it_value.tv_usec = kPatience;
  setitimer(ITIMER_REAL, &once, nullptr);
}

// Calls alone that are safe in signal handlers. The results are as a kill would leave them: `--resume` goes on.
extern "C" void on_alarm(int) {
  static constexpr std::string_view text =
      "\nhersey: stopped on request amid a computation; --resume goes on from the last checkpoint, if there is one\n";
  static std::atomic<int> alarms{0};
  if (heeded) return;
  const std::int64_t step = last_step;
  if (step > 0 && step < kShortStep && ++alarms < kMostAlarms) return set_alarm();
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
  ::_exit(kInterrupted);
}

extern "C" void on_signal(int signal) {
  const std::int64_t at = now_in_ns();
  std::int64_t before = 0;
  if (first.compare_exchange_strong(before, at)) {
    interrupted = true;
    set_alarm();
  } else if (at - before > kTogether) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

const std::atomic<bool>& catch_interrupts() {
  std::signal(SIGALRM, on_alarm);
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  std::signal(SIGPIPE, SIG_IGN);
  return interrupted;
}

void interrupt_is_heeded() {
  if (interrupted) heeded = true;
}

void note_step() {
  const std::int64_t now = now_in_ns(), before = last_step_end.exchange(now);
  if (before > 0) last_step = now - before;
}

}  // namespace hersey::cli
