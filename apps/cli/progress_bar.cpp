#include "progress_bar.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "standard_streams.h"

namespace hersey::cli {
namespace {

using namespace std::chrono_literals;

std::size_t terminal_width() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20) return size.ws_col;
  return 100;
}

std::string remaining(double share, double elapsed) {
  if (share <= 0.005) return "--:--";
  const auto seconds = static_cast<long>(std::lround(elapsed * (1 - share) / share));
  return fmt::format("{:02d}:{:02d}", seconds / 60, seconds % 60);
}

std::string figures(const run::Progress& progress, double share) {
  std::string text = fmt::format("{:3.0f} %  t {:.5g} s  step {:.2g} s  Newton {:2d}", 100 * share, progress.t,
                                 progress.dt, progress.newton_iterations);
  if (std::isfinite(progress.moft)) text += fmt::format("  MOFT {:.2f} um", 1e6 * progress.moft);
  return text + "  left " + remaining(share, progress.elapsed);
}

}  // namespace

ProgressBar::ProgressBar()
    : terminal_(isatty(STDERR_FILENO) != 0), width_(terminal_width()), last_(Clock::now() - (terminal_ ? 1s : 0s)) {}

void ProgressBar::show(const std::string& label, const run::Progress& progress) {
  const Clock::time_point now = Clock::now();
  if (now - last_ < (terminal_ ? Clock::duration(100ms) : Clock::duration(10s))) return;
  last_ = now;
  const double span = progress.t_end - progress.t_start;
  const double share = span > 0 ? std::clamp((progress.t - progress.t_start) / span, 0.0, 1.0) : 1.0;
  const std::string text = (label.empty() ? "" : label + "  ") + figures(progress, share);
  if (!terminal_) {
    say("{}\n", text);
    return;
  }
  const std::size_t room = width_ > text.size() + 5 ? width_ - text.size() - 5 : 0;
  const auto full = static_cast<std::size_t>(std::lround(share * static_cast<double>(room)));
  say("\r\033[K[{}{}] {}", std::string(full, '#'), std::string(room - full, '.'), text);
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::clear() {
  if (!drawn_) return;
  say("\r\033[K");
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace hersey::cli
