#include "interrupt.h"

#include <csignal>
#include <cstdint>
#include <ctime>

namespace hersey::cli {
namespace {

// Signals that come so soon after the first are the same one: a terminal sends it to the program and to a wrapper
// around it, which passes it on [ns].
constexpr std::int64_t kTogether = 300'000'000;

std::atomic<bool> interrupted{false};
std::atomic<std::int64_t> first{0};  // when [ns]

extern "C" void on_signal(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t at = std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
  std::int64_t before = 0;
  if (first.compare_exchange_strong(before, at)) {
    interrupted = true;
  } else if (at - before > kTogether) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

const std::atomic<bool>& catch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  std::signal(SIGPIPE, SIG_IGN);
  return interrupted;
}

}  // namespace hersey::cli
